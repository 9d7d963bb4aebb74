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

constexpr std::uint32_t kCountedPoints = 4;      // of a light with size
constexpr shadow::Shaft kRay{0, 0, 1, 1, 0, 0};  // towards a point
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

// The points, with more of their plane.
shadow::PointVector joined(shadow::PointVector points, const GridBox& more) {
  if (points.active == 0 || is_empty(more)) return points;
  const GridBox before = std::exchange(points.box, shadow::around(points.box, more));
  points.least += points.per_x * (static_cast<float>(points.box.low_x) - static_cast<float>(before.low_x)) +
                  points.per_y * (static_cast<float>(points.box.low_y) - static_cast<float>(before.low_y));
  return points;
}

}  // namespace

ShadowCounter::ShadowCounter(const geometry::Scene& scene, simd::InstructionSet set)
    : kernels_(shadow::shadow_kernels(set)),
      diced_(scene.film().patch_instances()),
      is_needed_(scene.film().patch_instances()),
      casters_(set),
      stretches_((static_cast<std::uint32_t>(scene.width()) + kColumns - 1) / kColumns * (kColumns / kSquare)),
      height_(static_cast<std::uint32_t>(scene.height())),
      grid_(kernels_) {}

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
      light.seen_by_middle[number(seen)].assign(light.has_size() ? light.views.middle.size() : 0, {});
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
    added.counted_points.push_back(point);
    added.counted.insert(added.counted.end(), of_point.begin(), of_point.end());
  }
}

template <typename Hull>
GridBox ShadowCounter::project(const shadow::LightView& view, const Hull& hull) {
  const float* const along[] = {hull.along[0], hull.along[1], hull.along[2]};
  std::int32_t x[2 * kColumns], y[2 * kColumns];
  float z[2 * kColumns];
  return kernels_.project(view, along, hull.count, {x, y, z});
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
  const float depth = line.depths[sample * line.stride + column], w = p.parallel ? -depth : 1 / depth;
  const float spread = p.parallel ? 1 : w;
  const auto left = static_cast<float>(p.origin[0]), top = static_cast<float>(p.origin[1]);
  const std::array to{light.vector[0] - (x / shape::kSubpixels + left - p.center[0]) / (p.scale * p.squeeze) * spread,
                      light.vector[1] - (p.center[1] - top - y / shape::kSubpixels) / p.scale * spread,
                      light.vector[2] + w};
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

// A quarter of a vector each: as wide as squares of nodes' points are.
void ShadowCounter::add_stretch(Light& light, Casting seen, const SeenLine& line, std::uint32_t first,
                                std::uint32_t active, double points) {
  float depths[kColumns] = {};
  for (std::uint32_t left = active; left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    depths[k] = line.depths[first + static_cast<std::uint32_t>(k)];
  }
  for (std::uint32_t from = 0; from < kColumns; from += kSquare) {
    const std::uint32_t some = active & ((1u << kSquare) - 1) << from;
    const double part = active != 0 ? std::popcount(some) / static_cast<double>(std::popcount(active)) : 0;
    const auto on = [&](const shadow::LightView& view, std::uint32_t lanes) {
      return stretch_on(view, light.views.frame, {line.number, first, lanes, depths, points * part});
    };
    for (std::size_t view = 0; view < light.counted.size(); ++view)
      light.seen[number(seen)][view].all.push_back(
          on(light.counted[view], some & using_point(light, view, first, line.number)));
    for (std::size_t face = 0; light.has_size() && face < light.views.middle.size(); ++face)
      light.seen_by_middle[number(seen)][face].all.push_back(on(light.views.middle[face], some));
  }
}

// Columns whose pixels use the point of a counted view.
std::uint32_t ShadowCounter::using_point(const Light& light, std::size_t view, std::uint32_t first,
                                         std::uint32_t line) const {
  constexpr std::uint32_t kAll = 0xffffffff;
  if (!light.has_size()) return kAll;
  const std::uint32_t point = light.counted_points[view / light.views.faces];
  const auto [left, top] = light.views.frame.origin;
  const std::uint32_t column = first + static_cast<std::uint32_t>(static_cast<std::int32_t>(left));
  const std::uint32_t of_whole = line + static_cast<std::uint32_t>(static_cast<std::int32_t>(top));
  std::uint32_t columns = 0;
  for (std::uint32_t k = 0; k < kColumns; ++k)
    for (std::uint32_t pair = 0; pair < shadow::kPairs; ++pair)
      columns |= static_cast<std::uint32_t>(shadow::point_of_pair(column + k, of_whole, pair) == point) << k;
  return columns;
}

ShadowCounter::Stretch ShadowCounter::stretch_on(const shadow::LightView& view, const shadow::PointFrame& frame,
                                                 const SeenStretch& seen) const {
  Stretch stretch{seen.line, {}, 0};
  stretch.seen.box = shadow::kNowhere;
  if (seen.active == 0) return stretch;
  shadow::LanePlaces places;
  for (std::uint32_t k = 0; k < kColumns; ++k) {
    places.x[k] = static_cast<float>(k) + 0.5f;
    places.y[k] = 0.5f;
  }
  kernels_.put_points(view, frame, static_cast<float>(seen.first), static_cast<float>(seen.line), places, seen.depths,
                      seen.active, stretch.seen);
  if (stretch.seen.active == 0) stretch.seen.box = shadow::kNowhere;
  stretch.points = seen.points * std::popcount(stretch.seen.active) / std::popcount(seen.active);
  return stretch;
}

// A stretch stands for the lines up to the next one that was added.
void ShadowCounter::finish(Stretches& stretches) {
  stretches.points.clear();
  const std::vector<Stretch>& all = stretches.all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool joins = i + stretches_ < all.size() && all[i + stretches_].line == all[i].line + step_;
    stretches.points.add(nowhere_, 0, 0, joins ? joined(all[i].seen, all[i + stretches_].seen.box) : all[i].seen);
  }
  stretches.points.finish();
  stretches.is_met.assign(all.size(), 0);
}

