#include "host/render/farm/schedule.h"

#include <algorithm>

namespace mars::host {
namespace {

constexpr std::size_t kUnitsPerCube = 4;

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

std::vector<hal::Cube> make_cubes(int nodes, int cubes, std::size_t units) {
  const int that_pay = static_cast<int>(std::min<std::size_t>(units / kUnitsPerCube, static_cast<std::size_t>(nodes)));
  const int count = std::clamp(cubes == 0 ? that_pay : cubes, 1, nodes);
  std::vector<hal::Cube> out;
  for (int i = 0; i < count; ++i) out.push_back(hal::cube_of(nodes, count, i));
  return out;
}

}  // namespace mars::host
