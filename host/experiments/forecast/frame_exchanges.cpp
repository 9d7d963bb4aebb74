// What the nodes of a group have for each other in a keyframe: triangles, still lines, bands.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "host/experiments/forecast/frame_costs.h"
#include "node/wire/still_plan.h"

namespace mars::forecast {
namespace {

using wire::Work;

constexpr double kBandHead = 80;  // host/render/composer/band_record.h
constexpr double kPieceHead = 8;  // node/group/relay.cpp
constexpr double kLinesHead = 8;  // node/group/still_exchange.cpp: of a line with groups, or of all in a piece

// Home of each line.
std::vector<int> homes_of_lines(const std::vector<geometry::LineRange>& ranges, std::size_t height) {
  std::vector<int> homes(height);
  for (std::size_t node = 0; node < ranges.size(); ++node)
    for (std::uint32_t line = ranges[node].first; line < ranges[node].last; ++line)
      homes[line] = static_cast<int>(node);
  return homes;
}

// Homes of the lines that the surface's box may touch, each once. A meshlet's box has its corners about half as far
// out again.
std::vector<int> homes_near(const wire::MadeSurface& surface, const std::vector<int>& home_of, double box_margin) {
  const auto margin = static_cast<std::uint32_t>(box_margin / 2) + (is_meshlet(surface.kind) ? surface.lines / 2 : 0);
  const auto height = static_cast<std::uint32_t>(home_of.size());
  const std::uint32_t first = surface.first_line - std::min(surface.first_line, margin);
  const std::uint32_t last = std::min(height, surface.first_line + surface.lines + margin);
  std::vector<int> homes;
  for (std::uint32_t line = first; surface.lines > 0 && line < last; ++line)
    if (homes.empty() || homes.back() != home_of[line]) homes.push_back(home_of[line]);
  return homes;
}

// As many parts in each piece as it has, but one at least; `head` bytes before them.
std::vector<double> in_pieces(const std::vector<double>& parts, double head) {
  std::vector<double> pieces{head};
  for (const double part : parts) {
    if (pieces.back() > head && pieces.back() - head + part > static_cast<double>(wire::kRelayPiece))
      pieces.push_back(head);
    pieces.back() += part;
  }
  return pieces;
}

// What one node has for each home.
class ParcelSums {
 public:
  explicit ParcelSums(std::size_t homes) : of_(homes) {}

  void add(const wire::MadeSurface& surface, std::span<const wire::SurfaceLine> lines, const std::vector<int>& homes) {
    int home = -1;
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
      const wire::SurfaceLine& line = lines[i];
      const bool enters = std::exchange(home, homes[surface.first_line + i]) != homes[surface.first_line + i];
      Parcel& parcel = of_[static_cast<std::size_t>(home)];
      if (parcel.edge_boxes == 0 && line.edge_boxes > 0) touched_.push_back(home);
      parcel.edge_boxes += line.edge_boxes;
      parcel.triangles += line.begin + (enters ? line.go_on : 0);
    }
  }

  // Leaves none.
  std::vector<Parcel> take() {
    std::vector<Parcel> parcels;
    for (const int home : std::exchange(touched_, {})) {
      Parcel& parcel = of_[static_cast<std::size_t>(home)];
      parcels.push_back({home, parcel.edge_boxes, parcel.triangles});
      parcel = {};
    }
    return parcels;
  }

 private:
  std::vector<Parcel> of_;    // by home
  std::vector<int> touched_;  // homes
};

}  // namespace

// Of a line that is kept, as it travels; where nothing is seen, columns have no depths.
double FrameCosts::packed_bytes(const wire::LineCounts& line) const {
  if (!has_groups()) return kept_bytes(line);
  const wire::FilmSettings& film = setting_.film.settings();
  const std::uint32_t casting = setting_.film.casting_count();
  const double shown = line.kept_width * std::min(1.0, line.constant.pixels / film.width);
  return kLinesHead + static_cast<double>(wire::still_head_bytes(film.width)) + line.kept_width +
         shown * static_cast<double>(wire::still_packed_bytes(film.samples, casting)) +
         line.constant.kept_groups *
             static_cast<double>(wire::still_packed_group_bytes(casting) + wire::surface_bytes(setting_.has_layers()));
}

