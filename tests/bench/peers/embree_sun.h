// Shadow rays: from the points that a packet's rays met to points of the sun, a small disc or one point.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "tests/bench/peers/embree_view.h"

namespace mars::bench {

inline constexpr int kSunPoints = 16;  // of a disc, for all samples of a pixel together

// The pixel and sample of each ray of a packet, as they lie in a block of width x height pixels.
struct Lanes {
  int width, height, samples;
  Ints column, line, sample;
};

// Where a packet is, and how far along its rays are the points from which shadow rays start.
struct Spots {
  int left, top;
  Floats x, y, z;
};

class Sun {
 public:
  // `size`: the tangent of half the angle that it takes up; 0: a point, one ray a sample.
  Sun(float size, const Lanes& lanes);

  int rays() const { return rays_; }  // of a sample
  Ints all() const { return Ints{} + ((1 << rays_) - 1); }

  // A bit for each ray of a sample that nothing in `blockers` stops, of those of `tried`.
  Ints open(const Spots& spots, Ints tried, std::initializer_list<const View*> blockers) const;
  Floats share(Ints open) const;

  // Whether rays are traced; if not, none is stopped. For measuring what they cost.
  bool traces = true;

 private:
  // Rays that are traced together, all of a few samples: from which of a packet's samples, which of its rays.
  struct Bundle {
    Ints lane, ray;
  };
  struct Offsets {
    Floats across[2];
  };

  void trace(const View& view, const Spots& spots, const Offsets* offsets, Ints& open) const;

  int width_, height_, rays_;
  std::vector<Bundle> bundles_;
  std::vector<Offsets> offsets_;  // of the bundles, for each of the blocks of 4 x 4 pixels, row by row
};

// How many rays this thread has traced since it was last asked.
std::uint64_t take_rays_traced();

}  // namespace mars::bench
