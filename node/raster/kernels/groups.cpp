// The groups of a line's samples, and the sums of their light.
#include <bit>
#include <cstddef>
#include <cstdint>

#include "node/raster/kernels/functions.h"

namespace mars::raster::MARS_SET {

using namespace simd::MARS_SET;

namespace {

using NumberTag = hn::RebindToUnsigned<FloatTag>;
using Numbers = hn::Vec<NumberTag>;
constexpr NumberTag kNumbers;

// Grows by groups, column by column.
class Grouping {
 public:
  Grouping(const shape::SamplePattern& pattern, const LineSamples& seen, const Groups& out)
      : samples_(static_cast<std::uint32_t>(pattern.count)), seen_(seen), out_(out) {}

  // A vector of pixels from `column` on, each of one group.
  void add_whole(std::uint32_t column, Numbers triangles) {
    const Numbers columns = hn::Add(hn::Iota(kNumbers, 0), hn::Set(kNumbers, column));  // and sample 0
    static_assert(offsetof(shading::Fragment, column) == 4 && offsetof(shading::Fragment, sample) == 6);
    hn::StoreInterleaved2(triangles, columns, kNumbers,
                          reinterpret_cast<std::uint32_t*>(out_.fragments + counts_.pixels));
    hn::StoreU(hn::Set(kNumbers, all()), kNumbers, out_.masks + counts_.pixels);
    counts_.pixels += kLanes;
  }

  // As many pixels from `column` on; `same`: one bit for each whose samples all show the same.
  void add_mixed(std::uint32_t column, std::uint32_t same) {
    for (const std::uint32_t end = column + kLanes; column < end; ++column, same >>= 1) {
      if ((same & 1) == 0)
        add_pixel(column);
      else if (seen_.ids[column] != shading::kNoTriangle)
        put({seen_.ids[column], static_cast<std::uint16_t>(column), 0}, all(), counts_.pixels++);
    }
  }

  // One pixel of any groups.
  void add_pixel(std::uint32_t column) {
    std::uint32_t triangles[shape::kMostSamples];
    for (std::uint32_t s = 0; s < samples_; ++s) triangles[s] = seen_.ids[s * seen_.stride + column];
    bool first = true;
    for (std::uint32_t left = all(); left != 0;) {
      const auto sample = static_cast<std::uint32_t>(std::countr_zero(left));
      const std::uint32_t triangle = triangles[sample];
      std::uint32_t mask = 0;
      for (std::uint32_t s = sample; s < samples_; ++s) mask |= std::uint32_t{triangles[s] == triangle} << s;
      left &= ~mask;
      if (triangle == shading::kNoTriangle) continue;
      const shading::Fragment fragment{triangle, static_cast<std::uint16_t>(column),
                                       static_cast<std::uint16_t>(sample)};
      if (first)
        put(fragment, mask, counts_.pixels++);
      else
        put_other(fragment, mask);
      first = false;
    }
  }

  // The others behind the first groups.
  GroupCounts finish(std::uint32_t others_at) {
    for (std::uint32_t k = 0; k < counts_.others; ++k) {
      const std::uint32_t to = counts_.pixels + k, from = others_at + k;
      out_.fragments[to] = out_.fragments[from];
      out_.masks[to] = out_.masks[from];
      out_.pixels[to] = out_.pixels[from];
    }
    return counts_;
  }

  void begin_others(std::uint32_t at) { others_at_ = at; }
  std::uint32_t all() const { return (1u << samples_) - 1; }

 private:
  void put(const shading::Fragment& fragment, std::uint32_t mask, std::uint32_t at) {
    out_.fragments[at] = fragment;
    out_.masks[at] = mask;
  }
  void put_other(const shading::Fragment& fragment, std::uint32_t mask) {
    const std::uint32_t at = others_at_ + counts_.others++;
    put(fragment, mask, at);
    out_.pixels[at] = counts_.pixels - 1;
  }

  const std::uint32_t samples_;
  const LineSamples seen_;
  const Groups out_;
  std::uint32_t others_at_ = 0;
  GroupCounts counts_{0, 0};
};

std::uint32_t bits(hn::Mask<NumberTag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kNumbers, mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

// By each pixel's masks: the share of samples that are in it.
Floats share(Numbers masks, Floats a_sample) {
  return hn::Mul(hn::ConvertTo(kFloats, hn::BitCast(kInts, hn::PopulationCount(masks))), a_sample);
}

}  // namespace

GroupCounts group(const shape::SamplePattern& pattern, const LineSamples& seen, shading::Extent extent,
                  const Groups& out) {
  Grouping grouping(pattern, seen, out);
  // There are at most as many first groups as columns.
  const std::uint32_t others_at = extent.last - extent.first + simd::kVectorSlack;
  grouping.begin_others(others_at);
  const Numbers none = hn::Set(kNumbers, shading::kNoTriangle);
  std::uint32_t column = extent.first;
  for (; column + kLanes <= extent.last; column += kLanes) {
    const Numbers first = hn::LoadU(kNumbers, seen.ids + column);
    auto same = hn::Eq(first, first);
    for (std::int32_t s = 1; s < pattern.count; ++s)
      same = hn::And(
          same, hn::Eq(first, hn::LoadU(kNumbers, seen.ids + static_cast<std::uint32_t>(s) * seen.stride + column)));
    const auto empty = hn::And(same, hn::Eq(first, none));
    if (hn::AllTrue(kNumbers, hn::AndNot(empty, same))) {
      grouping.add_whole(column, first);
    } else if (!hn::AllTrue(kNumbers, empty)) {
      grouping.add_mixed(column, bits(same));
    }
  }
  for (; column < extent.last; ++column) grouping.add_pixel(column);
  return grouping.finish(others_at);
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
