#include "node/shadow_counter.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "node/shading/shading.h"
#include "node/shape/vertices.h"
#include "node/simd/vector_slack.h"

namespace mars::node {
namespace {

using shadow::GridBox;

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
      casters_(set),
      stretches_((static_cast<std::uint32_t>(scene.width()) + kColumns - 1) / kColumns) {
  constexpr std::size_t kHull = 16 + simd::kVectorSlack;
  for (auto& axis : grid_) axis.resize(kHull);
  grid_z_.resize(kHull);
}

// In an inbetween the still points are those of its keyframe.
void ShadowCounter::begin(const geometry::Scene& scene, wire::FrameKind kind, std::uint32_t step) {
  keyframe_ = kind == wire::FrameKind::keyframe;
  step_ = step;
  if (keyframe_) {
    lights_.clear();
    for (const geometry::EyeLight& light : scene.casting_lights())
      if (light.size == 0) lights_.push_back({light, shadow::light_views(light, scene.projection()), {}});
  }
  for (Light& light : lights_)
    for (const shadow::Casting seen : kKinds)
      if (keyframe_ || seen == shadow::Casting::moving) light.seen[number(seen)].assign(light.views.views.size(), {});
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
  double all = 0;
  for (Light& light : lights_)
    for (std::uint32_t first = 0; first < width; first += kColumns) {
      std::uint32_t active = 0;
      double points = 0;
      for (std::uint32_t k = 0; k < std::min(kColumns, width - first); ++k)
        for (std::size_t s = 0; s < static_cast<std::size_t>(scene.pattern().count); ++s) {
          if (!is_lit(scene, light.light, line, first + k, s)) continue;
          ++points;
          if (s == 0) active |= 1u << k;
        }
      add_stretch(light, seen, line, first, active, points);
      all += points;
    }
  return all;
}

void ShadowCounter::add_stretch(Light& light, Casting seen, const SeenLine& line, std::uint32_t first,
                                std::uint32_t active, double points) {
  shadow::LanePlaces places;
  float inverse_w[kColumns];
  for (std::uint32_t k = 0; k < kColumns; ++k) {
    places.x[k] = static_cast<float>(k) + 0.5f;
    places.y[k] = 0.5f;
    inverse_w[k] = (active >> k & 1) != 0 ? line.depths[first + k] : 0;
  }
  for (std::size_t view = 0; view < light.views.views.size(); ++view) {
    shadow::PointVector on_grid{};
    if (active != 0)
      kernels_.put_points(light.views.views[view], light.views.frame, static_cast<float>(first),
                          static_cast<float>(line.number), places, inverse_w, active, on_grid);
    const double part = active != 0 ? std::popcount(on_grid.active) / static_cast<double>(std::popcount(active)) : 0;
    const GridBox box = on_grid.active != 0 ? on_grid.box : shadow::kNowhere;
    light.seen[number(seen)][view].all.push_back({line.number, box, points * part});
  }
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
  for (Light& light : lights_) {
    for (const Casting seen : kKinds)
      if (keyframe_ || seen == Casting::moving)
        for (Stretches& stretches : light.seen[number(seen)]) finish(stretches);
    if (!keyframe_) counts.kept_points += find_kept(scene, light);
    constexpr std::array kMovingAlone{Casting::moving};
    count_casters(scene, light, Casting::still, keyframe_ ? std::span<const Casting>(kKinds) : kMovingAlone, counts);
    if (scene.any_moves()) count_casters(scene, light, Casting::moving, kKinds, counts);
  }
}

void ShadowCounter::mark_shaded(const geometry::Scene& scene, const geometry::Sweep& sweep, raster::StillMarks& marks) {
  if (sweep.casters().empty()) return;
  if (lights_.size() < scene.casting_count()) return marks.mark_all();
  const auto mark = [&](const Stretch& stretch, std::size_t number) {
    const auto first = static_cast<std::uint32_t>(number % stretches_) * kColumns;
    marks.mark({stretch.line, std::min(stretch.line + step_, static_cast<std::uint32_t>(scene.height()))},
               {first, std::min(first + kColumns, static_cast<std::uint32_t>(scene.width()))});
  };
  for (Light& light : lights_)
    for (std::size_t view = 0; view < light.views.views.size(); ++view) {
      Stretches& still = light.seen[number(Casting::still)][view];
      for (const geometry::SweptHull& caster : sweep.casters()) {
        const GridBox box = project(light.views.views[view], caster);
        if (is_empty(box)) continue;
        for (const std::uint32_t found : still.tree.find(kernels_, box, 0, found_))
          if (found < still.all.size()) mark(still.all[found], found);
      }
    }
}

// Still points on stretches that moving casters may block.
double ShadowCounter::find_kept(const geometry::Scene& scene, Light& light) {
  double points = 0;
  for (std::size_t view = 0; view < light.views.views.size(); ++view) {
    Stretches& still = light.seen[number(Casting::still)][view];
    std::vector<std::uint8_t> is_shaded(still.all.size());
    casters_.visit_hulls(scene, Casting::moving, [&](const shadow::Hull& hull) {
      const GridBox box = project(light.views.views[view], hull);
      if (is_empty(box)) return;
      for (const std::uint32_t stretch : still.tree.find(kernels_, box, 0, found_))
        if (stretch < is_shaded.size()) is_shaded[stretch] = 1;
    });
    for (std::size_t i = 0; i < is_shaded.size(); ++i) points += is_shaded[i] != 0 ? still.all[i].points * step_ : 0;
  }
  return points;
}

void ShadowCounter::count_casters(const geometry::Scene& scene, Light& light, Casting casting,
                                  std::span<const Casting> onto, wire::FrameCounts& counts) {
  std::vector<Reach> reaches;  // of the chunk's casters
  double views = 0;            // with points, onto which each caster is put
  for (const Casting seen : onto)
    for (const Stretches& stretches : light.seen[number(seen)])
      views += std::ranges::any_of(stretches.all, [](const Stretch& s) { return s.points > 0; }) ? 1 : 0;
  if (keyframe_) views = std::max(views / static_cast<double>(onto.size()), std::min(views, 1.0));
  const auto matters = [&](const shadow::Hull& hull) {
    Reach reach;
    for (std::size_t view = 0; view < light.views.views.size(); ++view)
      extend(light, onto, view, project(light.views.views[view], hull), reach);
    if (reach.views > 0) reaches.push_back(reach);
    return reach.views > 0;
  };
  casters_.begin(scene, casting, diced_);
  for (auto chunk = casters_.next(matters); !chunk.empty(); chunk = casters_.next(matters)) {
    for (std::size_t i = 0; i < chunk.size(); ++i)
      counts.casters.push_back({reaches[i].first, reaches[i].last + step_, !casters_.has_diced(*chunk[i]),
                                static_cast<double>(chunk[i]->vertices), chunk[i]->vertices * views,
                                chunk[i]->triangles.count * reaches[i].views});
    reaches.clear();
  }
}

// A keyframe's points of both kinds lie on the same grid.
void ShadowCounter::extend(Light& light, std::span<const Casting> onto, std::size_t view, const GridBox& box,
                           Reach& reach) {
  if (is_empty(box)) return;
  double grids = 0;
  for (const Casting seen : onto) {
    Stretches& stretches = light.seen[number(seen)][view];
    const auto found = stretches.tree.find(kernels_, box, 0, found_);
    for (const std::uint32_t stretch : found) {
      if (stretch >= stretches.all.size()) continue;
      reach.first = std::min(reach.first, stretches.all[stretch].line);
      reach.last = std::max(reach.last, stretches.all[stretch].line);
    }
    grids += found.empty() ? 0 : 1;
  }
  reach.views += keyframe_ ? std::min(grids, 1.0) : grids;
}

}  // namespace mars::node
