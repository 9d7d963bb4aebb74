// The frame writer of a simulated node: messages are as long as a real one's (host/render/composer/node_writer.h), work
// and storage are charged, but nothing is composed or encoded, and no file is written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/simulated/world.h"
#include "host/experiments/platform.h"
#include "host/images/picture_bands.h"
#include "node/wire/frame_writer.h"

namespace mars::programs {

class CountedWriter : public wire::FrameWriter {
 public:
  // For `node` of the world, whose platform is `platform`; both outlive it.
  CountedWriter(const images::PictureBands& bands, const experiments::Platform& platform, simulated::World& world,
                int node);
  CountedWriter(auto&&, const experiments::Platform&&, auto&&...) = delete;

  bool sees_folder() const override { return true; }
  std::uint32_t lines_of_band() const override { return bands_.lines_a_band(); }
  std::size_t shared_bytes() const override { return 1; }
  void share(std::span<std::byte>) override {}
  void begin_keyframe(const Keyframe& keyframe) override;
  void begin_inbetween(std::uint32_t frame, const wire::LineSpan& home) override;
  void paste(const wire::Strip& strip, std::span<const wire::Run> runs, std::span<const std::uint32_t> pixels) override;
  std::span<const std::byte> edge() override;
  void add_edge(std::span<const std::byte>) override {}
  void finish_bands() override;
  bool has_background() const override { return next_background_ < bands_.count(); }
  std::span<const std::byte> next_background(std::size_t bytes) override;
  std::size_t most_band_bytes() const override;
  void add_background(std::span<const std::byte>) override {}
  std::span<const std::byte> picture() override;
  void add_picture(std::span<const std::byte>) override {}
  void write() override;
  bool is_full() override;
  bool is_busy() override { return !under_way_.empty(); }
  std::optional<wire::Written> take_written() override;
  bool has_written() override { return !under_way_.empty() && under_way_.front().there <= now(); }
  std::optional<std::string> take_warning() override { return std::nullopt; }

 private:
  struct File {
    std::uint32_t frame;
    double begun, there;  // seconds of the node's clock
  };

  bool composes(std::uint32_t band) const;
  bool inbetweens_touch(std::uint32_t band) const;
  std::size_t pixel_bytes(const images::Lines& lines) const { return bands_.words_of(lines) * sizeof(std::uint32_t); }
  std::size_t record_bytes(std::uint32_t band) const;
  std::size_t background_bytes(std::uint32_t band) const;
  void find_background();
  double now() const { return world_.clock(node_); }
  void charge(wire::Work kind, std::uint64_t units) const;

  const images::PictureBands bands_;
  const experiments::Platform& platform_;
  simulated::World& world_;
  const int node_;

  Keyframe keyframe_{};
  std::uint32_t frame_ = 0;    // that was begun last
  std::vector<bool> touched_;  // its bands, by moving parts that were pasted
  std::vector<std::byte> edge_, background_, picture_;
  std::uint32_t next_background_ = 0;  // own band for other machines; the number of bands: none
  std::deque<File> under_way_;
};

}  // namespace mars::programs
