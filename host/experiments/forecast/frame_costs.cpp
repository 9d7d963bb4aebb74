#include "host/experiments/forecast/frame_costs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>

#include "host/images/picture_bands.h"

namespace mars::forecast {
namespace {

using wire::Work;

// As nodes have them in memory and send them (node/geometry/triangle.h, node/raster/edge_box.h).
constexpr double kTriangleBytes = 64, kUnsortedBoxBytes = 12, kBoxBytes = 8;
constexpr double kFullStrip = 512 << 10;  // node/raster/strip_buffer.cpp
constexpr double kShortSum = 64 << 10;    // hal/collectives/reduction.cpp
// Of a shared inbetween: the largest part over the mean, by lines, and by bands of a file that are no more than nodes;
// the most memory of a node over that of its part; lines by which a patch's box is too tall, and its points.
constexpr double kSharedUnevenly = 1.1, kBandsUnevenly = 1.6, kMemoryUnevenly = 1.3, kBoxMargin = 5, kBoxPoints = 16;

// What each of `nodes` nodes makes: whole shares where these divide evenly, else equal parts of several.
std::vector<wire::UnitCounts> made_by(const std::vector<wire::UnitCounts>& shares, int nodes) {
  std::vector<wire::UnitCounts> made(static_cast<std::size_t>(nodes));
  // Numbers that are `share` modulo the number of shares are on nodes that are the same modulo `step`.
  const std::size_t step = std::gcd(shares.size(), made.size());
  const double part = static_cast<double>(step) / static_cast<double>(nodes);
  for (std::size_t node = 0; node < made.size(); ++node)
    for (std::size_t share = node % step; share < shares.size(); share += step)
      made[node] = made[node] + shares[share] * part;
  return made;
}

// Patches are not divided: a node that makes any of them makes whole ones.
wire::UnitCounts in_whole_patches(const wire::UnitCounts& made) {
  const double patches = made[Work::patch] + made[Work::meshlet];
  return patches > 0 ? made * (std::ceil(patches - 1e-6) / patches) : made;
}

// Bytes on the way until a computer has what all others send it. All send to the first computer first, so that the
// port of whoever sends `most` to each is busy with the computers before.
double bytes_until(std::size_t computer, double in, double most) {
  return in + most * static_cast<double>(std::max<std::size_t>(computer, 1) - 1);
}

}  // namespace

// The lines of each node of a group, and what is on them.
struct FrameCosts::Homes {
  Homes(const wire::FrameCounts& counts, int nodes, int contributors, wire::Mapping mapping, std::uint32_t samples,
        std::uint32_t band_lines)
      : ranges(static_cast<std::size_t>(nodes), geometry::LineRange{0, 0}) {
    const FrameTotals all = totals_of(counts, band_lines);
    std::vector<std::uint64_t> weights{0};
    for (const wire::LineCounts& line : counts.lines) {
      const raster::LineLoad load(static_cast<std::uint64_t>(line.edge_boxes),
                                  static_cast<std::uint64_t>(line.samples));
      weights.push_back(weights.back() + (mapping == wire::Mapping::cost ? group::line_cost(load) : load.boxes()));
    }
    group::map_lines(mapping, weights, std::span(ranges).first(static_cast<std::size_t>(contributors)));
    edge_boxes = all.drawn.edge_boxes;
    const double rows =
        all.made[Work::triangle] > 0 ? edge_boxes / all.made[Work::triangle] : 1;  // of samples, of a triangle
    const double taller = std::max(0.0, rows / samples - 1);                       // in lines
    for (const geometry::LineRange& range : ranges) {
      totals.push_back(totals_on(counts, range.first, range.last, band_lines));
      const double boxes = totals.back().drawn.edge_boxes;
      triangles.push_back(std::min(boxes, boxes / rows * (1 + taller / std::max(1u, range.count()))));
    }
  }

