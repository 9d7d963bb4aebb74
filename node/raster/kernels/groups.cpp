// The groups of a line's samples, and the sums of their light.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "node/raster/kernels/functions.h"

namespace mars::raster::MARS_SET {

using namespace simd::MARS_SET;

namespace {

using NumberTag = hn::RebindToUnsigned<FloatTag>;
using Numbers = hn::Vec<NumberTag>;
constexpr NumberTag kNumbers;

std::uint32_t bits(hn::Mask<NumberTag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kNumbers, mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

// Which of a vector's pixels, and as bits.
struct Lanes {
  explicit Lanes(hn::Mask<NumberTag> lanes) : mask(lanes), bits(MARS_SET::bits(lanes)) {}

  std::uint32_t count() const { return static_cast<std::uint32_t>(std::popcount(bits)); }

  hn::Mask<NumberTag> mask;
  std::uint32_t bits;
};

// One group in each of some pixels of a vector.
struct GroupLanes {
  Numbers triangles;
  Numbers places;  // column | sample << 16
  Numbers masks;

  void store(const Lanes& lanes, std::uint32_t at, const Groups& out) const {
    static_assert(offsetof(shading::Fragment, column) == 4 && offsetof(shading::Fragment, sample) == 6);
    hn::StoreInterleaved2(hn::Compress(triangles, lanes.mask), hn::Compress(places, lanes.mask), kNumbers,
                          reinterpret_cast<std::uint32_t*>(out.fragments + at));
    hn::StoreU(hn::Compress(masks, lanes.mask), kNumbers, out.masks + at);
  }
};

// Grows by the groups of a vector of pixels at a time.
class Grouping {
 public:
  // Others are collected from `others_at` on, behind all first groups.
  Grouping(const shape::SamplePattern& pattern, std::uint32_t others_at, const Groups& out)
      : samples_(static_cast<std::uint32_t>(pattern.count)),
        by_distance_(pattern.by_distance),
        others_at_(others_at),
        out_(out) {}

  // Of pixels from `column` on, which show triangles[sample].
  void add(std::uint32_t column, const Numbers* triangles) {
    const Numbers none = hn::Set(kNumbers, shading::kNoTriangle), columns = hn::Iota(kNumbers, column);
    Numbers grouped = hn::Zero(kNumbers);  // samples that are in a group or show nothing
    for (std::uint32_t s = 0; s < samples_; ++s)
      grouped = hn::Or(grouped, hn::IfThenElseZero(hn::Eq(triangles[s], none), bit(s)));
    const Lanes shown(hn::Ne(grouped, all()));
    GroupLanes first{none, columns, hn::Zero(kNumbers)};
    auto has_first = hn::Ne(columns, columns);
    for (std::uint32_t k = 0; k < samples_; ++k) {
      const std::uint32_t s = by_distance_[k];
      const auto begins = hn::Eq(hn::And(grouped, bit(s)), hn::Zero(kNumbers));
      if (hn::AllFalse(kNumbers, begins)) continue;
      const GroupLanes here{triangles[s], hn::Or(columns, hn::Set(kNumbers, s << 16)), samples_like(k, triangles)};
      grouped = hn::IfThenElse(begins, hn::Or(grouped, here.masks), grouped);
      const auto is_first = hn::AndNot(has_first, begins);
      first = {hn::IfThenElse(is_first, here.triangles, first.triangles),
               hn::IfThenElse(is_first, here.places, first.places), hn::IfThenElse(is_first, here.masks, first.masks)};
      add_others(Lanes(hn::And(has_first, begins)), here, shown);
      has_first = hn::Or(has_first, begins);
    }
    first.store(shown, counts_.pixels, out_);
    counts_.pixels += shown.count();
  }

  // The same where each pixel has one group, of all its samples.
  void add_whole(std::uint32_t column, Numbers triangles) {
    const Numbers places = hn::Or(hn::Iota(kNumbers, column), hn::Set(kNumbers, by_distance_[0] << 16));
    GroupLanes{triangles, places, all()}.store(Lanes(hn::Eq(triangles, triangles)), counts_.pixels, out_);
    counts_.pixels += kLanes;
  }

  GroupCounts finish() {
    const auto move = [&](auto* items) {
      std::memmove(items + counts_.pixels, items + others_at_, counts_.others * sizeof *items);
    };
    move(out_.fragments);
    move(out_.masks);
    move(out_.pixels);
    return counts_;
  }

 private:
  static Numbers bit(std::uint32_t sample) { return hn::Set(kNumbers, 1u << sample); }
  Numbers all() const { return hn::Set(kNumbers, (1u << samples_) - 1); }

  // Of the k-th sample by distance and those farther from the centre, the ones that show its triangle.
  Numbers samples_like(std::uint32_t k, const Numbers* triangles) const {
    const Numbers triangle = triangles[by_distance_[k]];
    Numbers samples = bit(by_distance_[k]);
    while (++k < samples_) {
      const std::uint32_t s = by_distance_[k];
      samples = hn::Or(samples, hn::IfThenElseZero(hn::Eq(triangles[s], triangle), bit(s)));
    }
    return samples;
  }

  void add_others(const Lanes& lanes, const GroupLanes& groups, const Lanes& shown) {
    if (lanes.bits == 0) return;
    const std::uint32_t at = others_at_ + counts_.others;
    groups.store(lanes, at, out_);
    std::uint32_t* pixel = out_.pixels + at;
    for (std::uint32_t left = lanes.bits; left != 0; left &= left - 1) {
      const std::uint32_t before = shown.bits & ((left & -left) - 1);
      *pixel++ = counts_.pixels + static_cast<std::uint32_t>(std::popcount(before));
    }
    counts_.others += lanes.count();
  }

  const std::uint32_t samples_;
  const std::uint8_t* const by_distance_;
  const std::uint32_t others_at_;
  const Groups out_;
  GroupCounts counts_{0, 0};
};

// By each pixel's masks: the share of samples that are in it.
Floats share(Numbers masks, Floats a_sample) {
  return hn::Mul(hn::ConvertTo(kFloats, hn::BitCast(kInts, hn::PopulationCount(masks))), a_sample);
}

}  // namespace

GroupCounts group(const shape::SamplePattern& pattern, const LineSamples& seen, shading::Extent extent,
                  const Groups& out) {
  const auto samples = static_cast<std::uint32_t>(pattern.count);
  Grouping grouping(pattern, extent.last - extent.first + simd::kVectorSlack, out);
  const Numbers none = hn::Set(kNumbers, shading::kNoTriangle);
  for (std::uint32_t column = extent.first; column < extent.last; column += kLanes) {
    Numbers triangles[shape::kMostSamples];
    auto same = hn::Eq(none, none);
    for (std::uint32_t s = 0; s < samples; ++s) {
      triangles[s] = hn::LoadU(kNumbers, seen.ids + s * seen.stride + column);
      same = hn::And(same, hn::Eq(triangles[s], triangles[0]));
    }
    const auto empty = hn::And(same, hn::Eq(triangles[0], none));
    if (hn::AllTrue(kNumbers, hn::AndNot(empty, same)))
      grouping.add_whole(column, triangles[0]);
    else if (!hn::AllTrue(kNumbers, empty))
      grouping.add(column, triangles);
  }
  return grouping.finish();
}

void add_groups(const Groups& groups, const GroupCounts& counts, std::uint32_t samples, const Light& light) {
  const Floats a_sample = hn::Set(kFloats, 1.0f / static_cast<float>(samples));
  for (std::uint32_t k = 0; k < counts.pixels + counts.others; k += kLanes) {
    const Floats weight = share(hn::LoadU(kNumbers, groups.masks + k), a_sample);
    for (float* const channel : light.channel)
      hn::StoreU(hn::Mul(weight, hn::LoadU(kFloats, channel + k)), kFloats, channel + k);
  }
  for (std::uint32_t k = counts.pixels; k < counts.pixels + counts.others; ++k) {
    const std::uint32_t pixel = groups.pixels[k];
    for (float* const channel : light.channel) channel[pixel] += channel[k];
    groups.masks[pixel] |= groups.masks[k];
  }
}

void add_background(const std::uint32_t* masks, std::uint32_t pixels, std::uint32_t samples, const float* background,
                    const Light& light) {
  const Floats a_sample = hn::Set(kFloats, 1.0f / static_cast<float>(samples));
  const Numbers all = hn::Set(kNumbers, (1u << samples) - 1);
  for (std::uint32_t k = 0; k < pixels; k += kLanes) {
    const Numbers left = hn::AndNot(hn::LoadU(kNumbers, masks + k), all);
    if (hn::AllTrue(kNumbers, hn::Eq(left, hn::Zero(kNumbers)))) continue;
    const Floats weight = share(left, a_sample);
    for (int c = 0; c < 3; ++c) {
      float* const here = light.channel[c] + k;
      hn::StoreU(hn::Add(hn::LoadU(kFloats, here), hn::Mul(weight, hn::Set(kFloats, background[c]))), kFloats, here);
    }
  }
}

}  // namespace mars::raster::MARS_SET
