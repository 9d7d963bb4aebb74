#include "host/experiments/forecast/frame_costs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "host/images/picture_bands.h"
#include "node/wire/protocol.h"
#include "node/wire/still_plan.h"

namespace mars::forecast {
namespace {

using wire::Work;

// Of a shared inbetween: the largest part over the mean, by lines, and by bands of a file that are no more than nodes;
// the most memory of a node over that of its part, of kFewPatches or fewer; points of a patch's box.
constexpr double kSharedUnevenly = 1.1, kBandsUnevenly = 1.6, kMemoryUnevenly = 1.3, kFewPatches = 650, kBoxPoints = 16;

// Many patches lie more evenly: what is uneven falls as the root of their number.
double memory_unevenly(double patches) {
  return 1 + (kMemoryUnevenly - 1) * std::sqrt(kFewPatches / std::max(kFewPatches, patches));
}

// Each of the nodes does the mean of what all do.
template <typename Nodes, typename Of>
void even_out(const Nodes& nodes, const Of& seconds_of) {
  double all = 0;
  for (auto& node : nodes) all += seconds_of(node);
  for (auto& node : nodes) seconds_of(node) = all / static_cast<double>(nodes.size());
}

// Of messages that take no time, one does for all.
std::vector<double> as_one(const std::vector<double>& messages) {
  if (messages.empty()) return {};
  return {std::accumulate(messages.begin(), messages.end(), 0.0)};
}

std::vector<std::vector<double>> as_ones(std::vector<std::vector<double>> by_node) {
  for (std::vector<double>& messages : by_node) messages = as_one(messages);
  return by_node;
}

}  // namespace

FrameCosts::FrameCosts(const Setting& setting, int nodes)
    : setting_(setting),
      costs_(setting.platform),
      memory_(farm::share_node_memory(setting.platform.memory, {}, setting.film.settings(),
                                      shadow::shadow_needs(setting.film, setting.has_layers()),
                                      std::min(nodes, setting.platform.machine.nodes))),
      band_lines_(images::PictureBands(setting.picture, setting.film.settings().width, setting.film.settings().height)
                      .lines_a_band()),
      lights_(setting.film.light_tracks().size()) {}

GroupKeyframe FrameCosts::keyframe(std::shared_ptr<const KeyframeLoad> load, const KeyframeCounts& counts,
                                   const KeyframeGroup& group) const {
  GroupKeyframe keyframe;
  if (group.count() > 1)
    keyframe.sum =
        sum_steps(group.count(), 8.0 * static_cast<double>(wire::summed_words(setting_.film.settings().height)));
  if (!load->parcels.empty()) keyframe.triangles = triangle_steps(load->parcels, costs_.of(Work::edge_box_filled, 1));
  if (!load->parcels.empty()) keyframe.again = making_again(*load);
  for (const NodeLoad& node : load->nodes) keyframe.nodes.push_back(part_of(node, *load));
  for (std::size_t n = 0; n < static_cast<std::size_t>(group.contributors) && group.has_inbetweens(); ++n)
    keyframe.nodes[n].strips.pasting += saving(load->nodes[n].seen, counts.constant_blocks.empty());
  if (setting_.even.keyframes) {
    const auto contribute = std::span(keyframe.nodes).first(static_cast<std::size_t>(group.contributors));
    even_out(contribute, [](NodePart& node) -> double& { return node.dice; });
    even_out(contribute, [](NodePart& node) -> double& { return node.strips.seconds; });
    even_out(contribute, [](NodePart& node) -> double& { return node.compose; });
  }
  keyframe.load = std::move(load);
  return keyframe;
}

NodePart FrameCosts::part_of(const NodeLoad& load, const KeyframeLoad& all) const {
  NodePart part;
  const double once = setting_up(load.made);
  part.dice = dicing(load.made) + once + costs_.of(Work::edge_box_filled, load.made[Work::edge_box_made]);
  if (all.passes > 1) part.dice += all.passes * dicing(load.made) + once;
  part.map = costs_.of(Work::line_mapped, height());
  part.memory = load.memory;
  part.made_memory = load.made_memory;
  part.compose = pasting(load.seen);
  if (load.strips.empty())
    part.strips = {0, 0, 0, {}};
  else
    part.strips = strips(load.seen, costs_.of(load.drawn) + costs_.of(load.casters), load.strips);
  return part;
}

// Seconds of each node. Surfaces without edge boxes are taken to lie as the others.
std::vector<double> FrameCosts::making_again(const KeyframeLoad& load) const {
  const double seen = costs_.of(load.with_boxes), unseen = costs_.of(load.without_boxes);
  std::vector<double> seconds;
  for (const NodeLoad& node : load.nodes)
    seconds.push_back(seen > 0 ? costs_.of(node.again) * (1 + unseen / seen) + costs_.of(node.set_up_again) : 0);
  return seconds;
}

// CZB, and with several samples shaded groups, of what inbetweens may change. Of bands those of what stands still, with
// pixels where inbetweens may draw, and those of the keyframe to the node that writes it.
KeyframeGifts FrameCosts::gifts(const KeyframeLoad& load, const KeyframeGroup& group) const {
  KeyframeGifts gifts;
  const auto relayed = [&](wire::MessageType type) {
    return costs_.takes_time(type) ? Relayed::in_time : Relayed::at_once;
  };
  if (!load.still.empty()) {
    const bool at_once = relayed(wire::kStillLines) == Relayed::at_once;
    gifts.still =
        still_steps(machines_of(group), at_once ? as_ones(load.still) : load.still, relayed(wire::kStillLines));
  }
  if (setting_.nodes_write()) {
    std::vector<NodeBands> bands = load.bands;
    for (NodeBands& node : bands) {
      node.encoding = encoding(node.lines);
      if (relayed(wire::kBackground) == Relayed::at_once) node.background = as_one(node.background);
    }
    if (setting_.even.keyframes)
      even_out(std::span(bands).first(static_cast<std::size_t>(group.contributors)),
               [](NodeBands& node) -> double& { return node.encoding; });
    gifts.bands = band_steps(machines_of(group), bands, group.writer, relayed(wire::kBackground));
  }
  return gifts;
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
  part.map = costs_.of(Work::line_mapped, height());
  part.strips = strips(totals, costs_.of(units) + costs_.of(totals.casters), strip_sizes(strip_bytes(totals.drawn)));
  const double bands = whole.changed / band_lines_;
  const double changed = is_shared ? std::ceil(bands / sharers) * band_lines_ : whole.changed;
  part.compose = pasting(totals) + encoding(changed);
  if (is_shared) part.team_bytes = whole.changed / sharers * line_bytes() * setting_.platform.file_part;
  if (totals.blocks.empty())
    part.strips.pasting += costs_.of(Work::host_restored, totals.drawn.moving.block_pixels * pixel_bytes());
  const double unevenly = is_shared ? memory_unevenly(made[Work::patch] + made[Work::meshlet]) : 1;
  part.memory = std::min(arena_bytes(), made_bytes(made) * unevenly);
  part.made_memory = std::min(arena_bytes(), fresh_bytes(made) * unevenly);
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
  for (const Work kind :
       {Work::patch, Work::meshlet, Work::vertex, Work::mesh_vertex, Work::net_term, Work::skin_weight,
        Work::dual_weight, Work::triangle_tested, Work::row_tested, Work::vertex_light})
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
// `restores`: else that is counted block by block (HostBlocks).
double FrameCosts::saving(const FrameTotals& totals, bool restores) const {
  const wire::SeenCounts& seen = totals.drawn.constant;
  const double restored = restores ? (seen.pixels + seen.block_pixels / 2) * pixel_bytes() : 0;
  return costs_.of(Work::host_run, seen.runs) + costs_.of(Work::host_byte, seen.pixels * pixel_bytes()) +
         costs_.of(Work::host_restored, restored);
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
  const wire::StillPlan plan = still_plan(nodes);
  const double head = has_groups() ? static_cast<double>(wire::still_head_bytes(setting_.film.settings().width)) : 0;
  double bytes = 0;
  for (std::uint32_t line = keyframe.first_still_line; line < keyframe.last_still_line; ++line)
    if (is_kept(keyframe, line, plan)) bytes += head + kept_bytes(keyframe.lines[line]);
  return bytes;
}

// A line is kept where it has memory for its groups (node/raster/still_lines.h).
bool FrameCosts::is_kept(const wire::FrameCounts& keyframe, std::uint32_t line, const wire::StillPlan& plan) const {
  const wire::FilmSettings& film = setting_.film.settings();
  if (plan.groups_per_column == 0) return true;
  return line - keyframe.first_still_line < plan.lines &&
         keyframe.lines[line].constant.kept_groups <= static_cast<double>(film.width) * plan.groups_per_column;
}

// Whether lines have groups.
bool FrameCosts::has_groups() const {
  return setting_.film.settings().samples > 1 || setting_.film.casting_count() > 0;
}

// Of a line that is kept.
double FrameCosts::kept_bytes(const wire::LineCounts& line) const {
  const std::uint32_t samples = setting_.film.settings().samples, casting = setting_.film.casting_count();
  if (!has_groups()) return line.kept_width * sizeof(float);
  return line.kept_width * static_cast<double>(wire::still_column_bytes(samples, casting)) +
         line.constant.kept_groups *
             static_cast<double>(wire::still_group_bytes(casting) + wire::surface_bytes(setting_.has_layers()));
}

wire::StillPlan FrameCosts::still_plan(int nodes) const {
  const wire::FilmSettings& film = setting_.film.settings();
  return wire::plan_still_lines(film.width, film.height, film.samples,
                                memory_.still * static_cast<std::uint64_t>(nodes_on_a_computer(nodes)),
                                setting_.film.casting_count(), setting_.has_layers());
}

// Of one frame; where nodes share a computer, two frames' take turns (node/group/frame_memory.h).
double FrameCosts::arena_bytes() const {
  return static_cast<double>(memory_.frames) / (setting_.platform.machine.nodes > 1 ? 2 : 1);
}

// What is done again in each pass.
double FrameCosts::dicing(const wire::UnitCounts& made) const {
  wire::UnitCounts again = made;
  again[Work::triangle] = again[Work::edge_box_made] = 0;
  return costs_.of(Work::frame, 1) +
         costs_.of(Work::segment, static_cast<double>(setting_.film.segments().size() + setting_.film.bones().size())) +
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

// `sizes`: bytes of pixels and runs in each strip.
StripCosts FrameCosts::strips(const FrameTotals& totals, double seconds, std::vector<double> sizes) const {
  StripCosts strips{seconds, 0, pasting(totals), std::move(sizes)};
  const double content = std::accumulate(strips.parts.begin(), strips.parts.end(), 0.0);
  strips.bytes = content + strips.count() * static_cast<double>(sizeof(wire::Strip));
  for (double& part : strips.parts) part = content > 0 ? part / content : 1.0 / strips.count();
  return strips;
}

double FrameCosts::strip_bytes(const wire::LineCounts& line) const {
  return (line.constant.pixels + line.moving.pixels) * pixel_bytes() +
         (line.constant.runs + line.moving.runs) * sizeof(wire::Run);
}

double FrameCosts::pasting(const FrameTotals& totals) const {
  return costs_.of(Work::host_run, totals.runs()) + costs_.of(Work::host_byte, totals.pixels() * pixel_bytes());
}

std::vector<Work> FrameCosts::kinds_of_work(const FilmCounts& counts) const {
  FrameTotals all;
  for (const wire::FrameCounts& keyframe : counts.keyframes) all = all + totals_of(keyframe, band_lines_);
  for (const TaskCounts& task : counts.tasks)
    for (const FrameTotals& inbetween : task.inbetweens) all = all + inbetween;
  wire::UnitCounts units = drawn_units(all) + all.made + all.casters;
  for (const Work kind :
       {Work::first_frame, Work::fresh_byte, Work::frame, Work::segment, Work::line_mapped, Work::line})
    units[kind] = 1;
  units[Work::edge_box_filled] = units[Work::edge_box_made];
  units[Work::still_byte] = all.drawn.moving_width;
  std::vector<Work> kinds;
  for (std::size_t kind = 0; kind < wire::kNodeKinds; ++kind)
    if (units.units[kind] > 0) kinds.push_back(static_cast<Work>(kind));
  kinds.insert(kinds.end(), {Work::host_strip, Work::host_run, Work::host_byte});
  if (!setting_.nodes_write()) kinds.insert(kinds.end(), {Work::host_restored, Work::host_frame});
  if (setting_.files)
    kinds.insert(kinds.end(), {Work::file, experiments::encoded_byte(setting_.picture), Work::file_byte});
  return kinds;
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

// Nodes count as fresh what triangles take as they are made.
double FrameCosts::fresh_bytes(const wire::UnitCounts& made) const {
  return static_cast<double>(kTriangleBytes) * made[Work::triangle] +
         static_cast<double>(kUnsortedBoxBytes) * made[Work::edge_box_made];
}

// Of a group of `nodes` nodes.
int FrameCosts::nodes_on_a_computer(int nodes) const { return std::min(nodes, setting_.platform.machine.nodes); }

}  // namespace mars::forecast
