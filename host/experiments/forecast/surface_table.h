// Patches and meshlets as they were counted, each kind of them once: what stands still looks the same in all keyframes
// that see it from the same place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "node/wire/frame_counts.h"

namespace mars::forecast {

// One of a keyframe.
struct PlacedSurface {
  std::uint32_t number;   // among all of the film
  std::uint32_t surface;  // in the table
};

class SurfaceTable {
 public:
  // The place of one that is the same but for its number, which the table does not know.
  std::uint32_t add(wire::MadeSurface surface, std::span<const wire::SurfaceLine> lines);

  std::size_t size() const { return surfaces_.size(); }
  const wire::MadeSurface& operator[](std::uint32_t place) const { return surfaces_[place]; }
  std::span<const wire::SurfaceLine> lines(std::uint32_t place) const {
    return std::span(lines_).subspan(lines_at_[place], surfaces_[place].lines);
  }

 private:
  bool is(std::uint32_t place, const wire::MadeSurface& surface, std::span<const wire::SurfaceLine> lines) const;

  std::vector<wire::MadeSurface> surfaces_;
  std::vector<std::size_t> lines_at_;
  std::vector<wire::SurfaceLine> lines_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> places_;  // by hash
};

}  // namespace mars::forecast
