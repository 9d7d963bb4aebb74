#include "node/group/passes.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "hal/collectives/group_sum.h"
#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "node/geometry/triangle.h"
#include "node/raster/edge_box.h"

namespace mars::group {
namespace {

// Bytes of edge boxes that travel with their triangles, at most; and of those that lie in their lines.
constexpr std::uint64_t kTravelling = sizeof(geometry::Triangle) + sizeof(raster::UnsortedEdgeBox);
constexpr std::uint64_t kInLine = sizeof(raster::EdgeBox);

std::uint64_t fixed_bytes(const FrameLoad& load) {
  return group::fixed_bytes(load.line_loads.size(), load.homes.size());
}

// At most, of a home on whose lines all nodes together have `boxes` edge boxes.
std::uint64_t received_bytes(const FrameLoad& load, std::uint64_t boxes) {
  return load.travels ? boxes * (kTravelling + kInLine) : 0;
}

// Of all nodes' triangles, on some lines.
std::uint64_t boxes_on(const FrameLoad& load, const geometry::LineRange& lines) {
  return load.ebc[lines.last] - load.ebc[lines.first];
}

// Of the node's own triangles, on all lines of a pass.
std::uint64_t own_boxes_in(const FrameLoad& load, const Pass& pass) {
  std::uint64_t boxes = 0;
  for (const geometry::LineRange& home : load.homes) {
    const geometry::LineRange part = part_of(home, pass);
    for (std::uint32_t line = part.first; line < part.last; ++line) boxes += load.line_loads[line].boxes();
  }
  return boxes;
}

const geometry::LineRange& home_of(const FrameLoad& load, int node) {
  return load.homes[static_cast<std::size_t>(node - load.group.first)];
}

// A triangle has at least one edge box.
std::uint64_t memory_in(const FrameLoad& load, int node, const Pass& pass) {
  const std::uint64_t own_boxes = own_boxes_in(load, pass), boxes = boxes_on(load, part_of(home_of(load, node), pass));
  return own_bytes({std::min(own_boxes, load.triangles), own_boxes}, load.travels) + received_bytes(load, boxes);
}

// By what every node knows of all.
bool one_pass_fits_all(const FrameLoad& load, std::uint64_t memory) {
  std::uint64_t most = 0;
  for (const geometry::LineRange& home : load.homes) most = std::max(most, boxes_on(load, home));
  return load.large == 0 && received_bytes(load, most) + fixed_bytes(load) <= memory / 2;
}

}  // namespace

geometry::LineRange part_of(const geometry::LineRange& home, const Pass& pass) {
  const auto at = [&](std::uint32_t number) {
    return home.first + static_cast<std::uint32_t>(std::uint64_t{home.count()} * number / pass.count);
  };
  return {at(pass.number), at(pass.number + 1)};
}

void mark_lines(std::span<const geometry::LineRange> homes, const Pass& pass, std::span<std::uint8_t> wanted) {
  std::ranges::fill(wanted, std::uint8_t{0});
  for (const geometry::LineRange& home : homes) {
    const geometry::LineRange part = part_of(home, pass);
    std::ranges::fill(wanted.subspan(part.first, part.count()), std::uint8_t{1});
  }
}

std::uint64_t own_bytes(const MadeCounts& made, bool travels) {
  const std::uint64_t a_box = sizeof(raster::UnsortedEdgeBox) + kInLine + (travels ? kTravelling : 0);
  return made.triangles * sizeof(geometry::Triangle) + made.edge_boxes * a_box;
}

bool is_large(std::uint64_t own_bytes, std::uint64_t memory) { return own_bytes > memory / 2; }

std::uint64_t fixed_bytes(std::size_t lines, std::size_t nodes) { return 2 * 32 * lines + 512 * nodes + 4096; }

std::uint64_t memory_for(const FrameLoad& load, int node, std::uint32_t passes) {
  std::uint64_t most = 0;
  for (std::uint32_t number = 0; number < passes; ++number)
    most = std::max(most, memory_in(load, node, {number, passes}));
  return most + fixed_bytes(load);
}

std::uint32_t passes_for(const FrameLoad& load, int node, std::uint64_t memory) {
  const std::uint64_t height = load.line_loads.size();
  std::uint32_t passes = 1;
  while (memory_for(load, node, passes) > memory && passes < 2 * height) passes *= 2;
  if (const std::uint64_t needed = memory_for(load, node, passes); needed > memory)
    throw Failure("one line's edge boxes need " + std::to_string((needed >> 20) + 1) + " MiB, but a frame has " +
                      std::to_string(memory >> 20) + " MiB",
                  "memory", "set MARS_MEMORY to more MiB");
  return passes;
}

void wait_for_all(const collectives::Group& group) {
  std::uint64_t nothing = 0, work = 0;
  if (group.count > 1) collectives::group_high(group, {&nothing, 1}, {&work, 1});
}

std::uint32_t agree_on_passes(const FrameLoad& load, std::uint64_t memory) {
  if (one_pass_fits_all(load, memory)) return 1;
  std::uint64_t most = passes_for(load, static_cast<int>(mynode()), memory), work = 0;
  if (load.group.count > 1) collectives::group_high(load.group, {&most, 1}, {&work, 1});
  if (most < 1 || most > 4 * load.line_loads.size())
    throw Failure("nodes' counts of passes make no sense", "", "please report it");
  return static_cast<std::uint32_t>(most);
}

}  // namespace mars::group