void ShadowCounter::count(const geometry::Scene& scene, wire::FrameCounts& counts) {
  for (Light& light : lights_) {
    light.put = {};
    for (const Casting seen : kKinds) {
      if (!keyframe_ && seen == Casting::still) continue;
      for (auto* views : {&light.seen[number(seen)], &light.seen_by_middle[number(seen)]})
        for (Stretches& stretches : *views) finish(stretches);
    }
  }
  for (Light& light : lights_) {
    constexpr std::array kMovingAlone{Casting::moving};
    count_casters(scene, light, Casting::still, keyframe_ ? std::span<const Casting>(kKinds) : kMovingAlone, counts);
    if (scene.any_moves()) count_casters(scene, light, Casting::moving, kKinds, counts);
  }
  if (!keyframe_) counts.kept_points += count_kept(scene);
  if (keyframe_) scale_points(Casting::still, &wire::LineCounts::constant, counts.lines);
  scale_points(Casting::moving, &wire::LineCounts::moving, counts.lines);
}

// By how often points of all lights are put, which are counted once so far.
void ShadowCounter::scale_points(Casting seen, wire::SeenCounts wire::LineCounts::*of,
                                 std::vector<wire::LineCounts>& lines) const {
  double once = 0, put = 0;
  for (const Light& light : lights_) {
    double points = 0;
    for (const Stretches& stretches : (light.has_size() ? light.seen_by_middle : light.seen)[number(seen)])
      for (const Stretch& stretch : stretches.all) points += stretch.points;
    once += points;
    put += light.has_size() ? light.put[number(seen)] : points;
  }
  if (once == put) return;
  for (wire::LineCounts& line : lines) (line.*of).points *= put / once;
}

// All where it is not known what may be before a light's points.
void ShadowCounter::mark_shaded(const geometry::Scene& scene, const geometry::Sweep& sweep, raster::StillMarks& marks) {
  if (sweep.casters().empty()) return;
  if (!std::ranges::all_of(lights_, &Light::has_bounds)) return marks.mark_all();
  const auto mark = [&](const Stretch& stretch, std::size_t number) {
    const auto first = static_cast<std::uint32_t>(number % stretches_) * kSquare;
    marks.mark({stretch.line, std::min(stretch.line + step_, static_cast<std::uint32_t>(scene.height()))},
               {first, std::min(first + kSquare, static_cast<std::uint32_t>(scene.width()))});
  };
  for (Light& light : lights_)
    for (const geometry::SweptHull& caster : sweep.casters()) visit_shaded(light, caster, mark);
}

// Of lights without size, still points on stretches that moving casters may keep from any light: on all, where that is
// not known of a light. Of others, those that shafts found.
double ShadowCounter::count_kept(const geometry::Scene& scene) {
  if (lights_.empty()) return 0;
  is_shaded_.assign(lights_.front().seen[number(Casting::still)].front().all.size(), 0);
  if (std::ranges::all_of(lights_, &Light::has_bounds))
    for (Light& light : lights_) find_shaded(scene, light);
  else
    std::ranges::fill(is_shaded_, std::uint8_t{1});
  double points = 0;
  for (const Light& light : lights_) {
    if (light.has_size()) {
      points += light.put[number(Casting::still)] * step_;
      continue;
    }
    for (const Stretches& still : light.seen[number(Casting::still)])
      for (std::size_t i = 0; i < is_shaded_.size(); ++i)
        points += is_shaded_[i] != 0 ? still.all[i].points * step_ : 0;
  }
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
                        light.seen_by_middle[number(Casting::still)].front(), visit);
  for (std::size_t view = 0; view < light.counted.size(); ++view)
    visit_shaded(light.counted[view], hull, 0, still[view], visit);
}

