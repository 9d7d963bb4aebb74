#include "host/render/farm/schedule.h"

#include <algorithm>

namespace mars::host {
namespace {

constexpr std::size_t kUnitsPerGroup = 4;

}  // namespace

std::vector<Unit> make_units(const node::FilmView& film, std::span<const std::uint32_t> frames, bool coherence) {
  std::vector<Unit> units;
  std::uint64_t inbetweens = 0;
  std::uint32_t interval = 0;
  for (const std::uint32_t frame : frames) {
    const auto end = [&] { return film.intervals()[interval].first_frame + film.intervals()[interval].frame_count; };
    while (frame >= end()) ++interval;
    const bool goes_on = coherence && !units.empty() && units.back().interval == interval;
    if (goes_on)
      ++inbetweens;
    else
      units.push_back({interval, {}, inbetweens});
    units.back().frames.push_back(frame);
  }
  return units;
}

std::vector<hal::Group> make_groups(int nodes, int groups, std::size_t units) {
  const int that_pay = static_cast<int>(std::min<std::size_t>(units / kUnitsPerGroup, static_cast<std::size_t>(nodes)));
  const int count = std::clamp(groups == 0 ? that_pay : groups, 1, nodes);
  std::vector<hal::Group> out;
  for (int i = 0; i < count; ++i) out.push_back(hal::group_of(nodes, count, i));
  return out;
}

}  // namespace mars::host
