#include "node/frame_counter.h"

#include <algorithm>

#include "node/simd/vector_slack.h"

namespace mars::node {
namespace {

constexpr std::uint32_t kSampledLines = 64;
constexpr std::size_t kShareBytes = std::size_t{16} << 20;  // what does not fit is counted, and taken for unseen

constexpr std::uint32_t kBlock = 16;  // side of the compositor's blocks, by default

double share_of(double part, double whole) { return whole > 0 ? part / whole : 0; }

}  // namespace

FrameCounter::FrameCounter(const wire::PackedFilm& film, simd::InstructionSet set)
    : scene_(film),
      boxes_(film),
      marks_(film.settings().width, film.settings().height),
      tessellator_(set),
      kernels_(raster::raster_kernels(set)),
      step_(std::max(1u, film.settings().height / kSampledLines)),
      stride_(film.settings().width + 2 * simd::kVectorSlack),
      memory_(kShareBytes),
      all_lines_(film.settings().height, 1),
      share_loads_(film.settings().height),
      loads_(film.settings().height),
      moving_columns_(film.settings().height),
      moving_loads_(film.settings().height),
      sampled_((film.settings().height + step_ - 1) / step_),
      ids_(std::size_t{stride_} * film.settings().samples),
      depths_(ids_.size()) {
  if (film.casting_count() > 0) shadows_.emplace(scene_, set);
}

wire::FrameCounts FrameCounter::count_keyframe(std::uint32_t interval, std::span<const std::uint32_t> frames) {
  scene_.set_interval(interval);
  wire::FrameCounts counts = count(wire::FrameKind::keyframe, frames.front());
  marks_.clear();
  sweep_.begin(scene_, frames.size() > 1 ? frames : frames.first(0), boxes_,
               [this](const geometry::PictureBounds& bounds) { marks_.mark(bounds.lines, bounds.columns); });
  note_marked(counts, &wire::LineCounts::swept_width);
  if (shadows_) shadows_->mark_shaded(scene_, sweep_, marks_);
  note_marked(counts, &wire::LineCounts::kept_width);
  const geometry::LineRange still = sweep_.lines();
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
  triangles_.clear();
  if (shadows_) shadows_->begin_frame(keyframe);
  for (SampledLine& line : sampled_) line.stationary.clear(), line.moving.clear();
  std::ranges::fill(loads_, raster::LineLoad());
  std::ranges::fill(moving_loads_, raster::LineLoad());
  std::ranges::fill(moving_columns_, Columns());
  wire::FrameCounts counts;
  counts.kind = kind;
  counts.frame = frame;
  counts.lines.resize(loads_.size());
  for (std::uint32_t share = 0; share < wire::kCountedShares; ++share)
    counts.shares.push_back(count_share(share, keyframe));
  for (std::size_t line = 0; line < loads_.size(); ++line) {
    counts.lines[line].edge_boxes = static_cast<double>(loads_[line].boxes());
    counts.lines[line].samples = static_cast<double>(loads_[line].samples());
    counts.lines[line].moving_edge_boxes = static_cast<double>(moving_loads_[line].boxes());
    counts.lines[line].moving_samples = static_cast<double>(moving_loads_[line].samples());
    counts.lines[line].moving_width = moving_columns_[line].width();
  }
  if (shadows_) shadows_->begin(scene_, kind, step_);
  estimate_seen(counts.lines, keyframe);
  if (shadows_) shadows_->count(scene_, counts);
  return counts;
}

wire::UnitCounts FrameCounter::count_share(std::uint32_t share, bool keyframe) {
  raster::Arena arena(memory_.bytes());
  auto* const first = reinterpret_cast<geometry::Triangle*>(memory_.bytes().data());
  const std::span<const std::uint8_t> all = all_lines_;
  wire::WorkCounts work{};
  const Tessellation made = tessellator_.tessellate(
      scene_, {share, wire::kCountedShares}, {all, keyframe ? all : std::span<const std::uint8_t>(), share_loads_},
      {arena, first}, work, shadows_ ? &shadows_->diced() : nullptr);
  for (std::size_t line = 0; line < loads_.size(); ++line) loads_[line] += share_loads_[line];
  for (const raster::UnsortedEdgeBox& box : made.polygons.moving) {
    moving_loads_[box.line] += raster::LineLoad(1, box.box.width());
    moving_columns_[box.line].add(box.box.first, box.box.last());
  }
  keep_sampled(made.polygons.stationary, made.polygons.triangles, false);
  keep_sampled(made.polygons.moving, made.polygons.triangles, true);
  return units_of(made, work);
}

wire::UnitCounts FrameCounter::units_of(const Tessellation& made, const wire::WorkCounts& work) const {
  using wire::Work;
  wire::UnitCounts units;
  const auto set = [&](Work kind, std::uint64_t count) { units[kind] = static_cast<double>(count); };
  set(Work::patch, made.surfaces.patches);
  set(Work::meshlet, made.surfaces.meshlets);
  set(Work::vertex, made.surfaces.vertices);
  set(Work::mesh_vertex, made.surfaces.mesh_vertices);
  set(Work::triangle_tested, work.triangles_tested);
  set(Work::row_tested, work.triangles_tested * static_cast<std::uint64_t>(scene_.pattern().count));
  set(Work::vertex_light, made.surfaces.colored * scene_.lights().size());
  set(Work::triangle, made.made.triangles);
  set(Work::edge_box_made, made.made.edge_boxes);
  return units;
}

// Boxes of a triangle follow each other.
void FrameCounter::keep_sampled(std::span<const raster::UnsortedEdgeBox> boxes, const geometry::Triangle* triangles,
                                bool moving) {
  std::uint32_t last = 0xffffffff;
  for (const raster::UnsortedEdgeBox& unsorted : boxes) {
    if (unsorted.line % step_ != step_ / 2) continue;
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
void FrameCounter::estimate_seen(std::vector<wire::LineCounts>& lines, bool keyframe) {
  std::vector<wire::SeenCounts> constant(sampled_.size()), moving(sampled_.size());
  for (std::size_t i = 0; i < sampled_.size() && line_of(i) < lines.size(); ++i) {
    SampledLine& line = sampled_[i];
    if (keyframe) {
      line.constant_depth.assign(ids_.size(), 0.0f);
      constant[i] = draw(shadow::Casting::still, line.stationary, line_of(i), line.constant_depth);
    }
    depths_ = line.constant_depth;
    moving[i] = draw(shadow::Casting::moving, line.moving, line_of(i), depths_);
  }
  spread(constant, lines, &wire::LineCounts::constant,
         [](const wire::LineCounts& line) { return line.samples - line.moving_samples; });
  spread(moving, lines, &wire::LineCounts::moving, [](const wire::LineCounts& line) { return line.moving_samples; });
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
    seen.block_pixels += 0 < in_block && in_block < kBlock ? kBlock : 0;
    in_block = 0;
  }
  if (shadows_)
    seen.points = shadows_->add(scene_, kind, {line, ids_.data(), depths.data(), stride_, triangles_.data()});
  return seen;
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
