#include "host/preview/viewpoint.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "host/content/animator/reading/read_materials.h"
#include "host/content/animator/reading/rig.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/frames.h"

namespace mars::preview {
namespace {

constexpr double kFov = 30;  // vertical, degrees
constexpr double kMargin = 1.08;
constexpr double kNearPlane = 1e-9, kFarPlane = 1e12;  // that a compiled film allows

const double kFocal = 1 / elementary::tan(kFov / 2 * modeler::kDegree);

glm::dvec3 outward(const Orbit& orbit) {
  const double turn = orbit.turn * modeler::kDegree, height = orbit.height * modeler::kDegree;
  return {elementary::cos(height) * elementary::cos(turn), elementary::cos(height) * elementary::sin(turn),
          elementary::sin(height)};
}

}  // namespace

Orbit orbit_from(From from, const Ball& subject, double aspect) {
  Orbit orbit;
  orbit.center = subject.center;
  if (from != From::front) orbit.turn = -90;
  if (from == From::top) orbit.height = 90;
  const double half = elementary::atan(std::min(1.0, aspect) / kFocal);
  orbit.distance = kMargin * std::max(subject.radius, 1e-6) / elementary::sin(half);
  return orbit;
}

Orbit orbit_near(const wire::Camera& camera, const Ball& subject) {
  const auto& m = camera.world_to_eye.m;
  glm::dvec3 eye(0);  // -R^T t
  for (std::size_t row = 0; row < 3; ++row) eye -= m[row][3] * glm::dvec3(m[row][0], m[row][1], m[row][2]);
  const glm::dvec3 out(m[2][0], m[2][1], m[2][2]);
  const double before = glm::dot(eye - subject.center, out);
  const double depth = before > kMargin * subject.radius ? before : kMargin * std::max(subject.radius, 1e-6);
  Orbit orbit;
  orbit.center = eye - depth * out;
  orbit.turn = elementary::atan2(out.y, out.x) / modeler::kDegree;
  orbit.height = elementary::atan2(out.z, elementary::hypot(out.x, out.y)) / modeler::kDegree;
  // As large as the camera showed it.
  const double shown_at = camera.projection == wire::Projection::orthographic ? 1 : depth;
  orbit.distance = std::max(shown_at * kFocal / camera.focal, 1e-6);
  return orbit;
}

glm::dvec3 eye_of(const Orbit& orbit, const wire::Camera& camera) {
  const double lens = camera.projection == wire::Projection::orthographic ? 1 : camera.focal / kFocal;
  return orbit.center + orbit.distance * lens * outward(orbit);
}

double height_of(const Orbit& orbit) { return 2 * orbit.distance / kFocal; }

wire::Camera parallel_camera_of(const Orbit& orbit) {
  constexpr double kAway = 16, kBehind = 1000;  // distances, before all that is shown and behind it
  Orbit away = orbit;
  away.distance *= kAway;
  wire::Camera camera = camera_of(away);
  camera.projection = wire::Projection::orthographic;
  camera.focal = 2 / height_of(orbit);
  camera.far = std::min(orbit.distance * (kAway + kBehind), kFarPlane);
  return camera;
}

wire::Camera camera_of(const Orbit& orbit) {
  const double turn = orbit.turn * modeler::kDegree;
  const glm::dvec3 out = outward(orbit), right(-elementary::sin(turn), elementary::cos(turn), 0);
  const glm::dvec3 eye = orbit.center + orbit.distance * out;
  const std::array<glm::dvec3, 3> axes{right, glm::cross(out, right), out};
  wire::Camera camera;
  for (std::size_t row = 0; row < 3; ++row)
    camera.world_to_eye.m[row] = {axes[row].x, axes[row].y, axes[row].z, -glm::dot(axes[row], eye)};
  camera.focal = kFocal;
  camera.near = std::max(orbit.distance / 1000, kNearPlane);
  camera.far = std::min(orbit.distance * 1000, kFarPlane);
  return camera;
}

std::vector<animator::MaterialMotion> lent_materials(const modeler::Model& model) {
  std::set<std::string> names;
  for (const modeler::Joint& joint : model.joints)
    if (joint.segment && !joint.segment->material.empty()) names.insert(joint.segment->material);
  for (const modeler::NamedMaterial& own : model.materials) names.erase(own.name);
  std::vector<animator::MaterialMotion> materials;
  for (const std::string& name : names)
    materials.push_back(animator::still_material(name, modeler::default_material()));
  return materials;
}

animator::Film turntable(modeler::Model model, const std::string& source) {
  constexpr std::uint32_t kFrames = 96;
  animator::Film film;
  film.source = source;
  film.frames = kFrames;
  film.background = {0.12, 0.14, 0.20};
  film.materials = lent_materials(model);
  animator::Actor actor;
  actor.name = "model";
  actor.model = 0;
  actor.motion = {animator::constant(glm::dvec3(0)), animator::constant(glm::dvec3(0)), {}};
  actor.motion.pose.resize(model.joints.size());
  film.models.push_back(std::move(model));
  film.actors.push_back(std::move(actor));
  film.camera.eye = animator::constant(animator::Point{{1, 0, 0}});
  film.camera.at = animator::constant(animator::Point{});
  film.camera.up = animator::constant(glm::dvec3(0, 0, 1));
  film.camera.fov = animator::constant(kFov);
  film.camera.height = animator::constant(1.0);
  film.camera.shift = animator::constant(glm::dvec2(0));
  film.camera.exposure = animator::constant(0.0);
  film.lights = animator::rig_lights(film);
  film.ambient = animator::rig_ambient(film.color);
  film.frames = 1;
  const Ball ball = wireframe_of(film::compile(film), &film).whole;  // its size is known when it is compiled
  film.frames = kFrames;
  Orbit orbit = orbit_from(From::front, ball, 1);
  orbit.height = 12;
  film.camera.at = animator::constant(animator::Point{ball.center});
  film.camera.eye.clear();
  for (animator::LightMotion& light : film.lights) light.vector.clear();
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    orbit.turn = 360.0 * frame / kFrames - 30;
    const glm::dvec3 eye = ball.center + orbit.distance * outward(orbit);
    film.camera.eye.push_back({frame, animator::Point{eye}, animator::kLinear});
    const auto directions = animator::rig_directions(eye, ball.center, {0, 0, 1});
    for (std::size_t i = 0; i < film.lights.size(); ++i)
      film.lights[i].vector.push_back({frame, directions[i], animator::kLinear});
  }
  film.camera.near = std::max(orbit.distance / 1000, kNearPlane);
  film.camera.far = std::min(orbit.distance * 1000, kFarPlane);
  return film;
}

film::CompiledFilm as_seen(const film::CompiledFilm& film, std::array<std::uint32_t, 2> size,
                           const wire::Camera* camera) {
  film::CompiledFilm seen = film;
  const wire::PackedFilm view = seen.view();
  std::byte* const block = reinterpret_cast<std::byte*>(seen.lines.data());
  const auto put = [&](const void* at, const void* value, std::size_t bytes) {
    std::memcpy(block + (static_cast<const std::byte*>(at) - seen.block().data()), value, bytes);
  };
  wire::FilmSettings settings = view.settings();
  settings.width = size[0];
  settings.height = size[1];
  if (camera != nullptr) {
    const wire::Camera& first = view.camera_at(0);
    wire::Camera by = *camera;
    by.exposure = first.exposure;
    put(&first, &by, sizeof by);
    settings.camera.count = 1;
  }
  put(&view.settings(), &settings, sizeof settings);
  return seen;
}

}  // namespace mars::preview
