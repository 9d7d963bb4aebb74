// A view's interval at the renderer: its keyframe's scene, and what may move in it. What is shown next is compared with
// it: if only what may move differs, an inbetween shows it, else a new interval must begin.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::studio {

// All that differs from the keyframe.
struct Moved {
  std::vector<wire::MovedSegment> segments;
  std::vector<wire::MovedPatch> patches;
};

class Interval {
 public:
  // `scene`: with its interval's moving segments.
  explicit Interval(wire::FilmData scene);

  const wire::FilmData& scene() const { return scene_; }
  std::span<const std::uint32_t> moving() const { return scene_.moving; }
  // Everything moves, so that nothing is kept for inbetweens.
  bool alone() const { return scene_.moving.size() == scene_.segments.size(); }

  // None: something differs that no inbetween can show. Others than the moving segments may be among those moved.
  std::optional<Moved> moved_to(const wire::FilmData& now) const;
  // Whether an inbetween may show it.
  bool holds(const Moved& moved) const;

 private:
  bool same_setting(const wire::FilmData& now) const;
  std::optional<std::uint32_t> material_like(const wire::Material& material, std::uint32_t likely) const;

  wire::FilmData scene_;
  std::vector<char> moves_;
};

// Whether both look the same.
bool same_picture(const wire::FilmData& one, const wire::FilmData& other);

// The numbers of the segments that the two show differently, ascending; of all where camera, lights or the segments
// themselves differ.
std::vector<std::uint32_t> changed_segments(const wire::FilmData& before, const wire::FilmData& now);

// Ascending numbers in either.
std::vector<std::uint32_t> joined(std::span<const std::uint32_t> one, std::span<const std::uint32_t> other);

}  // namespace mars::studio
