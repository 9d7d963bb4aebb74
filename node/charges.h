// The work of a frame's phases, counted by kind (wire/work.h): what it costs is a platform's, for simulated machines
// and forecasts.
#pragma once

#include <cstdint>

#include "node/frame_report.h"
#include "node/geometry/line_range.h"
#include "node/geometry/scene.h"
#include "node/raster/scanline.h"
#include "node/shadow/shadow_caster.h"
#include "node/tessellator.h"
#include "node/wire/work.h"

namespace mars::node {

void charge_begin(FrameReport& report, const geometry::Scene& scene, bool is_first_frame);

// Of `tested` triangles.
void charge_tessellation(FrameReport& report, const geometry::Scene& scene, const Tessellation& made,
                         std::uint64_t tested);

struct LinesDrawn {
  geometry::LineRange lines;
  raster::LineParts parts;  // their edge boxes
  std::uint64_t samples;    // those edge boxes cover
  raster::DrawnCounts counts;
};
// But for pixels.
void charge_lines(FrameReport& report, const geometry::Scene& scene, const LinesDrawn& drawn);

void charge_shadows(FrameReport& report, const shadow::CastCounts& counts);

}  // namespace mars::node
