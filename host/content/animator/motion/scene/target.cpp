#include "host/content/animator/motion/scene/target.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/motion/body/surface.h"

namespace mars::motion {
namespace {

glm::dvec3 corner(const wire::Matrix& matrix, int number) {
  const double p[] = {double(number & 1), double(number >> 1 & 1), double(number >> 2 & 1)};
  glm::dvec3 point;
  for (std::size_t row = 0; row < 3; ++row)
    point[int(row)] = matrix.m[row][0] * p[0] + matrix.m[row][1] * p[1] + matrix.m[row][2] * p[2] + matrix.m[row][3];
  return point;
}

// Of the boxes of rigid segments the corners, and of skins as they are bent points all over them: of those that belong
// to the target, a joint's own segment, or if it has none what of skins follows it most.
std::vector<glm::dvec3> points_of(const animator::Film& film, const Target& target, const animator::ActorState& state) {
  const modeler::Model& model = film.model_of(target.actor);
  const bool is_all = target.joint == modeler::kNone;
  std::vector<glm::dvec3> points;
  bool has_skin = false;
  for (std::size_t joint = 0; joint < state.segments.size(); ++joint) {
    if (!state.segments[joint]) continue;
    if (!state.bones[joint].empty() && !state.joints.empty())
      has_skin = true;
    else if (is_all || joint == target.joint)
      for (int i = 0; i < 8; ++i) points.push_back(corner(*state.segments[joint], i));
  }
  if (!has_skin) return points;
  const bool is_bone = !is_all && !model.joints[target.joint].segment;
  const Surface surface = surface_of(
      model, [&](std::size_t joint) { return state.joints[joint]; }, kCoarseGrid);
  for (const SurfacePoint& point : surface.points)
    if (!model.joints[point.segment].segment->bones.empty() &&
        (is_all || (is_bone ? point.joint : point.segment) == target.joint))
      points.push_back(point.place);
  return points;
}

Block block_around(const std::vector<glm::dvec3>& points, const glm::dmat3& axes) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& point : points) {
    low = glm::min(low, glm::transpose(axes) * point);
    high = glm::max(high, glm::transpose(axes) * point);
  }
  return {axes * (0.5 * (low + high)), axes, 0.5 * (high - low)};
}

}  // namespace

double Block::top() const { return middle.z + glm::dot(glm::abs(glm::dvec3(axes[0].z, axes[1].z, axes[2].z)), half); }

double Block::bottom() const { return 2 * middle.z - top(); }

std::size_t joint_named(const Scene& scene, const modeler::Model& model, std::string_view parameter,
                        const std::string& name) {
  std::vector<std::string_view> names;
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
    if (model.joints[joint].name == name) return joint;
    names.push_back(model.joints[joint].name);
  }
  scene.arguments.refuse(parameter, "names '" + name + "', which is no joint of the model",
                         document::did_you_mean(name, names, "name one of its joints"));
}

std::optional<Target> target_of(const Scene& scene, std::string_view parameter) {
  const std::optional<std::string> word = scene.arguments.word(parameter);
  if (!word) return std::nullopt;
  const std::size_t slash = word->find('/');
  const std::string name = word->substr(0, slash);
  std::vector<std::string_view> names;
  for (std::size_t actor = 0; actor < scene.film.actors.size(); ++actor) {
    names.push_back(scene.film.actors[actor].name);
    if (names.back() != name) continue;
    if (!scene.film.actors[actor].matrices.empty())
      scene.arguments.refuse(parameter, "names '" + name + "', which is moved by matrices", "name another actor");
    if (slash == std::string::npos) return Target{actor};
    const modeler::Model& model = scene.film.model_of(actor);
    return Target{actor, joint_named(scene, model, parameter, word->substr(slash + 1))};
  }
  scene.arguments.refuse(parameter, "names '" + name + "', which is no actor of the film",
                         document::did_you_mean(name, names, "name an actor, or ACTOR/JOINT"));
}

std::string name_of(const animator::Film& film, const Target& target) {
  const animator::Actor& actor = film.actors[target.actor];
  return target.joint == modeler::kNone ? actor.name
                                        : actor.name + "/" + film.models[actor.model].joints[target.joint].name;
}

glm::dvec3 place_of(const animator::Film& film, const Target& target, std::uint32_t frame) {
  const animator::ActorState state = animator::state_at(film, target.actor, frame);
  if (target.joint != modeler::kNone) return state.joints[target.joint].place;
  const std::vector<glm::dvec3> points = points_of(film, target, state);
  return points.empty() ? state.root.place : block_around(points, state.root.turn).middle;
}

Block block_of(const Scene& scene, const Target& target, std::uint32_t frame) {
  const animator::ActorState state = animator::state_at(scene.film, target.actor, frame);
  const std::vector<glm::dvec3> points = points_of(scene.film, target, state);
  if (points.empty())
    throw Failure("'" + name_of(scene.film, target) + "' has no segment", scene.where(),
                  "name an actor or a joint that is to be seen");
  return block_around(points, target.joint == modeler::kNone ? state.root.turn : state.joints[target.joint].turn);
}

}  // namespace mars::motion
