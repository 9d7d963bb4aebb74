#include "node/frame_counter.h"

#include <algorithm>
#include <utility>

#include "node/simd/vector_slack.h"

namespace mars::node {
namespace {

constexpr std::uint32_t kSampledLines = 64;
constexpr std::uint32_t kShares = 64;                       // that triangles are made in, at least
constexpr std::uint32_t kMostShares = 1 << 24;              // beyond, a patch's may not fit
constexpr std::size_t kShareBytes = std::size_t{16} << 20;  // of a share's triangles; one with more is divided
constexpr std::size_t kKeptBytes = std::size_t{768} << 20;  // of triangles and edge boxes whose visibility is decided
constexpr std::size_t kBoxBytes = sizeof(geometry::Triangle) + sizeof(raster::EdgeBox);  // at most

constexpr std::uint32_t kBlock = wire::kCountedBlock;

double share_of(double part, double whole) { return whole > 0 ? part / whole : 0; }

}  // namespace

FrameCounter::FrameCounter(const wire::PackedFilm& film, simd::InstructionSet set, bool is_exact)
    : scene_(film),
      boxes_(film),
      marks_(film.settings().width, film.settings().height),
      tessellator_(set),
      kernels_(raster::raster_kernels(set)),
      step_(is_exact ? 1 : std::max(1u, film.settings().height / kSampledLines)),
      stride_(film.settings().width + 2 * simd::kVectorSlack),
      memory_(kShareBytes),
      all_lines_(film.settings().height, 1),
      share_loads_(film.settings().height),
      loads_(film.settings().height),
      moving_columns_(film.settings().height),
      moving_loads_(film.settings().height),
      surface_(film.settings().height),
      sampled_((film.settings().height + step_ - 1) / step_),
      ids_(std::size_t{stride_} * film.settings().samples),
      depths_(ids_.size()) {
  for (BlockRow* row : {&constant_row_, &moving_row_})
    for (auto* lines : {&row->shown, &row->filled}) lines->resize((film.settings().width + kBlock - 1) / kBlock);
  if (film.casting_count() > 0) shadows_.emplace(scene_, set);
}

wire::FrameCounts FrameCounter::count_keyframe(std::uint32_t interval, std::span<const std::uint32_t> frames) {
  scene_.set_interval(interval);
  scene_.set_frame(frames.front());
  marks_.clear();
  sweep_.begin(scene_, frames.size() > 1 ? frames : frames.first(0), boxes_,
               [this](const geometry::PictureBounds& bounds) { marks_.mark(bounds.lines, bounds.columns); });
  wire::FrameCounts counts = count(wire::FrameKind::keyframe, frames.front());
  note_marked(counts, &wire::LineCounts::swept_width);
  if (shadows_) shadows_->mark_shaded(scene_, sweep_, marks_);
  note_marked(counts, &wire::LineCounts::kept_width);
  const geometry::LineRange still = sweep_.lines();
  // What shadows keep is known now only: as evenly over the columns as what is seen there.
  if (shadows_)
    for (wire::LineCounts& line : counts.lines)
      line.constant.kept_groups = line.constant.shaded * line.kept_width / scene_.film().settings().width;
  counts.first_still_line = still.first;
  counts.last_still_line = still.last;
  return counts;
}

void FrameCounter::note_marked(wire::FrameCounts& counts, double wire::LineCounts::*width) const {
  const geometry::LineRange still = sweep_.lines();
  for (std::uint32_t line = still.first; line < still.last; ++line)
    counts.lines[line].*width = raster::count_columns(marks_.on(line), scene_.film().settings().width);
}

wire::FrameCounts FrameCounter::count_inbetween(std::uint32_t frame) {
  return count(wire::FrameKind::inbetween, frame);
}

wire::FrameCounts FrameCounter::count(wire::FrameKind kind, std::uint32_t frame) {
  const bool keyframe = kind == wire::FrameKind::keyframe;
  scene_.set_frame(frame);
  if (shadows_) shadows_->begin_frame(keyframe);
  forget_kept({0, static_cast<std::uint32_t>(loads_.size())});
  std::ranges::fill(loads_, raster::LineLoad());
  std::ranges::fill(moving_loads_, raster::LineLoad());
  std::ranges::fill(moving_columns_, Columns());
  wire::FrameCounts counts;
  counts.kind = kind;
  counts.frame = frame;
  counts.lines.resize(loads_.size());
  make_all(keyframe, [&](const Tessellation& made, const wire::WorkCounts& work) { add_share(made, work, counts); });
  for (std::size_t line = 0; line < loads_.size(); ++line) {
    counts.lines[line].edge_boxes = static_cast<double>(loads_[line].boxes());
    counts.lines[line].samples = static_cast<double>(loads_[line].samples());
    counts.lines[line].moving_edge_boxes = static_cast<double>(moving_loads_[line].boxes());
    counts.lines[line].moving_samples = static_cast<double>(moving_loads_[line].samples());
    counts.lines[line].moving_width = moving_columns_[line].width();
  }
  if (shadows_) shadows_->begin(scene_, kind, step_);
  estimate_seen(counts, keyframe);
  if (shadows_) shadows_->count(scene_, counts);
  return counts;
}

void FrameCounter::make_all(bool keyframe, const Visit& visit) {
  for (std::uint32_t share = 0; share < kShares; ++share) make({share, kShares}, keyframe, visit);
}

// A share that the memory does not hold is made in two.
void FrameCounter::make(const Scatter& scatter, bool keyframe, const Visit& visit) {
  raster::Arena arena(memory_.bytes());
  auto* const first = reinterpret_cast<geometry::Triangle*>(memory_.bytes().data());
  const std::span<const std::uint8_t> all = all_lines_;
  wire::WorkCounts work{};
  marked_.clear();
  const Tessellation made = tessellator_.tessellate(
      scene_, scatter, {all, keyframe ? all : std::span<const std::uint8_t>(), share_loads_}, {arena, first}, work,
      {shadows_ ? &shadows_->diced() : nullptr, keyframe ? &marked_ : nullptr});
  if (made.all_stored || scatter.count >= kMostShares) return visit(made, work);
  make({scatter.index, 2 * scatter.count}, keyframe, visit);
  make({scatter.index + scatter.count, 2 * scatter.count}, keyframe, visit);
}

void FrameCounter::add_share(const Tessellation& made, const wire::WorkCounts& work, wire::FrameCounts& counts) {
  const wire::UnitCounts units = units_of(made, work);
  for (std::size_t kind = 0; kind < units.units.size(); ++kind) counts.made.units[kind] += units.units[kind];
  for (std::size_t line = 0; line < loads_.size(); ++line) loads_[line] += share_loads_[line];
  for (const raster::UnsortedEdgeBox& box : made.polygons.moving) {
    moving_loads_[box.line] += raster::LineLoad(1, box.box.width());
    moving_columns_[box.line].add(box.box.first, box.box.last());
  }
  mark_surfaces(made.polygons, counts);
  keep_sampled(made);
}

// The latest edge boxes are first, those of moving parts before the others.
void FrameCounter::mark_surfaces(const raster::Polygons& polygons, wire::FrameCounts& counts) {
  const raster::UnsortedEdgeBox* end = polygons.stationary.data() + polygons.stationary.size();
  for (const SurfaceMark& mark : marked_) {
    const auto boxes = static_cast<std::size_t>(mark.edge_boxes);
    end -= boxes;
    counts.surfaces.push_back(mark_surface(mark, {end, boxes}, counts.surface_lines));
  }
}

wire::MadeSurface FrameCounter::mark_surface(const SurfaceMark& mark, std::span<const raster::UnsortedEdgeBox> boxes,
                                             std::vector<wire::SurfaceLine>& lines) {
  const auto count = [](std::uint64_t number) { return static_cast<std::uint32_t>(number); };
  geometry::LineRange all{count(surface_.size()), 0};
  for (std::size_t i = boxes.size(); i > 0;) {
    const std::uint32_t triangle = boxes[i - 1].box.triangle;
    geometry::LineRange of_triangle{count(surface_.size()), 0};
    for (; i > 0 && boxes[i - 1].box.triangle == triangle; --i) {
      const std::uint32_t line = boxes[i - 1].line;
      ++surface_[line].edge_boxes;
      of_triangle = {std::min(of_triangle.first, line), std::max(of_triangle.last, line + 1)};
    }
    ++surface_[of_triangle.first].begin;
    for (std::uint32_t line = of_triangle.first + 1; line < of_triangle.last; ++line) ++surface_[line].go_on;
    all = {std::min(all.first, of_triangle.first), std::max(all.last, of_triangle.last)};
  }
  if (boxes.empty()) all = {0, 0};
  const auto used = std::span(surface_).subspan(all.first, all.count());
  lines.insert(lines.end(), used.begin(), used.end());
  std::ranges::fill(used, wire::SurfaceLine());
  return {mark.patch,
          mark.bending.kind,
          count(mark.bending.units),
          count(mark.vertices),
          count(mark.triangles_tested),
          count(mark.colored),
          count(mark.triangles),
          count(mark.edge_boxes),
          all.first,
          all.count()};
}

wire::UnitCounts FrameCounter::units_of(const Tessellation& made, const wire::WorkCounts& work) const {
  using wire::Work;
  wire::UnitCounts units;
  const auto set = [&](Work kind, std::uint64_t count) { units[kind] = static_cast<double>(count); };
  set(Work::patch, made.surfaces.patches);
  set(Work::meshlet, made.surfaces.meshlets);
  set(Work::vertex, made.surfaces.vertices);
  set(Work::mesh_vertex, made.surfaces.mesh_vertices);
  set(Work::net_term, made.surfaces.net_terms);
  set(Work::skin_weight, made.surfaces.skin_weights);
  set(Work::dual_weight, made.surfaces.dual_weights);
  set(Work::triangle_tested, work.triangles_tested);
  set(Work::row_tested, work.triangles_tested * static_cast<std::uint64_t>(scene_.pattern().count));
  set(Work::vertex_light, made.surfaces.colored * scene_.lights().size());
  set(Work::triangle, made.made.triangles);
  set(Work::edge_box_made, made.made.edge_boxes);
  return units;
}

void FrameCounter::forget_kept(const geometry::LineRange& lines) {
  triangles_.clear();
  for (SampledLine& line : sampled_) line.stationary.clear(), line.moving.clear();
  kept_ = lines;
  is_short_ = false;
}

void FrameCounter::keep_sampled(const Tessellation& made) {
  keep_sampled(made.polygons.stationary, made.polygons.triangles, false);
  keep_sampled(made.polygons.moving, made.polygons.triangles, true);
}

// Boxes of a triangle follow each other.
void FrameCounter::keep_sampled(std::span<const raster::UnsortedEdgeBox> boxes, const geometry::Triangle* triangles,
                                bool moving) {
  std::uint32_t last = 0xffffffff;
  is_short_ |= (triangles_.size() + boxes.size()) * kBoxBytes > kKeptBytes && kept_.count() > step_;
  if (is_short_) return;
  for (std::size_t i = boxes.size(); i-- > 0;) {
    const raster::UnsortedEdgeBox& unsorted = boxes[i];
    if (unsorted.line % step_ != step_ / 2 || !kept_.has(unsorted.line)) continue;
    if (unsorted.box.triangle != last) triangles_.push_back(triangles[last = unsorted.box.triangle]);
    SampledLine& line = sampled_[unsorted.line / step_];
    raster::EdgeBox& box = (moving ? line.moving : line.stationary).emplace_back(unsorted.box);
    box.triangle = static_cast<std::uint32_t>(triangles_.size() - 1);
  }
}

std::uint32_t FrameCounter::line_of(std::size_t sampled) const {
  return static_cast<std::uint32_t>(sampled) * step_ + step_ / 2;
}

// Of the samples that boxes cover, lines about a sampled one are taken to show as much as that does.
void FrameCounter::estimate_seen(wire::FrameCounts& counts, bool keyframe) {
  std::vector<wire::LineCounts>& lines = counts.lines;
  Seen seen{std::vector<wire::SeenCounts>(sampled_.size()), std::vector<wire::SeenCounts>(sampled_.size())};
  if (is_short_)
    see_in_bands(keyframe, seen);
  else
    see(keyframe, seen);
  spread(seen.constant, lines, &wire::LineCounts::constant,
         [](const wire::LineCounts& line) { return line.samples - line.moving_samples; });
  spread(seen.moving, lines, &wire::LineCounts::moving,
         [](const wire::LineCounts& line) { return line.moving_samples; });
  counts.constant_blocks = std::exchange(constant_blocks_, {});
  counts.moving_blocks = std::exchange(moving_blocks_, {});
}

// Lines from `first` on whose triangles memory holds for sure.
std::uint32_t FrameCounter::band_end(std::uint32_t first) const {
  std::uint64_t boxes = 0;
  std::uint32_t line = first;
  do boxes += loads_[line++].boxes();
  while (line < loads_.size() && (boxes + loads_[line].boxes()) * kBoxBytes <= kKeptBytes / 2);
  return line;
}

// The frame's triangles are made again for each band of lines.
void FrameCounter::see_in_bands(bool keyframe, Seen& seen) {
  const auto height = static_cast<std::uint32_t>(loads_.size());
  for (std::uint32_t first = 0; first < height; first = kept_.last) {
    forget_kept({first, band_end(first)});
    make_all(keyframe, [this](const Tessellation& made, const wire::WorkCounts&) { keep_sampled(made); });
    see(keyframe, seen);
  }
}

// On those of the kept lines that are sampled.
void FrameCounter::see(bool keyframe, Seen& seen) {
  for (std::size_t i = 0; i < sampled_.size() && line_of(i) < loads_.size(); ++i) {
    if (!kept_.has(line_of(i))) continue;
    SampledLine& line = sampled_[i];
    if (keyframe) {
      line.constant_depth.assign(ids_.size(), scene_.projection().nothing);
      seen.constant[i] = draw(shadow::Casting::still, line.stationary, line_of(i), line.constant_depth);
    }
    if (!line.moving.empty()) {
      depths_ = line.constant_depth;
      seen.moving[i] = draw(shadow::Casting::moving, line.moving, line_of(i), depths_);
    }
    if (step_ == 1) end_block_rows(line_of(i));
  }
}

void FrameCounter::end_block_rows(std::uint32_t line) {
  if ((line + 1) % kBlock != 0 && line + 1 < loads_.size()) return;
  end_block_row(line, constant_row_, constant_blocks_);
  end_block_row(line, moving_row_, moving_blocks_);
}

// `line`: the row's last.
void FrameCounter::end_block_row(std::uint32_t line, BlockRow& row, std::vector<wire::BlockStretch>& stretches) const {
  const std::uint32_t lines = line % kBlock + 1;
  const auto is_filled = [&](std::size_t column) { return row.filled[column] == lines; };
  for (std::size_t first = 0, last; first < row.shown.size(); first = last) {
    last = first + 1;
    if (row.shown[first] == 0) continue;
    while (last < row.shown.size() && row.shown[last] > 0 && is_filled(last) == is_filled(first)) ++last;
    stretches.push_back({static_cast<std::uint16_t>(line / kBlock), static_cast<std::uint16_t>(first),
                         static_cast<std::uint16_t>(last), static_cast<std::uint16_t>(is_filled(first) ? 1 : 0)});
  }
  std::ranges::fill(row.shown, std::uint16_t{0});
  std::ranges::fill(row.filled, std::uint16_t{0});
}

void FrameCounter::spread(const std::vector<wire::SeenCounts>& seen, std::vector<wire::LineCounts>& lines,
                          wire::SeenCounts wire::LineCounts::*to, double (*samples_of)(const wire::LineCounts&)) const {
  wire::SeenCounts all;
  double all_samples = 0;
  for (std::size_t i = 0; i < seen.size() && line_of(i) < lines.size(); ++i) {
    all += seen[i];
    all_samples += samples_of(lines[line_of(i)]);
  }
  for (std::size_t line = 0; line < lines.size(); ++line) {
    const std::size_t i = line / step_;
    const double here = line_of(i) < lines.size() ? samples_of(lines[line_of(i)]) : 0;
    const double samples = samples_of(lines[line]);
    lines[line].*to = here > 0 ? seen[i] * (samples / here) : all * share_of(samples, all_samples);
  }
}

// What is seen of `boxes` in front of `depths`, which become the boxes' depths.
wire::SeenCounts FrameCounter::draw(shadow::Casting kind, std::span<const raster::EdgeBox> boxes, std::uint32_t line,
                                    std::vector<float>& depths) {
  if (boxes.empty()) return {};
  std::ranges::fill(ids_, shading::kNoTriangle);
  const shading::Extent extent =
      kernels_.draw(triangles_.data(), boxes.data(), static_cast<std::uint32_t>(boxes.size()), line, scene_.pattern(),
                    {depths.data(), ids_.data(), stride_});
  wire::SeenCounts seen;
  bool before = false;
  std::uint32_t in_block = 0;
  for (std::uint32_t x = extent.first; x < extent.last; ++x) {
    const double shaded = seen.shaded;
    count_groups(x, seen);
    const bool shown = seen.shaded > shaded;
    seen.pixels += shown ? 1 : 0;
    seen.runs += shown && !before ? 1 : 0;
    before = shown;
    in_block += shown ? 1 : 0;
    if ((x + 1) % kBlock != 0 && x + 1 < extent.last) continue;
    const std::uint32_t column = x / kBlock, width = std::min(kBlock, scene_.film().settings().width - column * kBlock);
    BlockRow& row = row_of(kind);
    row.shown[column] += in_block > 0 ? 1 : 0;
    row.filled[column] += in_block == width ? 1 : 0;
    seen.block_pixels += 0 < in_block && in_block < kBlock ? kBlock : 0;
    in_block = 0;
  }
  if (kind == shadow::Casting::still && !shadows_) count_kept_groups(line, extent, seen);
  if (shadows_)
    seen.points = shadows_->add(scene_, kind, {line, ids_.data(), depths.data(), stride_, triangles_.data()});
  return seen;
}

void FrameCounter::count_kept_groups(std::uint32_t line, const shading::Extent& extent, wire::SeenCounts& seen) const {
  wire::SeenCounts kept;
  raster::visit_columns(marks_.on(line), scene_.film().settings().width, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t x = std::max(first, extent.first); x < std::min(last, extent.last); ++x) count_groups(x, kept);
  });
  seen.kept_groups = kept.shaded;
}

// Triangles that a pixel shows.
void FrameCounter::count_groups(std::uint32_t column, wire::SeenCounts& seen) const {
  const auto samples = static_cast<std::size_t>(scene_.pattern().count);
  for (std::size_t s = 0; s < samples; ++s) {
    const std::uint32_t id = ids_[s * stride_ + column];
    bool fresh = id != shading::kNoTriangle;
    for (std::size_t before = 0; before < s && fresh; ++before) fresh = ids_[before * stride_ + column] != id;
    if (!fresh) continue;
    ++seen.shaded;
    const wire::Material& material = scene_.film().materials()[triangles_[id].material];
    if (material.interpolation != wire::Interpolation::phong) continue;
    const bool highlight =
        material.reflection == wire::Reflection::phong || material.reflection == wire::Reflection::blinn_phong;
    ++(highlight ? seen.highlights : seen.facets);
  }
}

}  // namespace mars::node