template <typename Hull, typename Visit>
void ShadowCounter::visit_shaded(const shadow::LightView& view, const Hull& hull, float spread, Stretches& still,
                                 const Visit& visit) {
  const GridBox box = project(view, hull);
  if (is_empty(box)) return;
  for (const std::uint32_t found : still.points.tree().find(kernels_, box, spread, found_))
    if (found < still.all.size()) visit(still.all[found], found);
}

void ShadowCounter::count_casters(const geometry::Scene& scene, Light& light, Casting casting,
                                  std::span<const Casting> onto, wire::FrameCounts& counts) {
  find_reach(light, onto);
  std::vector<Reach> reaches;  // of the chunk's casters
  const auto may_matter = [&](const shadow::Hull& hull) {
    const Reach reach = reach_of(hull, light, onto);
    if (reach.lines.any()) reaches.push_back(reach);
    return reach.lines.any();
  };
  casters_.begin(scene, casting, diced_);
  for (auto chunk = casters_.next(may_matter); !chunk.empty(); chunk = casters_.next(may_matter)) {
    if (light.has_size()) {
      for (std::size_t i = 0; i < chunk.size(); ++i)
        reaches[i].matters = meet_shafts(chunk[i], light, onto, reaches[i]);
      put_met(light, onto);
    }
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      const auto& [lines, put, matters] = reaches[i];
      const double triangles = chunk[i].surface->triangles.count, vertices = chunk[i].surface->vertices;
      const double grids = matters ? grids_behind(chunk[i], light, onto) : 0;
      counts.casters.push_back({lines.first, lines.last + step_, put.first, put.any() ? put.last + step_ : put.first,
                                diced_by(chunk[i], casting), vertices, vertices * grids, triangles * grids});
    }
    reaches.clear();
  }
}

// Of shafts to a light that has a size, by face.
void ShadowCounter::find_reach(Light& light, std::span<const Casting> onto) const {
  light.reach.clear();
  for (std::size_t face = 0; light.has_size() && face < light.views.middle.size(); ++face) {
    float high_z = 0;
    for (const Casting seen : onto)
      for (const Stretch& stretch : light.seen_by_middle[number(seen)][face].all)
        if (stretch.seen.active != 0) high_z = std::max(high_z, stretch.seen.box.high_z);
    light.reach.push_back(shadow::reach_of(light.views, high_z));
  }
}

// Points are put in squares of which the chunk's casters meet some, whichever face sees these.
void ShadowCounter::put_met(Light& light, std::span<const Casting> onto) {
  for (const Casting seen : onto) {
    std::vector<Stretches>& middle = light.seen_by_middle[number(seen)];
    std::vector<std::uint8_t>& is_met = middle.front().is_met;
    for (std::size_t face = 1; face < middle.size(); ++face)
      for (std::size_t i = 0; i < is_met.size(); ++i) is_met[i] |= middle[face].is_met[i];
    widen(middle.front().all, is_met);
    for (std::size_t i = 0; i < is_met.size(); ++i)
      for (const Stretches& each : middle) light.put[number(seen)] += is_met[i] != 0 ? each.all[i].points : 0;
    for (Stretches& counted : light.seen[number(seen)])
      for (std::size_t i = 0; i < is_met.size(); ++i)
        counted.points.vectors()[i].blocked = is_met[i] != 0 ? 0 : counted.points.vectors()[i].active;
    for (Stretches& each : middle) std::ranges::fill(each.is_met, std::uint8_t{0});
  }
}

// To all lines of squares that were added.
void ShadowCounter::widen(const std::vector<Stretch>& all, std::vector<std::uint8_t>& is_met) const {
  const auto join = [&](std::size_t to, std::size_t from) {
    if (all[to].line / kSquare == all[from].line / kSquare) is_met[to] |= is_met[from];
  };
  for (std::size_t i = stretches_; i < is_met.size(); ++i) join(i, i - stretches_);
  for (std::size_t i = is_met.size(); i-- > stretches_;) join(i - stretches_, i);
}

// Those of which an earlier frame of the interval, or another light, found that they matter are kept.
wire::DicedBy ShadowCounter::diced_by(const shadow::ChunkCaster& caster, Casting casting) {
  const bool was_needed = std::exchange(is_needed_[caster.patch], std::uint8_t{casting == Casting::still}) != 0;
  if (was_needed) return wire::DicedBy::shadows;
  return caster.is_new ? wire::DicedBy::none : wire::DicedBy::camera;
}

