#include "node/shadow_counter.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "node/shading/shading.h"
#include "node/shadow/pairs.h"
#include "node/shape/vertices.h"
#include "node/simd/vector_slack.h"

namespace mars::node {
namespace {

using shadow::GridBox;

constexpr std::uint32_t kCountedPoints = 4;  // of a light with size
constexpr std::array kKinds{shadow::Casting::still, shadow::Casting::moving};

constexpr std::size_t number(shadow::Casting kind) { return static_cast<std::size_t>(kind); }

// Of a triangle at a place, in 1/256 pixel.
float value_at(const geometry::Triangle& t, shape::Value value, float x, float y) {
  return t.at_first[value] + (y - static_cast<float>(t.first_y)) * t.per_y[value] +
         (x - static_cast<float>(t.first_x)) * t.per_x[value];
}

float dot(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool is_empty(const GridBox& box) { return box.low_x > box.high_x; }

}  // namespace

ShadowCounter::ShadowCounter(const geometry::Scene& scene, simd::InstructionSet set)
    : kernels_(shadow::shadow_kernels(set)),
      diced_(scene.film().patch_instances()),
      is_needed_(scene.film().patch_instances()),
      casters_(set),
      stretches_((static_cast<std::uint32_t>(scene.width()) + kColumns - 1) / kColumns * 2),
      height_(static_cast<std::uint32_t>(scene.height())) {
  constexpr std::size_t kVertices = shape::Dicer::kMostVertices + simd::kVectorSlack;
  for (auto& axis : grid_) axis.resize(kVertices);
  grid_z_.resize(kVertices);
}

// In an inbetween the still points are those of its keyframe.
void ShadowCounter::begin_frame(bool keyframe) {
  diced_.clear(Casting::moving);
  if (!keyframe) return;
  diced_.clear(Casting::still);
  std::ranges::fill(is_needed_, std::uint8_t{0});
}

void ShadowCounter::begin(const geometry::Scene& scene, wire::FrameKind kind, std::uint32_t step) {
  keyframe_ = kind == wire::FrameKind::keyframe;
  step_ = step;
  if (keyframe_) {
    lights_.clear();
    for (const geometry::EyeLight& light : scene.casting_lights()) add_light(light, scene);
  }
  for (Light& light : lights_)
    for (const shadow::Casting seen : kKinds) {
      if (!keyframe_ && seen == shadow::Casting::still) continue;
      light.seen[number(seen)].assign(light.counted.size(), {});
      light.seen_by_middle[number(seen)] = {};
    }
}

// Points that are evenly spread over the light.
void ShadowCounter::add_light(const geometry::EyeLight& light, const geometry::Scene& scene) {
  Light& added = lights_.emplace_back(Light{light, shadow::light_views(light, scene.projection())});
  const shadow::LightViews& views = added.views;
  const std::uint32_t counted = std::min(kCountedPoints, views.points);
  added.points_each = static_cast<double>(views.points) / counted;
  for (std::uint32_t k = 0; k < counted; ++k) {
    const std::uint32_t point = (2 * k + 1) * views.points / (2 * counted);
    const auto of_point = std::span(views.views).subspan(std::size_t{point} * views.faces, views.faces);
    added.counted.insert(added.counted.end(), of_point.begin(), of_point.end());
  }
}

template <typename Hull>
GridBox ShadowCounter::project(const shadow::LightView& view, const Hull& hull) {
  const float* const along[] = {hull.along[0], hull.along[1], hull.along[2]};
  return kernels_.project(view, along, hull.count, {grid_[0].data(), grid_[1].data(), grid_z_.data()});
}

// As shading decides whether it adds anything, but for what is beyond a light's reach.
bool ShadowCounter::is_lit(const geometry::Scene& scene, const geometry::EyeLight& light, const SeenLine& line,
                           std::uint32_t column, std::size_t sample) const {
  const std::uint32_t id = line.ids[sample * line.stride + column];
  if (id == shading::kNoTriangle) return false;
  const geometry::Triangle& t = line.triangles[id];
  const wire::Material& material = scene.film().materials()[t.material];
  if (material.receives == 0 || material.interpolation != wire::Interpolation::phong) return false;
  const shape::SamplePattern& pattern = scene.pattern();
  const float x = static_cast<float>(column) * shape::kSubpixels + static_cast<float>(pattern.x[sample]);
  const float y = static_cast<float>(line.number) * shape::kSubpixels + static_cast<float>(pattern.y[sample]);
  const std::array normal{value_at(t, shape::kNormalX, x, y), value_at(t, shape::kNormalY, x, y),
                          value_at(t, shape::kNormalZ, x, y)};
  if (light.kind == wire::LightKind::directional) return dot(normal, light.vector) > 0;
  const shape::Projection& p = scene.projection();
  const float w = 1 / line.depths[sample * line.stride + column];
  const std::array to{light.vector[0] - (x / shape::kSubpixels - p.center[0]) / p.scale * w,
                      light.vector[1] - (p.center[1] - y / shape::kSubpixels) / p.scale * w, light.vector[2] + w};
  if (dot(normal, to) <= 0) return false;
  return light.kind != wire::LightKind::spot || -dot(light.axis, to) > light.cos_outer * std::sqrt(dot(to, to));
}

double ShadowCounter::add(const geometry::Scene& scene, Casting seen, const SeenLine& line) {
  const auto width = static_cast<std::uint32_t>(scene.width());
  const auto samples = static_cast<std::uint32_t>(scene.pattern().count);
  double all = 0;
  for (Light& light : lights_) {
    const std::uint32_t pairs = shadow::pairs_a_sample(samples, light.has_size());
    for (std::uint32_t first = 0; first < width; first += kColumns) {
      std::uint32_t active = 0;
      double points = 0;
      for (std::uint32_t k = 0; k < std::min(kColumns, width - first); ++k)
        for (std::uint32_t s = 0; s < samples; ++s) {
          if (!is_lit(scene, light.light, line, first + k, s)) continue;
          points += pairs;
          if (s == 0) active |= 1u << k;
        }
      add_stretch(light, seen, line, first, active, points);
      all += points;
    }
  }
  return all;
}

// Half as wide as a vector, which is as wide as nodes' squares.
void ShadowCounter::add_stretch(Light& light, Casting seen, const SeenLine& line, std::uint32_t first,
                                std::uint32_t active, double points) {
  float inverse_w[kColumns] = {};
  for (std::uint32_t left = active; left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    inverse_w[k] = line.depths[first + static_cast<std::uint32_t>(k)];
  }
  constexpr std::uint32_t kHalf = (1u << kColumns / 2) - 1;
  for (const std::uint32_t some : {active & kHalf, active & ~kHalf}) {
    const double part = active != 0 ? std::popcount(some) / static_cast<double>(std::popcount(active)) : 0;
    const auto on = [&](const shadow::LightView& view, double of_view) {
      return stretch_on(view, light.views.frame, {line.number, first, some, inverse_w, points * part * of_view});
    };
    for (std::size_t view = 0; view < light.counted.size(); ++view)
      light.seen[number(seen)][view].all.push_back(on(light.counted[view], light.points_each / light.views.points));
    if (light.has_size() && light.has_bounds())
      light.seen_by_middle[number(seen)].all.push_back(on(light.views.middle.front(), 1));
  }
}

ShadowCounter::Stretch ShadowCounter::stretch_on(const shadow::LightView& view, const shadow::PointFrame& frame,
                                                 const SeenStretch& seen) const {
  if (seen.active == 0) return {seen.line, shadow::kNowhere, 0};
  shadow::LanePlaces places;
  for (std::uint32_t k = 0; k < kColumns; ++k) {
    places.x[k] = static_cast<float>(k) + 0.5f;
    places.y[k] = 0.5f;
  }
  shadow::PointVector on_grid{};
  kernels_.put_points(view, frame, static_cast<float>(seen.first), static_cast<float>(seen.line), places,
                      seen.inverse_w, seen.active, on_grid);
  const double part = std::popcount(on_grid.active) / static_cast<double>(std::popcount(seen.active));
  return {seen.line, on_grid.active != 0 ? on_grid.box : shadow::kNowhere, seen.points * part};
}

// A stretch stands for the lines up to the next one that was added.
void ShadowCounter::finish(Stretches& stretches) const {
  stretches.tree.clear();
  const std::vector<Stretch>& all = stretches.all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool joins = i + stretches_ < all.size() && all[i + stretches_].line == all[i].line + step_;
    stretches.tree.add(joins ? shadow::around(all[i].box, all[i + stretches_].box) : all[i].box);
  }
  stretches.tree.finish();
}

void ShadowCounter::count(const geometry::Scene& scene, wire::FrameCounts& counts) {
  for (Light& light : lights_)
    for (const Casting seen : kKinds) {
      if (!keyframe_ && seen == Casting::still) continue;
      for (Stretches& stretches : light.seen[number(seen)]) finish(stretches);
      finish(light.seen_by_middle[number(seen)]);
    }
  for (Light& light : lights_) {
    constexpr std::array kMovingAlone{Casting::moving};
    const std::span<const Casting> drawn = keyframe_ ? std::span<const Casting>(kKinds) : kMovingAlone;
    const double still = count_casters(scene, light, Casting::still, drawn, counts);
    const double moving = scene.any_moves() ? count_casters(scene, light, Casting::moving, kKinds, counts) : 0;
    light.times_drawn = light.has_size() ? still + moving : 1;
    light.times_kept = light.has_size() ? moving : 1;
  }
  if (!keyframe_) counts.kept_points += count_kept(scene);
  scale_points(Casting::still, &wire::LineCounts::constant, counts.lines);
  scale_points(Casting::moving, &wire::LineCounts::moving, counts.lines);
}

// By how often points of all lights are put.
void ShadowCounter::scale_points(Casting seen, wire::SeenCounts wire::LineCounts::*of,
                                 std::vector<wire::LineCounts>& lines) const {
  double once = 0, put = 0;
  for (const Light& light : lights_)
    for (const Stretches& stretches : light.seen[number(seen)])
      for (const Stretch& stretch : stretches.all) once += stretch.points, put += stretch.points * light.times_drawn;
  if (once == put) return;
  for (wire::LineCounts& line : lines) (line.*of).points *= put / once;
}

// All where it is not known what may be before a light's points.
void ShadowCounter::mark_shaded(const geometry::Scene& scene, const geometry::Sweep& sweep, raster::StillMarks& marks) {
  if (sweep.casters().empty()) return;
  if (!std::ranges::all_of(lights_, &Light::has_bounds)) return marks.mark_all();
  const auto mark = [&](const Stretch& stretch, std::size_t number) {
    const auto first = static_cast<std::uint32_t>(number % stretches_) * kColumns;
    marks.mark({stretch.line, std::min(stretch.line + step_, static_cast<std::uint32_t>(scene.height()))},
               {first, std::min(first + kColumns, static_cast<std::uint32_t>(scene.width()))});
  };
  for (Light& light : lights_)
    for (const geometry::SweptHull& caster : sweep.casters()) visit_shaded(light, caster, mark);
}

// Of all lights, still points on stretches that moving casters may keep from any light: on all, where that is not
// known of a light.
double ShadowCounter::count_kept(const geometry::Scene& scene) {
  if (lights_.empty()) return 0;
  is_shaded_.assign(lights_.front().seen[number(Casting::still)].front().all.size(), 0);
  if (std::ranges::all_of(lights_, &Light::has_bounds))
    for (Light& light : lights_) find_shaded(scene, light);
  else
    std::ranges::fill(is_shaded_, std::uint8_t{1});
  double points = 0;
  for (const Light& light : lights_)
    for (const Stretches& still : light.seen[number(Casting::still)])
      for (std::size_t i = 0; i < is_shaded_.size(); ++i)
        points += is_shaded_[i] != 0 ? still.all[i].points * step_ * light.times_kept : 0;
  return points;
}

void ShadowCounter::find_shaded(const geometry::Scene& scene, Light& light) {
  casters_.visit_hulls(scene, Casting::moving, [&](const shadow::Hull& hull) {
    visit_shaded(light, hull, [this](const Stretch&, std::size_t stretch) { is_shaded_[stretch] = 1; });
  });
}

// Calls visit(stretch, number) for still stretches with points that a caster within the hull may block.
template <typename Hull, typename Visit>
void ShadowCounter::visit_shaded(Light& light, const Hull& hull, const Visit& visit) {
  std::vector<Stretches>& still = light.seen[number(Casting::still)];
  if (light.has_size())
    return visit_shaded(light.views.middle.front(), hull, light.views.spread,
                        light.seen_by_middle[number(Casting::still)], visit);
  for (std::size_t view = 0; view < light.counted.size(); ++view)
    visit_shaded(light.counted[view], hull, 0, still[view], visit);
}

template <typename Hull, typename Visit>
void ShadowCounter::visit_shaded(const shadow::LightView& view, const Hull& hull, float spread, Stretches& still,
                                 const Visit& visit) {
  const GridBox box = project(view, hull);
  if (is_empty(box)) return;
  for (const std::uint32_t found : still.tree.find(kernels_, box, spread, found_))
    if (found < still.all.size()) visit(still.all[found], found);
}

// Returns the number of chunks.
double ShadowCounter::count_casters(const geometry::Scene& scene, Light& light, Casting casting,
                                    std::span<const Casting> onto, wire::FrameCounts& counts) {
  std::vector<Reach> reaches;  // of the chunk's casters
  double views = 0;            // with points, onto which each caster is put
  for (const Casting seen : onto)
    for (const Stretches& stretches : light.seen[number(seen)])
      views += std::ranges::any_of(stretches.all, [](const Stretch& s) { return s.points > 0; }) ? 1 : 0;
  if (keyframe_) views = std::max(views / static_cast<double>(onto.size()), std::min(views, 1.0));
  const auto matters = [&](const shadow::Hull& hull) {
    const Reach reach = reach_of(hull, light, onto);
    if (reach.lines.any()) reaches.push_back(reach);
    return reach.lines.any();
  };
  double chunks = 0;
  casters_.begin(scene, casting, diced_);
  for (auto chunk = casters_.next(matters); !chunk.empty(); chunk = casters_.next(matters)) {
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      const auto& [lines, put, near, grids] = reaches[i];
      const double triangles = chunk[i].surface->triangles.count, vertices = chunk[i].surface->vertices;
      counts.casters.push_back({lines.first, lines.last + step_, put.first, put.any() ? put.last + step_ : put.first,
                                diced_by(chunk[i], casting), vertices, vertices * (light.has_size() ? near : views),
                                triangles * (light.has_size() ? grids_behind(*chunk[i].surface, light, onto) : grids)});
    }
    reaches.clear();
    ++chunks;
  }
  return chunks;
}

