// The bones of a segment with a skin in one space, eye space or the world, in doubles, and what bounds the points that
// follow them.
//
// A point's bones, each alone, would put it to x_1, x_2, ...; their blend puts it to a mean of these, and, if it is by
// dual quaternions, somewhat beyond, for bones turn it round arcs. Of quaternions q_j on the same side of each other, d
// the cosine between two, the blend is
//
//   sum_jk w_j w_k (d (x_j + x_k) / 2 + (x_j - x_k) x v / 2) / sum_jk w_j w_k d,   v the vector of q_j times q_k*
//
// so the point leaves the box round all x_j by sum_j<k w_j w_k |x_j - x_k| sqrt(1 - d^2) / |sum w q|^2 at most. Of two
// bones that is the height of the arc over its chord. At half a circle either arc may be taken, and is within the
// bound.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/geometry/scene.h"
#include "node/shape/dual_quaternion.h"
#include "node/wire/film.h"

namespace mars::geometry {

class SkinBounds {
 public:
  struct Box {
    double low[3];
    double high[3];
  };

  // Forgets all bones; room for `most` of them stays.
  void begin(wire::Blend blend, std::size_t most);
  void add(const wire::Matrix& bone);

  // Round points between `low` and `high` that follow some of the bones with these numbers. `pairs`: which of them
  // share points, by their places in the list; nullptr: all may.
  Box round(std::span<const std::uint32_t> bones, const std::array<float, 3>& low, const std::array<float, 3>& high,
            const BonePairs* pairs = nullptr) const;
  // Round all of a shape.
  Box round(const ShapeBoxes& boxes, std::uint32_t shape) const;

  // Round a net's point: where it goes, to some roundings, or, where it is in doubt which arc it takes, round all
  // places to which it may go.
  Box round(const wire::PackedFilm& film, const wire::NetPoint& point) const;

 private:
  bool is_dual() const { return blend_ == wire::Blend::dual_quaternions; }
  Box stretched(const Box& box) const;
  bool in_doubt(std::span<const std::uint32_t> bones, std::span<const float> weights) const;
  double way_between(std::uint32_t a, std::uint32_t b, const Box& box) const;
  template <typename Visit>
  double beyond(std::size_t together, const Visit& visit_pairs) const;

  wire::Blend blend_ = wire::Blend::linear;
  std::vector<wire::Matrix> maps_;                   // of bones; of dual quaternions without the stretches
  std::vector<shape::DualBone<double>> duals_;       // none where the blend is linear
  double least_stretch_[3][3], most_stretch_[3][3];  // of all bones
  mutable std::vector<signed char> sides_;           // of quaternions, while they are compared; 0: not known yet
};

}  // namespace mars::geometry
