#include "node/geometry/skin_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mars::geometry {
namespace {

// Of a blended place, or a mean of such, relative to the largest of what is added up to it, at most: single precision
// rounds some ten times on the way, of dual quaternions some forty times, and once for each of a stencil's terms; and
// sums of weights are not quite 1.
constexpr double kBlendRounding = 1.0 / (1 << 15);
static_assert((wire::kMostTerms + 100.0) / (1 << 24) + 2 * wire::kWeightRounding < kBlendRounding);

constexpr double kUnbounded = std::numeric_limits<double>::max();

SkinBounds::Box box_of(const std::array<float, 3>& low, const std::array<float, 3>& high) {
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

SkinBounds::Box box_of(const ShapeBoxes::Box& box) { return box_of(std::to_array(box.low), std::to_array(box.high)); }

// Round boxes that several bones move.
class MovedBox {
 public:
  void add(const wire::Matrix& bone, const SkinBounds::Box& box) {
    for (std::size_t r = 0; r < 3; ++r) {
      double least = bone.m[r][3], most = least, reach = std::abs(least);
      for (std::size_t c = 0; c < 3; ++c) {
        const double one = bone.m[r][c] * box.low[c], other = bone.m[r][c] * box.high[c];
        least += std::min(one, other);
        most += std::max(one, other);
        reach += std::max(std::abs(one), std::abs(other));
      }
      box_.low[r] = std::min(box_.low[r], least);
      box_.high[r] = std::max(box_.high[r], most);
      reach_ = std::max(reach_, reach);
    }
  }

  SkinBounds::Box wider(double by, double rounding) const {
    SkinBounds::Box out = box_;
    const double slack = by + (reach_ + by) * rounding;
    for (std::size_t a = 0; a < 3; ++a) out.low[a] -= slack, out.high[a] += slack;
    return out;
  }

 private:
  SkinBounds::Box box_{{kUnbounded, kUnbounded, kUnbounded}, {-kUnbounded, -kUnbounded, -kUnbounded}};
  double reach_ = 0;
};

}  // namespace

void SkinBounds::begin(wire::Blend blend, std::size_t most) {
  blend_ = blend;
  maps_.clear(), duals_.clear(), sides_.clear();
  maps_.reserve(most);
  if (!is_dual()) return;
  duals_.reserve(most);
  sides_.reserve(most);
  std::fill_n(&least_stretch_[0][0], 9, kUnbounded);
  std::fill_n(&most_stretch_[0][0], 9, -kUnbounded);
}

void SkinBounds::add(const wire::Matrix& bone) {
  maps_.push_back(bone);
  if (!is_dual()) return;
  const shape::BoneParts parts = shape::parts_of(bone);
  duals_.push_back(shape::dual_bone(parts));
  sides_.push_back(0);
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) {
      maps_.back().m[r][c] = parts.turn[r][c];
      least_stretch_[r][c] = std::min(least_stretch_[r][c], parts.stretch[r][c]);
      most_stretch_[r][c] = std::max(most_stretch_[r][c], parts.stretch[r][c]);
    }
}

// Between where the least and the most of each number of the bones' stretches take the box: so is any mean of theirs.
SkinBounds::Box SkinBounds::stretched(const Box& box) const {
  if (!is_dual()) return box;
  Box out{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [least, most] = std::minmax({least_stretch_[r][c] * box.low[c], least_stretch_[r][c] * box.high[c],
                                              most_stretch_[r][c] * box.low[c], most_stretch_[r][c] * box.high[c]});
      out.low[r] += least;
      out.high[r] += most;
    }
  return out;
}

// How far apart two bones put a point of the stretched box at most.
double SkinBounds::way_between(std::uint32_t a, std::uint32_t b, const Box& box) const {
  double square = 0;
  for (std::size_t r = 0; r < 3; ++r) {
    const auto &one = maps_[a].m[r], &other = maps_[b].m[r];
    double middle = one[3] - other[3], reach = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      middle += (one[c] - other[c]) * (box.low[c] + box.high[c]) / 2;
      reach += std::abs(one[c] - other[c]) * (box.high[c] - box.low[c]) / 2;
    }
    square += (std::abs(middle) + reach) * (std::abs(middle) + reach);
  }
  return std::sqrt(square);
}