// To homes on other computers.
void FrameCosts::add_exchange(KeyframeLoad& load, const KeyframeCounts& counts, const SurfaceTable& surfaces,
                              const KeyframeGroup& group) const {
  const auto nodes = static_cast<std::size_t>(group.contributors);
  const Machines machines = machines_of(group);
  const std::vector<int> home_of = homes_of_lines(load.homes, counts.lines.size());
  std::vector<std::vector<PlacedSurface>> by_node(nodes);
  for (const PlacedSurface& placed : counts.placed) by_node[placed.number % nodes].push_back(placed);
  ParcelSums sums(nodes);
  load.parcels.resize(load.nodes.size());
  std::vector<double> travelling(nodes), boxes_in(nodes);
  for (std::size_t n = 0; n < nodes; ++n) {
    for (const PlacedSurface& placed : by_node[n]) {
      const wire::MadeSurface& surface = surfaces[placed.surface];
      sums.add(surface, surfaces.lines(placed.surface), home_of);
      add_diced(surface.lines > 0 ? load.with_boxes : load.without_boxes, surface);
      for (const int home : homes_near(surface, home_of, kBoxMargin))
        if (!machines.are_together(static_cast<int>(n), home))
          add_diced(load.nodes[static_cast<std::size_t>(home)].again, surface);
    }
    std::vector<Parcel>& parcels = load.parcels[n];
    parcels = sums.take();
    std::erase_if(parcels, [&](const Parcel& to) { return machines.are_together(static_cast<int>(n), to.home); });
    for (const Parcel& parcel : parcels) {
      const auto home = static_cast<std::size_t>(parcel.home);
      const auto triangles = static_cast<double>(parcel.triangles), boxes = static_cast<double>(parcel.edge_boxes);
      travelling[n] += boxes * static_cast<double>(kUnsortedBoxBytes + kTriangleBytes);
      travelling[home] += parcel.bytes();
      boxes_in[home] += boxes;
      load.nodes[home].set_up_again[Work::triangle] += triangles;
      load.nodes[home].set_up_again[Work::edge_box_made] += boxes;
      load.nodes[home].set_up_again[Work::edge_box_filled] += boxes;
    }
  }
  for (std::size_t n = 0; n < nodes; ++n) {
    NodeLoad& node = load.nodes[n];
    const double in_pass = (node.memory + travelling[n] + boxes_in[n] * kBoxBytes) / load.passes;
    node.memory = std::max(load.passes > 1 ? std::min(arena_bytes(), node.memory) : 0, in_pass);
  }
}

Machines FrameCosts::machines_of(const KeyframeGroup& group) const {
  return Machines(group.nodes.first, setting_.platform.machine.nodes, group.draws);
}

// In which lines of `home` go round machines.
std::vector<double> FrameCosts::still_messages(const geometry::LineRange& home, const wire::FrameCounts& counts) const {
  const geometry::LineRange lines = geometry::overlap(home, {counts.first_still_line, counts.last_still_line});
  if (lines.count() == 0) return {};
  const wire::StillPlan plan = still_plan(1);
  std::vector<double> kept;
  for (std::uint32_t line = lines.first; line < lines.last; ++line)
    if (is_kept(counts, line, plan)) kept.push_back(packed_bytes(counts.lines[line]));
  return in_pieces(kept, kPieceHead + (has_groups() ? 0 : kLinesHead));
}

// As programs::CountedWriter has them.
NodeBands FrameCosts::bands_of(const std::vector<geometry::LineRange>& homes, std::size_t node,
                               const wire::FrameCounts& counts, bool has_inbetweens) const {
  const geometry::LineRange& home = homes[node];
  NodeBands bands;
  if (home.count() == 0) return bands;
  const auto height = static_cast<std::uint32_t>(counts.lines.size());
  // What is seen of moving parts in the node's lines of the band that begins at `first`.
  const auto is_touched = [&](std::uint32_t first) {
    const geometry::LineRange own = geometry::overlap(home, {first, std::min(height, first + band_lines_)});
    const auto lines = std::span(counts.lines).subspan(own.first, own.count());
    return std::ranges::any_of(lines, [](const wire::LineCounts& line) { return line.moving.pixels > 0; });
  };
  if (const std::uint32_t first = home.first / band_lines_ * band_lines_; first < home.first) {
    const std::uint32_t lines = std::min(home.last, first + band_lines_) - home.first;
    bands.edge = lines * line_bytes() * (is_touched(first) ? 2 : 1);
    const auto composer = std::ranges::find_if(homes, [&](const auto& other) { return other.has(first); });
    bands.composer = static_cast<int>(composer - homes.begin());
  }
  std::vector<double> backgrounds;
  for (std::uint32_t first = (home.first + band_lines_ - 1) / band_lines_ * band_lines_; first < home.last;
       first += band_lines_) {
    const std::uint32_t last = std::min(height, first + band_lines_);
    const double pixels = (last - first) * line_bytes();
    const double record = kBandHead + std::floor(setting_.platform.file_part * pixels);
    bands.composes = true;
    bands.picture += record;
    bands.lines += last - first;
    if (!has_inbetweens) continue;
    const bool may_change = first < counts.last_still_line && counts.first_still_line < last;
    backgrounds.push_back(record + (may_change ? pixels : 0));
    bands.lines += is_touched(first) ? last - first : 0;
  }
  bands.background = in_pieces(backgrounds, kPieceHead);
  return bands;
}

}  // namespace mars::forecast