  std::vector<geometry::LineRange> ranges;
  std::vector<FrameTotals> totals;
  std::vector<double> triangles;  // with an edge box there
  double edge_boxes;              // on all
};

FrameCosts::FrameCosts(const Setting& setting, int nodes)
    : setting_(setting),
      costs_(setting.platform),
      memory_(farm::share_node_memory(setting.platform.memory, {}, setting.film.settings(),
                                      shadow::shadow_needs(setting.film),
                                      std::min(nodes, setting.platform.machine.nodes))),
      band_lines_(images::PictureBands(setting.picture, setting.film.settings().width, setting.film.settings().height)
                      .lines_a_band()) {}

GroupKeyframe FrameCosts::keyframe(const wire::FrameCounts& counts, int nodes, int contributors,
                                   std::size_t inbetweens) const {
  GroupKeyframe keyframe;
  keyframe.nodes.resize(static_cast<std::size_t>(nodes));
  auto made = made_by(counts.shares, contributors);
  made.resize(keyframe.nodes.size());
  const Homes homes(counts, nodes, contributors, setting_.mapping, setting_.film.settings().samples, band_lines_);
  add_dicing(keyframe, homes, made);
  if (nodes > 1) add_sum(keyframe, nodes);
  if (contributors > nodes_on_a_computer(nodes)) add_exchange(keyframe, homes, made, contributors);
  for (std::size_t n = 0; n < made.size(); ++n) {
    NodePart& node = keyframe.nodes[n];
    node.memory = std::min(node.memory, arena_bytes());
    node.strips = strips(homes.totals[n], keyframe_drawing(homes.totals[n], counts, homes.ranges[n]) +
                                              casting(homes.totals[n], counts, homes.ranges[n], contributors));
    node.compose = pasting(homes.totals[n]) + encoding(homes.ranges[n].count() + homes.totals[n].changed);
    if (inbetweens > 0) node.strips.pasting += saving(homes.totals[n]);
    if (n >= static_cast<std::size_t>(contributors)) node.strips = {0, 0, 0, 0};
  }
  if (inbetweens > 0) add_still(keyframe, homes, counts, inbetweens);
  if (setting_.nodes_write()) add_bands(keyframe, homes, counts, contributors, inbetweens);
  return keyframe;
}

// Bands that are encoded are not divided.
NodePart FrameCosts::inbetween(const FrameTotals& whole, const FrameTotals& whole_again, int sharers) const {
  const bool is_shared = sharers > 1;
  const FrameTotals totals = is_shared ? shared(whole, sharers) : whole;
  const FrameTotals again = is_shared ? shared(whole_again, sharers) : whole_again;
  const wire::UnitCounts made = totals.made + again.made;
  wire::UnitCounts units = drawn_units(totals + again);
  units[Work::line] = totals.lines + again.lines;
  units[Work::still_byte] = totals.drawn.moving_width * setting_.film.settings().samples * sizeof(float);
  NodePart part;
  part.dice = dicing(made) + setting_up(made) + costs_.of(Work::edge_box_filled, made[Work::edge_box_made]);
  part.exchange = costs_.of(Work::line_mapped, height());
  part.strips = strips(totals, costs_.of(units) + costs_.of(totals.casters));
  const double bands = whole.changed / band_lines_;
  const double changed = is_shared ? std::ceil(bands / sharers) * band_lines_ : whole.changed;
  part.compose = pasting(totals) + encoding(changed);
  if (is_shared) part.bytes_to_nodes = whole.changed / sharers * line_bytes() * setting_.platform.file_part;
  part.strips.pasting += costs_.of(Work::host_restored, totals.drawn.moving.block_pixels * pixel_bytes());
  part.memory = part.made_memory = std::min(arena_bytes(), made_bytes(made) * (is_shared ? kMemoryUnevenly : 1));
  return part;
}

// A node's part of what `sharers` divide by boxes round what they have (node/group/team_lines.h), and so less evenly
// than keyframes. Patches and triangles between two nodes' lines are made by both, and each meets all casters of
// shadows.
FrameTotals FrameCosts::shared(const FrameTotals& whole, int sharers) const {
  const wire::UnitCounts& made = whole.made;
  const double patches = made[Work::patch] + made[Work::meshlet], lines = std::max(1.0, whole.lines);
  double most = kSharedUnevenly / sharers;
  if (const double bands = std::ceil(whole.changed / band_lines_); setting_.nodes_write() && bands > 0) {
    const double few = std::min(1.0, sharers / bands);
    const double unevenly = kSharedUnevenly + (kBandsUnevenly - kSharedUnevenly) * few * few;
    most = std::max(most, unevenly / std::min<double>(sharers, bands));
  }
  most = std::min(most, 1.0);
  FrameTotals part = whole * most;
  part.casters = whole.casters;
  if (patches == 0 || made[Work::triangle] == 0) return part;
  const double rows = made[Work::edge_box_made] / made[Work::triangle] / setting_.film.settings().samples;
  const double height = rows * std::sqrt(made[Work::triangle_tested] / patches / 2) + kBoxMargin;
  const auto part_with = [&](double tall) { return std::min(1.0, most + tall / lines); };
  for (const Work kind : {Work::patch, Work::meshlet, Work::vertex, Work::mesh_vertex, Work::triangle_tested,
                          Work::row_tested, Work::vertex_light})
    part.made[kind] = made[kind] * part_with(height);
  part.made[Work::triangle] = made[Work::triangle] * part_with(rows);
  part.made[Work::vertex] += kBoxPoints * patches;
  return part;
}

// With files, the host's loop shows the background only on lines with moving parts; sinks do it on other lines of the
// bands that they encode.
HostCosts FrameCosts::host_costs(const TaskCounts& task, const wire::FrameCounts& keyframe) const {
  HostCosts costs{background(keyframe), {encoding(height()) + writing()}};
  double changed = 0;
  for (const FrameTotals& totals : task.inbetweens) {
    costs.files.push_back(encoding(totals.changed) + writing());
    changed += totals.changed / height();
  }
  if (setting_.files && !task.inbetweens.empty())
    costs.background *= changed / static_cast<double>(task.inbetweens.size());
  return costs;
}

// Seconds of the host, of a buffer that shows the keyframe's background for the first time.
double FrameCosts::background(const wire::FrameCounts& keyframe) const {
  const wire::SeenCounts seen = totals_of(keyframe, band_lines_).drawn.constant;
  return costs_.of(Work::host_restored, (seen.pixels + seen.block_pixels / 2) * pixel_bytes());
}

// CFB goes into the saved background too, whose blocks are plain before.
double FrameCosts::saving(const FrameTotals& totals) const {
  const wire::SeenCounts& seen = totals.drawn.constant;
  return costs_.of(Work::host_run, seen.runs) + costs_.of(Work::host_byte, seen.pixels * pixel_bytes()) +
         costs_.of(Work::host_restored, (seen.pixels + seen.block_pixels / 2) * pixel_bytes());
}

FrameTotals FrameCosts::drawn_again(const wire::FrameCounts& keyframe, int nodes) const {
  const wire::StillPlan plan = still_plan(nodes);
  FrameTotals again;
  double still_boxes = 0, moving_boxes = 0;
  for (std::uint32_t i = 0; i < keyframe.lines.size(); ++i) {
    const wire::LineCounts& line = keyframe.lines[i];
    const double still = line.edge_boxes - line.moving_edge_boxes;
    still_boxes += still;
    moving_boxes += line.moving_edge_boxes;
    const bool needed = keyframe.first_still_line <= i && i < keyframe.last_still_line;
    if (!needed || is_kept(keyframe, i, plan)) continue;
    again.drawn.edge_boxes += still;
    again.drawn.samples += line.samples - line.moving_samples;
    again.drawn.constant.shaded += line.constant.shaded;
    again.drawn.constant.highlights += line.constant.highlights;
    again.drawn.constant.facets += line.constant.facets;
    again.lines += 1;
  }
  if (again.drawn.edge_boxes == 0) return {};
  again.made = totals_of(keyframe, band_lines_).made * (still_boxes / (still_boxes + moving_boxes));
  again.made[Work::triangle] *= again.drawn.edge_boxes / still_boxes;
  again.made[Work::edge_box_made] = again.drawn.edge_boxes;
  return again;
}

double FrameCosts::still_bytes(const wire::FrameCounts& keyframe, int nodes) const {
  return still_lines({0, setting_.film.settings().height}, keyframe, still_plan(nodes)).bytes;
}

// A line is kept where it has memory for its groups (node/raster/still_lines.h).
bool FrameCosts::is_kept(const wire::FrameCounts& keyframe, std::uint32_t line, const wire::StillPlan& plan) const {
  const wire::FilmSettings& film = setting_.film.settings();
  if (plan.groups_per_column == 0) return true;
  return line - keyframe.first_still_line < plan.lines &&
         kept_groups(keyframe.lines[line]) <= static_cast<double>(film.width) * plan.groups_per_column;
}

// As evenly over a line's columns as what is seen there.
double FrameCosts::kept_groups(const wire::LineCounts& line) const {
  return line.constant.shaded * line.kept_width / setting_.film.settings().width;
}

// Of a line that is kept.
double FrameCosts::kept_bytes(const wire::LineCounts& line) const {
  const std::uint32_t samples = setting_.film.settings().samples, casting = setting_.film.casting_count();
  if (samples == 1 && casting == 0) return line.kept_width * sizeof(float);
  return line.kept_width * static_cast<double>(wire::still_column_bytes(samples, casting)) +
         kept_groups(line) * static_cast<double>(wire::still_group_bytes(casting));
}

wire::StillPlan FrameCosts::still_plan(int nodes) const {
  const wire::FilmSettings& film = setting_.film.settings();
  return wire::plan_still_lines(film.width, film.height, film.samples,
                                memory_.still * static_cast<std::uint64_t>(nodes_on_a_computer(nodes)),
                                setting_.film.casting_count());
}

// Of one frame; where nodes share a computer, two frames' take turns (node/group/frame_memory.h).
double FrameCosts::arena_bytes() const {
  return static_cast<double>(memory_.frames) / (setting_.platform.machine.nodes > 1 ? 2 : 1);
}

// What is done again in each pass.
double FrameCosts::dicing(const wire::UnitCounts& made) const {
  wire::UnitCounts again = made;
  again[Work::triangle] = again[Work::edge_box_made] = 0;
  return costs_.of(Work::frame, 1) + costs_.of(Work::segment, static_cast<double>(setting_.film.segments().size())) +
         costs_.of(again);
}

double FrameCosts::setting_up(const wire::UnitCounts& made) const {
  return costs_.of(Work::triangle, made[Work::triangle]) + costs_.of(Work::edge_box_made, made[Work::edge_box_made]);
}

wire::UnitCounts FrameCosts::drawn_units(const FrameTotals& totals) const {
  const auto lights = static_cast<double>(setting_.film.light_tracks().size());
  wire::SeenCounts seen = totals.drawn.constant;
  seen += totals.drawn.moving;
  wire::UnitCounts units;
  units[Work::edge_box] = totals.drawn.edge_boxes;
  units[Work::sample] = totals.drawn.samples;
  units[Work::shaded] = seen.shaded;
  units[Work::light] = seen.highlights * lights;
  units[Work::facet_light] = seen.facets * lights;
  units[Work::pixel] = seen.pixels;
  units[Work::casting_light] = seen.shaded * setting_.film.casting_count();
  units[Work::shadow_point] = seen.points + totals.kept_points;
  return units;
}

double FrameCosts::keyframe_drawing(const FrameTotals& totals, const wire::FrameCounts& counts,
                                    const geometry::LineRange& lines) const {
  wire::UnitCounts units = drawn_units(totals);
  for (std::uint32_t i = lines.first; i < lines.last; ++i) {
    const wire::LineCounts& line = counts.lines[i];
    const bool needed = counts.first_still_line <= i && i < counts.last_still_line;
    units[Work::line] += needed || line.edge_boxes > 0 ? 1 : 0;
    if (needed) units[Work::still_byte] += kept_bytes(line);
  }
  return costs_.of(units);
}

// `nodes` share the dicing for the camera. Other casters are diced again for each band of lines.
double FrameCosts::casting(const FrameTotals& totals, const wire::FrameCounts& counts, const geometry::LineRange& lines,
                           int nodes) const {
  if (setting_.film.casting_count() == 0 || lines.count() == 0) return 0;
  const double band = lines_of_band(totals, lines.count());
  double seconds = 0;
  for (double first = lines.first; first < lines.last; first += band)
    seconds += costs_.of(casters_on(counts, static_cast<std::uint32_t>(first),
                                    static_cast<std::uint32_t>(std::min<double>(lines.last, first + band)), nodes));
  return seconds;
}

// As many as there is memory for: groups with their light, depths and pairs (node/shadow/shadow_painter.cpp), and
// points.
double FrameCosts::lines_of_band(const FrameTotals& totals, double lines) const {
  const wire::FilmSettings& film = setting_.film.settings();
  const double casting = setting_.film.casting_count(), samples = static_cast<double>(film.width) * film.samples;
  const double light = (4 + 3 * casting) * sizeof(float), group = 16 + light;
  const double record = static_cast<double>(wire::still_group_bytes(setting_.film.casting_count()));
  const double column = sizeof(std::uint32_t) + casting * 2 * (sizeof(wire::StillPairs) + sizeof(std::uint16_t));
  const shadow::ShadowNeeds needs = shadow::shadow_needs(setting_.film);
  const shadow::ShadowPlan plan = shadow::plan_shadows(needs, memory_.shadows);
  const double shaded = totals.drawn.constant.shaded + totals.drawn.moving.shaded;
  const double each = shaded / lines * (group + record) + samples * sizeof(float) + film.width * column / 2;
  const double seen = std::floor(static_cast<double>(plan.band - shadow::band_bytes_of_line(needs)) / each);
  return std::max(1.0, std::min<double>(seen, shadow::lines_of_points(needs, plan.points)));
}

StripCosts FrameCosts::strips(const FrameTotals& totals, double seconds) const {
  StripCosts strips{seconds, 0, 0, 1};
  const double content = totals.pixels() * pixel_bytes() + totals.runs() * sizeof(wire::Run);
  strips.count = 1 + static_cast<std::uint32_t>(content / kFullStrip);
  strips.bytes = content + strips.count * static_cast<double>(sizeof(wire::Strip));
  strips.pasting = pasting(totals);
  return strips;
}

double FrameCosts::pasting(const FrameTotals& totals) const {
  return costs_.of(Work::host_run, totals.runs()) + costs_.of(Work::host_byte, totals.pixels() * pixel_bytes());
}

double FrameCosts::encoding(double lines) const {
  return costs_.of(experiments::encoded_byte(setting_.picture), lines * line_bytes());
}

double FrameCosts::writing() const { return costs_.of(Work::file, 1) + costs_.of(Work::file_byte, file_bytes()); }

// Triangles with their edge boxes, once as made and once in their lines.
double FrameCosts::made_bytes(const wire::UnitCounts& made) const {
  return made[Work::triangle] * kTriangleBytes + made[Work::edge_box_made] * (kUnsortedBoxBytes + kBoxBytes) +
         3 * 8 * height();
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

void FrameCosts::add_dicing(GroupKeyframe& keyframe, const Homes& homes,
                            const std::vector<wire::UnitCounts>& made) const {
  const auto nodes = static_cast<int>(made.size());
  const bool travels = nodes > nodes_on_a_computer(nodes);
  double& most = keyframe.passes;
  for (std::size_t n = 0; n < made.size(); ++n)
    most = std::max(most, passes(made[n], homes.totals[n].drawn.edge_boxes, travels));
  for (std::size_t n = 0; n < made.size(); ++n) {
    const wire::UnitCounts whole = in_whole_patches(made[n]);
    const double once = setting_up(whole);
    const double filled = costs_.of(Work::edge_box_filled, whole[Work::edge_box_made]);
    keyframe.nodes[n].dice = dicing(whole) + once + filled;
    if (most > 1) keyframe.nodes[n].dice += most * dicing(whole) + once;
    keyframe.nodes[n].exchange = costs_.of(Work::line_mapped, height());
    keyframe.nodes[n].memory = made_bytes(made[n]);
    keyframe.nodes[n].made_memory = std::min(arena_bytes(), made_bytes(made[n]));
  }
}

// Across each dimension of the group's hypercube (hal/collectives/reduction.cpp).
void FrameCosts::add_sum(GroupKeyframe& keyframe, int nodes) const {
  const double bytes = 8 * (height() + 2);
  const int corners = static_cast<int>(std::bit_floor(static_cast<unsigned>(nodes)));
  const bool halves = bytes >= kShortSum && corners >= 4;
  double sent = 0;
  const auto exchange = [&](double so_many, bool same_computer) {
    keyframe.sum += costs_.to_send(so_many) + costs_.on_the_way(so_many, same_computer) + costs_.to_receive(so_many);
    sent += so_many;
  };
  double part = bytes;
  for (int bit = 1; bit < corners; bit *= 2) {
    const bool near = 2 * bit <= nodes_on_a_computer(nodes);
    if (halves) part /= 2, exchange(part, near);
    exchange(halves ? part : bytes, near);
  }
  if (corners < nodes)
    for (int way = 0; way < 2; ++way) exchange(bytes, false);
  for (NodePart& node : keyframe.nodes) node.bytes_to_nodes += sent;
}

// To homes on other computers. Each node has a part of what is on any home.
void FrameCosts::add_exchange(GroupKeyframe& keyframe, const Homes& homes, const std::vector<wire::UnitCounts>& made,
                              int contributors) const {
  const auto nodes = static_cast<std::size_t>(contributors);
  const double far =
      1 - static_cast<double>(nodes_on_a_computer(static_cast<int>(made.size()))) / static_cast<double>(nodes);
  double home_messages = 0, home_bytes = 0;  // that one node sends, if it has an equal part of all
  std::vector<double> parcels(nodes), bytes(nodes);
  for (std::size_t h = 0; h < nodes; ++h) {
    const double each = 1 / static_cast<double>(nodes);
    parcels[h] = 1 - std::exp(-homes.triangles[h] * each);
    bytes[h] = each * (homes.totals[h].drawn.edge_boxes * kUnsortedBoxBytes + homes.triangles[h] * kTriangleBytes) +
               parcels[h] * 96;
    home_messages += parcels[h] * far;
    home_bytes += bytes[h] * far;
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    NodePart& node = keyframe.nodes[n];
    const double part =
        homes.edge_boxes > 0 ? made[n][Work::edge_box_made] / homes.edge_boxes * static_cast<double>(nodes) : 0;
    const double out = home_bytes * part, messages_out = home_messages;
    const double in = bytes[n] * static_cast<double>(nodes) * far;
    const double messages_in = parcels[n] * static_cast<double>(nodes) * far;
    const double boxes_in = homes.totals[n].drawn.edge_boxes * far;
    const auto ends = [&](double messages, double all, const auto& cost) {
      return messages > 0 ? messages * cost(all / messages) : 0;
    };
    node.exchange += ends(messages_out, out, [&](double b) { return costs_.to_send(b); }) +
                     ends(messages_in, in, [&](double b) { return costs_.to_receive(b); }) +
                     costs_.of(Work::edge_box_filled, boxes_in);
    node.exchange_wait = costs_.on_the_way(std::max(in, out), false);
    node.bytes_to_nodes += out;
    const double travelling = made[n][Work::edge_box_made] * far * (kUnsortedBoxBytes + kTriangleBytes) + in;
    const double in_pass = (node.memory + travelling + boxes_in * kBoxBytes) / keyframe.passes;
    node.memory = std::max(keyframe.passes > 1 ? std::min(arena_bytes(), node.memory) : 0, in_pass);
  }
}

// CZB, and with several samples shaded groups, of what inbetweens may change: to all other computers that
// draw inbetweens.
void FrameCosts::add_still(GroupKeyframe& keyframe, const Homes& homes, const wire::FrameCounts& counts,
                           std::size_t inbetweens) const {
  const auto nodes = keyframe.nodes.size();
  const auto near = static_cast<std::size_t>(nodes_on_a_computer(static_cast<int>(nodes)));
  const std::size_t computers = (nodes + near - 1) / near, collecting = std::min(computers, inbetweens);
  if (computers == 1) return;
  double all_bytes = 0, all_messages = 0, most = 0;
  std::vector<StillLines> still(nodes);
  for (std::size_t n = 0; n < nodes; ++n) {
    still[n] = still_lines(homes.ranges[n], counts, still_plan(1));
    all_bytes += still[n].bytes, all_messages += still[n].messages;
    most = std::max(most, still[n].bytes);
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    NodePart& node = keyframe.nodes[n];
    const std::size_t computer = n / near;
    const auto receivers = static_cast<double>(collecting - (computer < collecting ? 1 : 0));
    const auto& [bytes, messages] = still[n];
    if (messages > 0) node.still += receivers * messages * costs_.to_send(bytes / messages);
    node.bytes_to_nodes += receivers * bytes;
    if (computer >= collecting || n % near != 0 || all_messages <= messages) continue;
    const double in = all_bytes - bytes, messages_in = all_messages - messages;
    node.still += messages_in * costs_.to_receive(in / messages_in);
    node.still_wait = costs_.on_the_way(bytes_until(computer, in, most), false);
  }
}

// Bands of what stands still to all other computers that draw inbetweens, with pixels where these may draw; bands of
// the keyframe to the node that writes it, which in the long run each node is as often.
void FrameCosts::add_bands(GroupKeyframe& keyframe, const Homes& homes, const wire::FrameCounts& counts,
                           int contributors, std::size_t inbetweens) const {
  const auto nodes = keyframe.nodes.size();
  const auto near = static_cast<std::size_t>(nodes_on_a_computer(static_cast<int>(nodes)));
  const std::size_t computers = (nodes + near - 1) / near, collecting = std::min(computers, inbetweens);
  const geometry::LineRange touched{counts.first_still_line, counts.last_still_line};
  const auto picture_bytes = [&](std::size_t n) {
    return homes.ranges[n].count() * line_bytes() * setting_.platform.file_part;
  };
  const auto background_bytes = [&](std::size_t n) {
    return picture_bytes(n) + geometry::overlap(homes.ranges[n], touched).count() * line_bytes();
  };
  double all = 0, most = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    all += background_bytes(n);
    most = std::max(most, background_bytes(n));
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    NodePart& node = keyframe.nodes[n];
    const std::size_t computer = n / near;
    const auto receivers = static_cast<double>(collecting - (computer < collecting ? 1 : 0));
    if (n < static_cast<std::size_t>(contributors) && nodes > 1) {
      node.bands += costs_.to_send(picture_bytes(n)) + receivers * costs_.to_send(background_bytes(n));
      node.bytes_to_nodes += picture_bytes(n) + receivers * background_bytes(n);
    }
    if (nodes > 1)  // what one writer receives, by turns
      node.bands += costs_.to_receive(file_bytes() / static_cast<double>(nodes));
    if (computer >= collecting || n % near != 0 || computers == 1) continue;
    const double in = all - background_bytes(n);
    node.bands += static_cast<double>(nodes - 1) * costs_.to_receive(in / static_cast<double>(nodes - 1));
    node.bands_wait =
        costs_.on_the_way(bytes_until(computer, in, most) + file_bytes() / static_cast<double>(nodes), false);
  }
}

// Of those on `home`, what a node sends to one computer.
FrameCosts::StillLines FrameCosts::still_lines(const geometry::LineRange& home, const wire::FrameCounts& counts,
                                               const wire::StillPlan& plan) const {
  const wire::FilmSettings& film = setting_.film.settings();
  const geometry::LineRange lines = geometry::overlap(home, {counts.first_still_line, counts.last_still_line});
  const bool groups = film.samples > 1 || setting_.film.casting_count() > 0;
  StillLines still;
  still.messages = groups ? lines.count() : std::min(1u, lines.count());
  for (std::uint32_t line = lines.first; line < lines.last; ++line) {
    if (!is_kept(counts, line, plan)) continue;
    still.bytes +=
        kept_bytes(counts.lines[line]) + (groups ? static_cast<double>(wire::still_head_bytes(film.width)) : 0);
  }
  return still;
}

// Of a group of `nodes` nodes.
int FrameCosts::nodes_on_a_computer(int nodes) const { return std::min(nodes, setting_.platform.machine.nodes); }

}  // namespace mars::forecast
