#include "host/experiments/forecast/surface_table.h"

#include <algorithm>
#include <cstring>

namespace mars::forecast {
namespace {

// Plain numbers, without gaps.
template <typename Item>
std::span<const std::uint32_t> words(std::span<const Item> items) {
  static_assert(sizeof(Item) % sizeof(std::uint32_t) == 0);
  return {reinterpret_cast<const std::uint32_t*>(items.data()), items.size_bytes() / sizeof(std::uint32_t)};
}

std::uint64_t mixed(std::uint64_t hash, std::span<const std::uint32_t> words) {
  for (const std::uint32_t word : words) hash = (hash ^ word) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
  return hash;
}

template <typename Item>
bool same(std::span<const Item> a, std::span<const Item> b) {
  return std::ranges::equal(words(a), words(b));
}

}  // namespace

std::uint32_t SurfaceTable::add(wire::MadeSurface surface, std::span<const wire::SurfaceLine> lines) {
  surface.number = 0;
  const std::uint64_t hash = mixed(mixed(0, words(std::span<const wire::MadeSurface>(&surface, 1))), words(lines));
  const auto [first, last] = places_.equal_range(hash);
  for (auto known = first; known != last; ++known)
    if (is(known->second, surface, lines)) return known->second;
  const auto place = static_cast<std::uint32_t>(surfaces_.size());
  surfaces_.push_back(surface);
  lines_at_.push_back(lines_.size());
  lines_.insert(lines_.end(), lines.begin(), lines.end());
  places_.emplace(hash, place);
  return place;
}

bool SurfaceTable::is(std::uint32_t place, const wire::MadeSurface& surface,
                      std::span<const wire::SurfaceLine> lines) const {
  const std::span<const wire::MadeSurface> there(&surfaces_[place], 1), here(&surface, 1);
  return same(there, here) && same(this->lines(place), lines);
}

}  // namespace mars::forecast
