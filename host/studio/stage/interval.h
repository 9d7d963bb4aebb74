// A view's interval at the renderer: its keyframe's scene, and what may move in it. What is shown next is compared with
// it: if only what may move differs, an inbetween shows it, else a new interval must begin.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::studio {

// A moment of the film, which views share, as one of them sees it.
struct Shot {
  std::shared_ptr<const wire::FilmData> moment{};
  wire::Camera camera{};
  std::uint32_t width = 0, height = 0;
};

// All that differs from the keyframe.
struct Moved {
  std::vector<wire::MovedSegment> segments;  // and bones
  std::vector<wire::MovedPatch> patches;
};

class Interval {
 public:
  // `moving`: what may move, as wire::Interval numbers it.
  Interval(Shot scene, std::vector<std::uint32_t> moving);

  std::span<const std::uint32_t> moving() const { return moving_; }
  // Everything moves, so that nothing is kept for inbetweens.
  bool alone() const { return moving_.size() == moves_.size(); }

  // None: something differs that no inbetween can show. Others than `moving` may be among those moved.
  std::optional<Moved> moved_to(const Shot& now) const;
  // Whether an inbetween may show it.
  bool holds(const Moved& moved) const;

 private:
  std::optional<std::uint32_t> material_like(const wire::Material& material, std::uint32_t likely) const;

  Shot scene_;
  std::vector<std::uint32_t> moving_;
  // Of each segment, then of each bone; of a segment with a skin, whether all its bones do.
  std::vector<char> moves_;
};

// Whether both look the same.
bool same_picture(const Shot& one, const Shot& other);

// The segments and bones that the two show differently, as wire::Interval numbers them; all where camera, lights or the
// segments themselves differ.
std::vector<std::uint32_t> changed_parts(const Shot& before, const Shot& now);

// Ascending numbers in either.
std::vector<std::uint32_t> joined(std::span<const std::uint32_t> one, std::span<const std::uint32_t> other);

}  // namespace mars::studio
