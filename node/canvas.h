// What a node has of one scene that it draws: the scene, and all that is of the size of its pictures. A film has one,
// each of a studio's views its own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "node/geometry/scene.h"
#include "node/geometry/surface_view.h"
#include "node/geometry/sweep.h"
#include "node/group/exchange.h"
#include "node/group/group_sums.h"
#include "node/group/still_exchange.h"
#include "node/group/team_lines.h"
#include "node/raster/neighbours.h"
#include "node/raster/scanline.h"
#include "node/raster/still_lines.h"
#include "node/shadow/shadow_painter.h"

namespace mars::node {

struct Canvas {
  // Bytes, as in Load.
  struct Memory {
    std::uint64_t still;
    std::uint64_t shadows;

    bool operator==(const Memory&) const = default;
  };

  // The film's block, or a scene's, and `neighbours` outlive it. Collective over a machine's nodes.
  Canvas(const wire::PackedFilm& film, const raster::Neighbours& neighbours, const Memory& memory,
         simd::InstructionSet set, bool has_layers = false);

  geometry::Scene scene;
  raster::ZBuffer z_buffer;
  std::optional<geometry::SurfaceView> surfaces;  // of pictures with layers
  std::optional<shadow::ShadowPainter> shadows;   // where lights cast
  raster::StillLines still;
  group::GroupSums sums;
  group::TriangleExchange triangle_exchange;
  group::StillExchange still_exchange;
  group::TeamLines team_lines;

  // Of the current interval.
  geometry::Sweep sweep;                  // empty where moving parts may be anywhere
  std::vector<std::uint8_t> contributes;  // 1: the node draws inbetweens; by nodes of the group

  group::ExchangeRecord exchange_record;  // of keyframes so far

  // Of the current frame, by line.
  std::vector<raster::LineLoad> line_loads;      // of own triangles
  std::vector<raster::LineLoad> other_loads;     // of others', made again
  std::vector<std::uint64_t> line_totals;        // of their edge boxes, before each line and at the end
  std::vector<std::uint64_t> awaited;            // edge boxes of other nodes that are to come
  std::vector<std::uint64_t> still_bytes;        // that are kept for inbetweens, about
  std::vector<std::uint8_t> wanted_lines;        // in the current pass
  std::vector<std::uint8_t> wanted_still_lines;  // of stationary parts in an inbetween
};

}  // namespace mars::node
