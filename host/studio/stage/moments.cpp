#include "host/studio/stage/moments.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "hal/failure/failure.h"

namespace mars::studio {
namespace {

constexpr std::uint64_t kMostMatrices = 200'000;  // of a film whose intervals are cut between two pictures

// Whether it is a figure, not a floor or a chair.
bool has_limbs(const modeler::Model& model) {
  return model.limbs.of(modeler::Trunk::pelvis) != modeler::kNone ||
         model.limbs.of(modeler::Limb::hip, modeler::Side::left) != modeler::kNone;
}

}  // namespace

bool moves(const animator::Actor& actor) {
  const auto keyed = [](const auto& channel) { return channel.size() > 1; };
  return !actor.attach.empty() || keyed(actor.motion.place) || keyed(actor.motion.turn) ||
         std::any_of(actor.motion.pose.begin(), actor.motion.pose.end(), keyed) ||
         std::any_of(actor.matrices.begin(), actor.matrices.end(), keyed);
}

void Moments::renew() {
  if (revision_ == project_.revision() && frame_ == project_.frame()) return;
  try {
    if (shapes_revision_ != project_.shapes_revision()) load_shapes();
    take_moment();
    problem_.clear();
  } catch (const Failure& failure) {
    problem_ = failure.what();
  }
  revision_ = project_.revision();
  frame_ = project_.frame();
}

// Nodes get the moment as their film: one frame of it, for shapes are all that counts.
void Moments::load_shapes() {
  film::FilmShapes shapes = film::shapes_of(project_.film());
  wire::FilmData film = film::moment_of(project_.film(), shapes.numbers, project_.frame());
  shapes_ = std::move(shapes);
  const wire::FilmData& parts = shapes_.parts;
  film.patches = parts.patches;
  film.mesh_places = parts.mesh_places;
  film.mesh_normals = parts.mesh_normals;
  film.mesh_triangles = parts.mesh_triangles;
  film.net_points = parts.net_points;
  film.stencil_terms = parts.stencil_terms;
  film.stencils = parts.stencils;
  film.net_patches = parts.net_patches;
  film.skin_bones = parts.skin_bones;
  film.skin_weights = parts.skin_weights;
  film.meshlets = parts.meshlets;
  film.shapes = parts.shapes;
  film_block_ = std::make_shared<const std::vector<std::byte>>(wire::pack(film));
  shapes_revision_ = project_.shapes_revision();
  ++film_number_;
}

void Moments::take_moment() {
  wire::FilmData moment = film::moment_of(project_.film(), shapes_.numbers, project_.frame());
  put_pulled(moment);
  now_ = std::make_shared<const wire::FilmData>(std::move(moment));
  owners_.clear();
  const animator::Film& film = project_.film();
  for (std::size_t actor = 0; actor < film.actors.size(); ++actor) {
    const auto& joints = film.model_of(actor).joints;
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      if (joints[joint].segment) owners_.push_back({actor, joint});
  }
  ++number_;
}

void Moments::put_pulled(wire::FilmData& moment) const {
  const auto pulled = project_.pulled();
  if (!pulled) return;
  const animator::Film& film = project_.film();
  moment.patches = film.models[pulled->model].shapes[pulled->shape].patches;
  moment.shapes = {{0, static_cast<std::uint32_t>(moment.patches.size())}};
  std::size_t segment = 0;
  for (const animator::Actor& actor : film.actors)
    for (const modeler::Joint& joint : film.models[actor.model].joints) {
      if (!joint.segment) continue;
      if (actor.model == pulled->model && joint.segment->shape == pulled->shape)
        moment.segments[segment].shape = static_cast<std::uint32_t>(shapes_.parts.shapes.size());
      ++segment;
    }
}

std::vector<std::array<float, 3>> Moments::bent(std::size_t segment, const wire::Skin& skin,
                                                std::span<const std::array<float, 3>> points) const {
  const wire::FilmData& parts = shapes_.parts;
  const modeler::BentSkin bones = bones_of(segment);
  std::vector<std::array<float, 3>> places;
  std::vector<modeler::BoneWeight> follows;
  for (std::size_t point = 0; point < points.size(); ++point) {
    follows.clear();
    const float* weight = parts.skin_weights.data() + skin.first_weight + point;
    for (std::uint32_t i = 0; i < skin.bone_count; ++i, weight += points.size())
      if (*weight > 0) follows.push_back({parts.skin_bones[skin.first_bone + i], *weight});
    const glm::dvec3 place = modeler::placed(bones.matrix_of(follows), points[point]);
    places.push_back({float(place.x), float(place.y), float(place.z)});
  }
  return places;
}

modeler::BentSkin Moments::bones_of(std::size_t segment) const {
  const wire::Segment& of = now_->segments[segment];
  std::vector<wire::Matrix> bones;
  for (std::size_t bone = 0; bone < of.bone_count; ++bone) bones.push_back(bone_of(of, bone));
  return {std::move(bones), of.blend};
}

std::vector<std::array<float, 3>> Moments::bent_places(std::size_t segment, const wire::Meshlet& meshlet) const {
  return bent(segment, meshlet.skin,
              std::span(shapes_.parts.mesh_places).subspan(meshlet.first_vertex, meshlet.vertex_count));
}

std::vector<wire::Patch> Moments::bent_patches(std::size_t segment) const {
  const auto [actor, joint] = owners_[segment];
  const modeler::Model& model = project_.film().model_of(actor);
  const modeler::Shape& shape = model.shapes[model.joints[joint].segment->shape];
  if (!shape.net) return {};
  return bones_of(segment).patches_of(*shape.net);
}

std::uint32_t Moments::bone_at(std::size_t segment, std::size_t patch, std::size_t point) const {
  const auto [actor, joint] = owners_[segment];
  const modeler::Model& model = project_.film().model_of(actor);
  const modeler::ControlNet& net = *model.shapes[model.joints[joint].segment->shape].net;
  return modeler::heaviest_bone(modeler::followed_by(net, net.patches[patch][point]));
}

const wire::Shape& Moments::shape_of(std::size_t segment) const {
  const std::size_t number = now_->segments[segment].shape, of_film = shapes_.parts.shapes.size();
  return number >= of_film ? now_->shapes[number - of_film] : shapes_.parts.shapes[number];
}

std::span<const wire::Patch> Moments::patches_of(std::size_t segment) const {
  const bool own = now_->segments[segment].shape >= shapes_.parts.shapes.size();
  const wire::Shape& shape = shape_of(segment);
  return std::span(own ? now_->patches : shapes_.parts.patches).subspan(shape.first_patch, shape.patch_count);
}

preview::Ball Moments::subject() const {
  if (!show_the_film()) return {{0, 0, 0}, 1};
  const animator::Film& film = project_.film();
  const bool any_moves = std::ranges::any_of(film.actors, moves);
  const auto counts = [&](const Owner& owner) {
    if (project_.is_model()) return owner.actor == 0;
    const animator::Actor& actor = film.actors[owner.actor];
    return any_moves ? moves(actor) : has_limbs(film.models[actor.model]);
  };
  if (const auto ball = ball_of(counts)) return *ball;
  return ball_of([](const Owner&) { return true; }).value_or(preview::Ball{{0, 0, 0}, 1});
}

std::optional<preview::Ball> Moments::ball_of(const std::function<bool(const Owner&)>& counts) const {
  glm::dvec3 low(1e300), high(-1e300);
  for (std::size_t segment = 0; segment < owners_.size(); ++segment) {
    if (!counts(owners_[segment])) continue;
    for (int corner = 0; corner < 8; ++corner) {
      glm::dvec3 at;
      for (int row = 0; row < 3; ++row) {
        const auto& m = now_->matrices[segment].m[static_cast<std::size_t>(row)];
        at[row] = m[3] + (corner & 1 ? m[0] : 0) + (corner & 2 ? m[1] : 0) + (corner & 4 ? m[2] : 0);
      }
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
  }
  if (low.x > high.x) return std::nullopt;
  return preview::Ball{0.5 * (low + high), glm::length(high - low) / 2};
}

bool Moments::is_short() const {
  std::uint64_t matrices = 0;
  const animator::Film& film = project_.film();
  for (const animator::Actor& actor : film.actors)
    matrices += (moves(actor) ? film.frames : 1) * std::uint64_t{film.models[actor.model].joints.size()};
  return std::max<std::uint64_t>(matrices, film.frames) <= kMostMatrices;
}

std::optional<std::span<const std::uint32_t>> Moments::own_moving() {
  if (revision_ != cut_revision_ || !cut_) {
    cut_.reset();
    cut_revision_ = *revision_;
    if (!is_short() || !problem_.empty()) return std::nullopt;
    try {
      cut_ = film::cut_of(project_.film(), shapes_);
    } catch (const Failure&) {
      return std::nullopt;  // another frame shows nothing, which is no matter here
    }
  }
  return cut_->moving_at(frame_);
}

}  // namespace mars::studio
