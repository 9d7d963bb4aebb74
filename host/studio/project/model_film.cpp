#include "host/studio/project/model_film.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "host/content/modeler/frames.h"
#include "host/preview/viewpoint.h"

namespace mars::studio {
namespace {

constexpr double kGroundSize = 4;  // times the radius of what stands on it
constexpr double kThickness = 1e-4;

double radius_of(const modeler::Box& bounds) { return std::max(glm::length(bounds.max - bounds.min) / 2, 1e-6); }

modeler::Box bounds_of(const modeler::Model& model) {
  return modeler::rest_bounds(model).value_or(modeler::Box{{-0.5, -0.5, 0}, {0.5, 0.5, 1}});
}

// Flat, at the top of the unit cube, its outside above.
wire::Patch flat_patch() {
  wire::Patch patch;
  for (std::size_t i = 0; i < 16; ++i) patch.points[i] = {float(i % 4) / 3, float(i / 4) / 3, 1};
  return patch;
}

modeler::Model ground_under(const modeler::Box& bounds) {
  const double radius = radius_of(bounds), side = kGroundSize * radius;
  modeler::Model ground;
  wire::Material material = modeler::default_material();
  material.color[0] = material.color[1] = material.color[2] = 0.36f;
  material.specular = 0;
  material.sides = 1;
  ground.materials.push_back({"ground", material});
  ground.shapes.push_back({"ground", {flat_patch()}, {}});
  modeler::Joint joint;
  joint.name = "ground";
  joint.place = 0.5 * (bounds.min + bounds.max);
  joint.place.z = bounds.min.z;
  joint.segment =
      modeler::Segment{0, {{-side, -side, -2 * kThickness * radius}, {side, side, -kThickness * radius}}, "ground"};
  ground.joints.push_back(std::move(joint));
  return ground;
}

void add_ground(animator::Film& film, modeler::Model ground) {
  animator::Actor actor;
  actor.name = "ground";
  actor.model = film.models.size();
  actor.motion = {animator::constant(glm::dvec3(0)), animator::constant(glm::dvec3(0)), {}};
  actor.motion.pose.resize(ground.joints.size());
  film.models.push_back(std::move(ground));
  film.actors.push_back(std::move(actor));
}

}  // namespace

animator::Film film_of_model(modeler::Model model, const std::string& source) {
  modeler::Model ground = ground_under(bounds_of(model));
  animator::Film film = preview::turntable(std::move(model), source);
  film.frames = 1;
  film.camera.eye.resize(1);
  for (animator::LightMotion& light : film.lights) light.vector.resize(1);
  add_ground(film, std::move(ground));
  return film;
}

void exchange_model(animator::Film& film, modeler::Model& model) {
  film.materials = preview::lent_materials(model);
  film.actors[kModelActor].motion.pose.assign(model.joints.size(), {});
  std::swap(film.models[kModelActor], model);
}

bool suits(const animator::Film& film, const modeler::Model& model) {
  const modeler::Joint& ground = film.models.back().joints.front();
  const modeler::Box bounds = bounds_of(model);
  const double made_for = ground.segment->sbb.max.x / kGroundSize, is = radius_of(bounds);
  return std::abs(bounds.min.z - ground.place.z) < 1e-3 * made_for && is < 1.5 * made_for && is > made_for / 1.5;
}

}  // namespace mars::studio
