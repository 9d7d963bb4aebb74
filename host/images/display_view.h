// How a view of an OpenColorIO config shows light. ocio_view.cpp is the only place that knows OpenColorIO; without it
// no_ocio_view.cpp refuses.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "node/wire/pixel_format.h"

namespace mars::images {

// What a person says; "": the config's default.
struct ViewWish {
  std::string config{};  // a file; "": no view
  std::string display{};
  std::string view{};
  std::string input{};  // the colour space, or role, that the light is taken for; default: the role scene_linear

  bool operator==(const ViewWish&) const = default;
};

// What the pixels depend on; all "": no view.
struct ViewName {
  std::string config{};  // absolute
  std::string display{};
  std::string view{};
  std::string input{};
  std::string checksum{};  // of what is computed: 32 hexadecimal digits

  bool empty() const { return config.empty(); }
  auto operator<=>(const ViewName&) const = default;
};

// "the view Film of scene_linear on the display sRGB in /show/config.ocio".
std::string text_of(const ViewName& name);

class DisplayView {
 public:
  virtual ~DisplayView() = default;
  const ViewName& name() const { return name_; }
  // From light to what is shown, 0..1: red, green and blue of each pixel. From any thread.
  virtual void show(std::span<float> rgb) const = 0;

 protected:
  explicit DisplayView(ViewName name) : name_(std::move(name)) {}

 private:
  ViewName name_;
};

// Throws Failure where the config cannot be read or has no such view, display or input.
std::shared_ptr<const DisplayView> open_view(const ViewWish& wish);

// The version of OpenColorIO, as "2.1.2"; none: MARS was built without it.
std::optional<std::string> view_library_version();

// Pixels of PixelFormat::half or, where `format` has alpha, half_alpha, their light times `exposure`, as pixels of
// `format`: rgb8, rgb16, rgba8 or rgba16, with straight colours.
std::vector<std::uint32_t> shown_pixels(const DisplayView& view, std::span<const std::uint32_t> light, float exposure,
                                        wire::PixelFormat format);

}  // namespace mars::images
