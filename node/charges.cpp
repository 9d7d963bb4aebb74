#include "node/charges.h"

namespace mars::node {

void charge_begin(FrameReport& report, const geometry::Scene& scene, bool is_first_frame) {
  report.charge(wire::Work::first_frame, is_first_frame ? 1 : 0);
  report.charge(wire::Work::frame, 1);
  report.charge(wire::Work::segment, scene.film().segments().size() + scene.film().bones().size());
}

void charge_tessellation(FrameReport& report, const geometry::Scene& scene, const Tessellation& made,
                         std::uint64_t tested) {
  const auto charge = [&](wire::Work kind, std::uint64_t units) { report.charge(kind, units); };
  charge(wire::Work::patch, made.surfaces.patches);
  charge(wire::Work::meshlet, made.surfaces.meshlets);
  charge(wire::Work::vertex, made.surfaces.vertices);
  charge(wire::Work::mesh_vertex, made.surfaces.mesh_vertices);
  charge(wire::Work::net_term, made.surfaces.net_terms);
  charge(wire::Work::skin_weight, made.surfaces.skin_weights);
  charge(wire::Work::dual_weight, made.surfaces.dual_weights);
  charge(wire::Work::triangle_tested, tested);
  charge(wire::Work::row_tested, tested * static_cast<std::uint64_t>(scene.pattern().count));
  charge(wire::Work::triangle, made.made.triangles);
  charge(wire::Work::edge_box_made, made.made.edge_boxes);
  charge(wire::Work::vertex_light, made.surfaces.colored * scene.lights().size());
}

void charge_lines(FrameReport& report, const geometry::Scene& scene, const LinesDrawn& drawn) {
  const auto charge = [&](wire::Work kind, std::uint64_t units) { report.charge(kind, units); };
  std::uint64_t boxes = 0;
  for (const raster::LineBoxes& part : drawn.parts) boxes += part.count(drawn.lines);
  charge(wire::Work::line, drawn.counts.lines);
  charge(wire::Work::edge_box, boxes);
  charge(wire::Work::sample, drawn.samples);
  charge(wire::Work::shaded, drawn.counts.shaded.samples);
  charge(wire::Work::light, drawn.counts.shaded.highlights * scene.lights().size());
  charge(wire::Work::facet_light, drawn.counts.shaded.facets * scene.lights().size());
  charge(wire::Work::still_byte, drawn.counts.still_bytes);
  charge(wire::Work::casting_light, drawn.counts.shaded.samples * scene.casting_count());
}

void charge_shadows(FrameReport& report, const shadow::CastCounts& counts) {
  report.charge(wire::Work::shadow_point, counts.points);
  report.charge(wire::Work::caster, counts.surfaces);
  report.charge(wire::Work::diced_vertex, counts.diced_vertices);
  report.charge(wire::Work::caster_vertex, counts.vertices);
  report.charge(wire::Work::caster_triangle, counts.triangles);
}

}  // namespace mars::node