// How far points may be beyond where their bones, each alone, would put them. visit_pairs(visit) calls visit(a, b, box)
// for each two bones that a point in the stretched box may follow; a point follows `together` bones at most.
//
// With n bones sum_j<k w_j w_k is (1 - 1/n) / 2 at most, and |sum w q|^2 is 1 - 2 sum_j<k w_j w_k (1 - d). Where not
// all quaternions lie on the same side of each other some d are below 0 and the mean of x_j has weights below 0; but
// DualBlend adds up to a sum of length sqrt(1/n) at least, hence the last formula.
template <typename Visit>
double SkinBounds::beyond(std::size_t together, const Visit& visit_pairs) const {
  double least_cosine = 1, apart = 0, across = 0;
  bool on_one_side = true;
  visit_pairs([&](std::uint32_t a, std::uint32_t b, const Box& box) {
    const auto &p = duals_[a].real, &q = duals_[b].real;
    const double cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
    const auto side = static_cast<signed char>(cosine < 0 ? -1 : 1);
    if (sides_[a] == 0)
      sides_[a] = sides_[b] == 0 ? static_cast<signed char>(1) : static_cast<signed char>(sides_[b] * side);
    if (sides_[b] == 0) sides_[b] = static_cast<signed char>(sides_[a] * side);
    on_one_side &= sides_[a] * sides_[b] == side;
    const double way = way_between(a, b, box);
    least_cosine = std::min(least_cosine, std::abs(cosine));
    apart = std::max(apart, way);
    across = std::max(across, way * std::sqrt(std::max(1 - cosine * cosine, 0.0)));
  });
  const double n = static_cast<double>(together), products = (1 - 1 / n) / 2;
  if (on_one_side) return across * products / (1 - 2 * products * (1 - least_cosine));
  return apart * (std::sqrt(n) + products * n);
}

SkinBounds::Box SkinBounds::round(std::span<const std::uint32_t> bones, const std::array<float, 3>& low,
                                  const std::array<float, 3>& high, const BonePairs* pairs) const {
  const Box box = stretched(box_of(low, high));
  MovedBox moved;
  for (const std::uint32_t bone : bones) moved.add(maps_[bone], box);
  if (!is_dual()) return moved.wider(0, kBlendRounding);
  for (const std::uint32_t bone : bones) sides_[bone] = 0;
  const double by = beyond(std::min<std::size_t>(bones.size(), wire::kMostPointBones), [&](const auto& visit) {
    for (std::size_t a = 0; a < bones.size(); ++a)
      for (std::size_t b = a + 1; b < bones.size(); ++b)
        if (pairs == nullptr || ((*pairs)[a] >> b & 1) != 0) visit(bones[a], bones[b], box);
  });
  return moved.wider(by, kBlendRounding);
}

// Whether roundings may choose on which side of the sum a quaternion is added.
bool SkinBounds::in_doubt(std::span<const std::uint32_t> bones, std::span<const float> weights) const {
  constexpr double kLeastCosine = 1e-3;
  double sum[4] = {};
  for (std::size_t i = 0; i < bones.size() && is_dual(); ++i) {
    const auto& real = duals_[bones[i]].real;
    double along = 0, square = 0;
    for (int k = 0; k < 4; ++k) along += real[k] * sum[k], square += sum[k] * sum[k];
    if (weights[i] > 0 && std::abs(along) < kLeastCosine * std::sqrt(square)) return true;
    for (int k = 0; k < 4; ++k) sum[k] += (along < 0 ? -weights[i] : weights[i]) * real[k];
  }
  return false;
}

SkinBounds::Box SkinBounds::round(const wire::PackedFilm& film, const wire::NetPoint& point) const {
  const auto bones = film.bones_of(point.skin);
  const auto weights = film.weights_of(point.skin, 1);
  if (in_doubt(bones, weights)) return round(bones, point.place, point.place, nullptr);
  wire::Matrix sum{};
  shape::DualBlend<double> dual;
  for (std::size_t i = 0; i < bones.size(); ++i) {
    if (is_dual()) dual.add(duals_[bones[i]], weights[i]);
    for (std::size_t r = 0; r < 3 && !is_dual(); ++r)
      for (std::size_t c = 0; c < 4; ++c) sum.m[r][c] += double{weights[i]} * maps_[bones[i]].m[r][c];
  }
  if (is_dual()) dual.put(sum.m);
  Box box;
  for (std::size_t r = 0; r < 3; ++r)
    box.low[r] = box.high[r] =
        sum.m[r][0] * point.place[0] + sum.m[r][1] * point.place[1] + sum.m[r][2] * point.place[2] + sum.m[r][3];
  return box;
}

SkinBounds::Box SkinBounds::round(const ShapeBoxes& boxes, std::uint32_t shape) const {
  MovedBox moved;
  const auto of_bones = boxes.of_bones(shape);
  for (std::size_t bone = 0; bone < of_bones.size(); ++bone)
    if (!of_bones[bone].is_empty()) moved.add(maps_[bone], stretched(box_of(of_bones[bone])));
  if (!is_dual()) return moved.wider(0, kBlendRounding);
  std::ranges::fill(sides_, static_cast<signed char>(0));
  const double by = beyond(std::min<std::size_t>(of_bones.size(), wire::kMostPointBones), [&](const auto& visit) {
    for (const ShapeBoxes::Pair& pair : boxes.pairs(shape))
      visit(pair.bones[0], pair.bones[1], stretched(box_of(pair.box)));
  });
  return moved.wider(by, kBlendRounding);
}

}  // namespace mars::geometry
