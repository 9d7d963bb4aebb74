// What the nodes of a group have to do for a keyframe, by counts alone.
#include <algorithm>
#include <cmath>
#include <span>

#include "host/experiments/forecast/frame_costs.h"
#include "node/wire/still_plan.h"

namespace mars::forecast {
namespace {

using wire::Work;

constexpr double kFullStrip = 512 << 10;  // node/raster/strip_buffer.cpp
constexpr std::uint32_t kLinesABeat = 4;  // node/renderer.cpp

// The work of which a surface has `bent` units; none of those that do not bend.
Work bending_of(wire::SurfaceKind kind) {
  if (kind == wire::SurfaceKind::dual_meshlet) return Work::dual_weight;
  return is_meshlet(kind) ? Work::skin_weight : Work::net_term;
}

}  // namespace

KeyframeLoad FrameCosts::load(const KeyframeCounts& counts, const SurfaceTable& surfaces,
                              const KeyframeGroup& group) const {
  KeyframeLoad load;
  load.nodes.resize(static_cast<std::size_t>(group.count()));
  map_lines(load, counts, group);
  add_made(load, counts, surfaces, group.contributors);
  if (group.contributors > nodes_on_a_computer(group.count())) add_exchange(load, counts, surfaces, group);
  for (std::size_t n = 0; n < load.nodes.size(); ++n) {
    NodeLoad& node = load.nodes[n];
    const geometry::LineRange& home = load.homes[n];
    node.memory = std::min(node.memory, arena_bytes());
    node.drawn = drawn_in_keyframe(node.seen, counts, home);
    node.casters = casters(node.seen, counts, home, group.contributors);
    if (n < static_cast<std::size_t>(group.contributors)) node.strips = strip_sizes(counts, home);
    if (group.count() > 1 && group.has_inbetweens()) load.still.push_back(still_messages(home, counts));
    if (setting_.nodes_write()) load.bands.push_back(bands_of(load.homes, n, counts, group.has_inbetweens()));
  }
  return load;
}

// The lines of each node, and what is on them.
void FrameCosts::map_lines(KeyframeLoad& load, const KeyframeCounts& counts, const KeyframeGroup& group) const {
  load.homes.resize(load.nodes.size(), geometry::LineRange{0, 0});
  group::map_lines(setting_.mapping, line_weights(counts, group.has_inbetweens()),
                   std::span(load.homes).first(static_cast<std::size_t>(group.contributors)));
  const auto height = static_cast<std::uint32_t>(counts.lines.size());
  std::fill(load.homes.begin() + group.contributors, load.homes.end(), geometry::LineRange{height, height});
  for (std::size_t n = 0; n < load.nodes.size(); ++n)
    load.nodes[n].seen = totals_on(counts, load.homes[n].first, load.homes[n].last, band_lines_);
}

// As nodes weigh lines (node/group/group_sums.h), which know what is kept but for its groups.
std::vector<std::uint64_t> FrameCosts::line_weights(const wire::FrameCounts& counts, bool has_inbetweens) const {
  const std::uint32_t samples = setting_.film.settings().samples, casting = setting_.film.casting_count();
  const std::size_t group = wire::still_group_bytes(casting) + wire::surface_bytes(setting_.has_layers());
  const double column =
      has_groups() ? static_cast<double>(wire::still_column_bytes(samples, casting) + group) : sizeof(float);
  std::vector<std::uint64_t> weights{0};
  for (const wire::LineCounts& line : counts.lines) {
    const raster::LineLoad load(static_cast<std::uint64_t>(line.edge_boxes), static_cast<std::uint64_t>(line.samples));
    const double still = has_inbetweens ? line.swept_width * column : 0;
    const std::uint64_t cost = group::line_cost(load, static_cast<std::uint64_t>(still));
    weights.push_back(weights.back() + (setting_.mapping == wire::Mapping::cost ? cost : load.boxes()));
  }
  return weights;
}

// Whole patches and meshlets, divided among contributors; passes, where memory is short.
void FrameCosts::add_made(KeyframeLoad& load, const KeyframeCounts& counts, const SurfaceTable& surfaces,
                          int contributors) const {
  for (const PlacedSurface& placed : counts.placed) {
    const wire::MadeSurface& surface = surfaces[placed.surface];
    wire::UnitCounts& made = load.nodes[placed.number % static_cast<std::uint32_t>(contributors)].made;
    add_diced(made, surface);
    made[Work::triangle] += surface.triangles;
    made[Work::edge_box_made] += surface.edge_boxes;
  }
  const auto nodes = static_cast<int>(load.nodes.size());
  const bool travels = nodes > nodes_on_a_computer(nodes);
  for (NodeLoad& node : load.nodes) {
    load.passes = std::max(load.passes, passes(node.made, node.seen.drawn.edge_boxes, travels));
    node.memory = made_bytes(node.made);
    node.made_memory = std::min(arena_bytes(), fresh_bytes(node.made));
  }
}

// But for its triangles that are set up.
void FrameCosts::add_diced(wire::UnitCounts& units, const wire::MadeSurface& surface) const {
  const auto samples = static_cast<double>(setting_.film.settings().samples);
  const auto lights = static_cast<double>(lights_);
  units[is_meshlet(surface.kind) ? Work::meshlet : Work::patch] += 1;
  units[is_meshlet(surface.kind) ? Work::mesh_vertex : Work::vertex] += surface.vertices;
  units[bending_of(surface.kind)] += surface.bent;
  units[Work::triangle_tested] += surface.triangles_tested;
  units[Work::row_tested] += surface.triangles_tested * samples;
  units[Work::vertex_light] += surface.colored * lights;
}

// As node/group/passes.h bounds them.
double FrameCosts::passes(const wire::UnitCounts& made, double home_boxes, bool travels) const {
  const double a_box = kTriangleBytes + kUnsortedBoxBytes;
  const double bound =
      made_bytes(made) + (travels ? made[Work::edge_box_made] * a_box + home_boxes * (a_box + kBoxBytes) : 0);
  double passes = 1;
  while (bound / passes > arena_bytes() && passes < height()) passes *= 2;
  return passes;
}

wire::UnitCounts FrameCosts::drawn_in_keyframe(const FrameTotals& seen, const wire::FrameCounts& counts,
                                               const geometry::LineRange& lines) const {
  wire::UnitCounts units = drawn_units(seen);
  for (std::uint32_t i = lines.first; i < lines.last; ++i) {
    const wire::LineCounts& line = counts.lines[i];
    const bool needed = counts.first_still_line <= i && i < counts.last_still_line;
    units[Work::line] += needed || line.edge_boxes > 0 ? 1 : 0;
    if (needed) units[Work::still_byte] += kept_bytes(line);
  }
  return units;
}

// `nodes` share the dicing for the camera. Other casters are diced again for each band of lines.
wire::UnitCounts FrameCosts::casters(const FrameTotals& seen, const wire::FrameCounts& counts,
                                     const geometry::LineRange& lines, int nodes) const {
  wire::UnitCounts units;
  if (setting_.film.casting_count() == 0 || lines.count() == 0) return units;
  const double band = lines_of_band(seen, lines.count());
  for (double first = lines.first; first < lines.last; first += band)
    units = units + casters_on(counts, static_cast<std::uint32_t>(first),
                               static_cast<std::uint32_t>(std::min<double>(lines.last, first + band)), nodes);
  return units;
}

// As many as there is memory for: groups with their light, depths and pairs (node/shadow/shadow_painter.cpp), and
// points.
double FrameCosts::lines_of_band(const FrameTotals& totals, double lines) const {
  const wire::FilmSettings& film = setting_.film.settings();
  const double casting = setting_.film.casting_count(), samples = static_cast<double>(film.width) * film.samples;
  const double light = (4 + 3 * casting) * sizeof(float), group = 16 + light;
  const double record = static_cast<double>(wire::still_group_bytes(setting_.film.casting_count()) +
                                            wire::surface_bytes(setting_.has_layers()));
  const double column = sizeof(std::uint32_t) + casting * 2 * (sizeof(wire::StillPairs) + sizeof(std::uint16_t));
  const shadow::ShadowNeeds needs = shadow::shadow_needs(setting_.film, setting_.has_layers());
  const shadow::ShadowPlan plan = shadow::plan_shadows(needs, memory_.shadows);
  const double shaded = totals.drawn.constant.shaded + totals.drawn.moving.shaded;
  const double each = shaded / lines * (group + record) + samples * sizeof(float) + film.width * column / 2;
  const double seen = std::floor(static_cast<double>(plan.band - shadow::band_bytes_of_line(needs)) / each);
  return std::max(1.0, std::min<double>(seen, shadow::lines_of_points(needs, plan.points)));
}

// Full ones, and the rest.
std::vector<double> FrameCosts::strip_sizes(double bytes) const {
  std::vector<double> sizes;
  for (; bytes > kFullStrip; bytes -= kFullStrip) sizes.push_back(kFullStrip);
  sizes.push_back(bytes);
  return sizes;
}

// A strip ends after some lines.
std::vector<double> FrameCosts::strip_sizes(const wire::FrameCounts& counts, const geometry::LineRange& lines) const {
  std::vector<double> sizes{0};
  const double full = kFullStrip - sizeof(wire::Strip);
  for (std::uint32_t line = lines.first; line < lines.last; ++line) {
    if (sizes.back() >= full && (line - lines.first) % kLinesABeat == 0) sizes.push_back(0);
    sizes.back() += strip_bytes(counts.lines[line]);
  }
  return sizes;
}

}  // namespace mars::forecast