// Of a light that has a size: whether the caster may be before any of its points, from any place of the light.
bool ShadowCounter::meet_shafts(const shadow::ChunkCaster& caster, Light& light, std::span<const Casting> onto,
                                Reach& reach) {
  bool any = false;
  for (std::size_t face = 0; face < light.views.middle.size(); ++face) {
    const shadow::LightView& view = light.views.middle[face];
    const bool is_near = shadow::is_near(light.views, face, light.reach[face], caster.hull);
    grid_.put(view, caster.hull);
    const GridBox box = grid_.put(view, *caster.surface);
    if (is_empty(box) && !is_near) continue;
    for (const Casting seen : onto) {
      Stretches& stretches = light.seen_by_middle[number(seen)][face];
      any |= is_near ? touch_all(stretches, reach.put)
                     : touch(view, light.reach[face].shaft, caster, box, stretches, reach.put);
    }
  }
  return any;
}

bool ShadowCounter::touch_all(Stretches& stretches, Lines& put) {
  for (std::size_t i = 0; i < stretches.all.size(); ++i) {
    if (stretches.all[i].seen.active == 0) continue;
    stretches.is_met[i] = 1;
    put.add(stretches.all[i].line);
  }
  return !stretches.points.empty();
}

// As shadow::Shafts does.
bool ShadowCounter::touch(const shadow::LightView& view, const shadow::Shaft& shaft, const shadow::ChunkCaster& caster,
                          const GridBox& box, Stretches& stretches, Lines& put) {
  const std::span<std::uint32_t> below = grid_.find_below(box, shaft, stretches.points);
  if (below.empty()) return false;
  touched_.assign(stretches.all.size(), 0);
  std::uint64_t some = 0;
  grid_.visit_batches(
      view, *caster.surface, shadow::kEverywhere,
      [&](const shadow::SmallBatches& batches, std::uint32_t) {
        kernels_.touch(batches, shaft, stretches.points.vectors(), below.data(),
                       static_cast<std::uint32_t>(below.size()), some, touched_.data());
      },
      [&](std::uint32_t, std::uint32_t) {
        for (const std::uint32_t stretch : below) touched_[stretch] = 1;
      });
  bool any = false;
  for (const std::uint32_t stretch : below) {
    if (touched_[stretch] == 0) continue;
    stretches.is_met[stretch] = 1;
    put.add(stretches.all[stretch].line);
    any = true;
  }
  return any;
}

// Grids with points that the caster may be before.
double ShadowCounter::grids_behind(const shadow::ChunkCaster& caster, Light& light, std::span<const Casting> onto) {
  double all = 0;
  for (std::size_t view = 0; view < light.counted.size(); ++view) {
    const GridBox box = grid_.put(light.counted[view], caster.hull);
    double grids = 0;
    for (const Casting seen : onto)
      grids += grid_.find_below(box, kRay, light.seen[number(seen)][view].points).empty() ? 0 : 1;
    all += light.points_each * (is_one_grid(light) ? std::min(grids, 1.0) : grids);
  }
  return all;
}

// On which lines it may matter.
ShadowCounter::Reach ShadowCounter::reach_of(const shadow::Hull& hull, Light& light, std::span<const Casting> onto) {
  Reach reach;
  for (std::size_t view = 0; !light.has_size() && view < light.counted.size(); ++view) {
    const GridBox box = grid_.put(light.counted[view], hull);
    for (const Casting seen : onto) extend(light.seen[number(seen)][view], box, 0, reach.lines);
  }
  if (!light.has_size()) reach.put = reach.lines;
  for (std::size_t face = 0; light.has_size() && face < light.views.middle.size(); ++face) {
    if (shadow::is_near(light.views, face, light.reach[face], hull)) reach.lines = {0, height_ - 1};
    const GridBox box = grid_.put(light.views.middle[face], hull);
    for (const Casting seen : onto)
      extend(light.seen_by_middle[number(seen)][face], box, light.reach[face].shaft.spread, reach.lines);
  }
  return reach;
}

// Adds those of points that may be behind a caster within the box, and the others of their squares.
void ShadowCounter::extend(Stretches& stretches, const GridBox& box, float spread, Lines& lines) {
  if (is_empty(box)) return;
  for (const std::uint32_t stretch : stretches.points.tree().find(kernels_, box, spread, found_)) {
    if (stretch >= stretches.all.size()) continue;
    const std::uint32_t line = stretches.all[stretch].line, top = line / shadow::kTile * shadow::kTile;
    lines.add(top);
    lines.add(std::max(line, top + shadow::kTile - std::min(step_, shadow::kTile)));
  }
}

}  // namespace mars::node