// Those of which an earlier frame of the interval, or another light, found that they matter are kept.
wire::DicedBy ShadowCounter::diced_by(const shadow::ChunkCaster& caster, Casting casting) {
  const bool was_needed = std::exchange(is_needed_[caster.patch], std::uint8_t{casting == Casting::still}) != 0;
  if (was_needed) return wire::DicedBy::shadows;
  return caster.is_new ? wire::DicedBy::none : wire::DicedBy::camera;
}

// Of a light that has a size, grids with points within the box of the caster's vertices.
double ShadowCounter::grids_behind(const shadow::Caster& caster, Light& light, std::span<const Casting> onto) {
  double grids = 0;
  for (std::size_t view = 0; view < light.counted.size(); ++view) {
    const GridBox box = kernels_.project(light.counted[view], caster.place, caster.vertices,
                                         {grid_[0].data(), grid_[1].data(), grid_z_.data()});
    const auto has_points = [&](Casting seen) {
      return !light.seen[number(seen)][view].tree.find(kernels_, box, 0, found_).empty();
    };
    grids += !is_empty(box) && std::ranges::any_of(onto, has_points) ? light.points_each : 0;
  }
  return grids;
}

// A keyframe's points of both kinds lie on the same grid; so do all of a light that has a size.
ShadowCounter::Reach ShadowCounter::reach_of(const shadow::Hull& hull, Light& light, std::span<const Casting> onto) {
  Reach reach;
  for (std::size_t view = 0; view < light.counted.size(); ++view) {
    const GridBox box = project(light.counted[view], hull);
    double near = 0, grids = 0;
    for (const Casting seen : onto) {
      Stretches& stretches = light.seen[number(seen)][view];
      near += !is_empty(box) && stretches.tree.any(kernels_, box, 0) ? 1 : 0;
      grids += extend(stretches, box, 0, reach.put) ? 1 : 0;
    }
    const bool is_one = keyframe_ || light.has_size();
    reach.near += light.points_each * (is_one ? std::min(near, 1.0) : near);
    reach.views += light.points_each * (is_one ? std::min(grids, 1.0) : grids);
  }
  reach.lines = matters_on(hull, light, onto, reach.put);
  return reach;
}

// All lines where it is not known what may be before a light's points.
ShadowCounter::Lines ShadowCounter::matters_on(const shadow::Hull& hull, Light& light, std::span<const Casting> onto,
                                               const Lines& put) {
  if (!light.has_bounds()) return {0, height_ - 1};
  if (!light.has_size()) return put;
  const GridBox box = project(light.views.middle.front(), hull);
  Lines lines;
  for (const Casting seen : onto) extend(light.seen_by_middle[number(seen)], box, light.views.spread, lines);
  return lines;
}

// Whether any of its points may be behind a caster within the box.
bool ShadowCounter::extend(Stretches& stretches, const GridBox& box, float spread, Lines& lines) {
  if (is_empty(box)) return false;
  const auto found = stretches.tree.find(kernels_, box, spread, found_);
  for (const std::uint32_t stretch : found)
    if (stretch < stretches.all.size()) lines.add(stretches.all[stretch].line);
  return !found.empty();
}

}  // namespace mars::node
