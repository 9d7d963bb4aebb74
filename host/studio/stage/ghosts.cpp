#include "host/studio/stage/ghosts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "host/content/elementary/elementary.h"
#include "host/content/modeler/bent_skin.h"
#include "host/studio/stage/reach_place.h"

namespace mars::studio {
namespace {

constexpr std::size_t kMostJoints = 400;   // of actors that nobody has selected: more would be no picture
constexpr std::size_t kMostPoints = 64;    // of a shape: of more, those that lie farthest out
constexpr std::uint32_t kMostTicks = 240;  // of a trail
constexpr double kLeastCorner = 0.6;       // pixels from the line between its neighbours

glm::dvec3 placed(const wire::Matrix& matrix, const glm::dvec3& point) {
  glm::dvec3 place;
  for (int row = 0; row < 3; ++row) {
    const auto& m = matrix.m[static_cast<std::size_t>(row)];
    place[row] = m[0] * point.x + m[1] * point.y + m[2] * point.z + m[3];
  }
  return place;
}

// Those that are farthest in directions spread evenly over the sphere, by the golden angle.
std::vector<glm::dvec3> outermost(const std::vector<glm::dvec3>& points) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < kMostPoints; ++i) {
    const double z = 1 - (2.0 * double(i) + 1) / kMostPoints, angle = double(i) * std::numbers::pi * (3 - std::sqrt(5));
    const double across = std::sqrt(1 - z * z);
    const glm::dvec3 way(across * elementary::cos(angle), across * elementary::sin(angle), z);
    const auto nearer = [&](const glm::dvec3& one, const glm::dvec3& two) {
      return glm::dot(one, way) < glm::dot(two, way);
    };
    chosen.push_back(static_cast<std::size_t>(std::max_element(points.begin(), points.end(), nearer) - points.begin()));
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<glm::dvec3> outer;
  for (const std::size_t number : chosen) outer.push_back(points[number]);
  return outer;
}

// Corners that nobody sees as such are left out.
Polyline coarser(const Polyline& polygon) {
  Polyline kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 next = polygon[(i + 1) % polygon.size()];
    if (kept.empty() || distance_to({kept.back(), next}, polygon[i]) >= kLeastCorner) kept.push_back(polygon[i]);
  }
  return kept;
}

std::string distance_of(std::uint32_t frame, std::uint32_t now) {
  return std::to_string(std::int64_t{frame} - std::int64_t{now});
}

bool is_key(const animator::Channel<glm::dvec3>& channel, std::uint32_t frame) {
  return channel.size() > 1 && std::ranges::binary_search(channel, frame, {}, &animator::Key<glm::dvec3>::frame);
}

}  // namespace

const std::vector<Handle>& Ghosts::handles(std::uint32_t view, const GhostFrames& frames, const Selection& selection,
                                           const Screen& screen) {
  static const std::vector<Handle> none;
  if (!frames.any() || !moments_.show_the_film()) return none;
  Seen seen{moments_.number(), frames, selection, screen};
  const auto known = shown_.find(view);
  if (known != shown_.end() && known->second.first == seen) return known->second.second;
  follow_project();
  std::vector<Handle> handles = make_handles(seen);
  return (shown_.insert_or_assign(view, std::pair(std::move(seen), std::move(handles))).first)->second.second;
}

std::vector<Handle> Ghosts::make_handles(const Seen& seen) {
  const auto& [moment, frames, selection, screen] = seen;
  const std::int64_t now = project_.frame(), count = project_.film().frames;
  std::vector<Placed> ghosts;
  for (const std::size_t actor : actors_near(selection))
    for (int number = -frames.before; number <= frames.after; ++number) {
      const std::int64_t frame = now + std::int64_t{number} * frames.step;
      if (number != 0 && frame >= 0 && frame < count)
        add_ghost(actor, static_cast<std::uint32_t>(frame), screen, ghosts);
    }
  std::ranges::stable_sort(ghosts, std::ranges::greater(), &Placed::depth);
  std::vector<Handle> handles;
  for (Placed& ghost : ghosts) handles.push_back(std::move(ghost.handle));
  add_trail(frames, selection, screen, handles);
  return handles;
}

void Ghosts::follow_project() {
  const std::size_t actors = project_.film().actors.size();
  if (revision_ != project_.revision()) {
    revision_ = project_.revision();
    states_.assign(actors, {});
    first_segments_.assign(actors, 0);
    const auto& owners = moments_.owners();
    for (std::size_t segment = owners.size(); segment-- > 0;) first_segments_[owners[segment].actor] = segment;
  }
  if (film_number_ != moments_.film_number()) points_.clear();
  film_number_ = moments_.film_number();
}

const animator::ActorState& Ghosts::state_of(std::size_t actor, std::uint32_t frame) {
  const auto known = states_[actor].find(frame);
  if (known != states_[actor].end()) return known->second;
  return states_[actor].emplace(frame, animator::state_at(project_.film(), actor, frame)).first->second;
}

std::vector<std::size_t> Ghosts::actors_near(const Selection& selection) const {
  if (selection.actor) return {*selection.actor};
  const animator::Film& film = project_.film();
  std::vector<std::size_t> actors;
  std::size_t joints = 0;
  for (std::size_t actor = 0; actor < film.actors.size(); ++actor) {
    if (!moves(film.actors[actor])) continue;
    actors.push_back(actor);
    joints += film.model_of(actor).joints.size();
  }
  return joints > kMostJoints ? std::vector<std::size_t>() : actors;
}

namespace {

// Points of a skin, evenly chosen.
void add_bent(const modeler::Model& model, std::size_t joint, std::span<const wire::Matrix> bones,
              std::vector<glm::dvec3>& places) {
  constexpr std::size_t kMostPoints = 1000;
  const modeler::Segment& segment = *model.joints[joint].segment;
  const modeler::BentSkin skin({bones.begin(), bones.end()}, segment.blend);
  const modeler::Shape& shape = model.shapes[segment.shape];
  const std::size_t vertices = shape.mesh ? shape.mesh->vertices.size() : 0;
  for (std::size_t vertex = 0; vertex < vertices; vertex += 1 + vertices / kMostPoints)
    places.push_back(skin.place_of(shape.mesh->vertices[vertex], shape.mesh->bones[vertex]));
  if (!shape.net) return;
  const std::vector<glm::dvec3> means = skin.means_of(*shape.net);
  for (std::size_t mean = 0; mean < means.size(); mean += 1 + means.size() / kMostPoints) places.push_back(means[mean]);
}

}  // namespace

void Ghosts::add_ghost(std::size_t actor, std::uint32_t frame, const Screen& screen, std::vector<Placed>& ghosts) {
  const animator::ActorState& state = state_of(actor, frame);
  const auto& there = state.segments;
  const auto& here = state_of(actor, project_.frame());
  std::size_t segment = first_segments_[actor];
  std::vector<glm::dvec3> places;
  for (std::size_t joint = 0; joint < there.size(); ++joint) {
    if (!there[joint]) continue;
    const std::size_t number = segment++;
    const std::vector<wire::Matrix>& bones = state.bones[joint];
    if (bones.empty() ? there[joint]->m == here.segments[joint]->m : bones == here.bones[joint]) continue;
    places.clear();
    if (bones.empty())
      for (const glm::dvec3& point : points_of(number)) places.push_back(placed(*there[joint], point));
    else
      add_bent(project_.film().model_of(actor), joint, bones, places);
    Handle ghost{"", "ghost", coarser(screen.outline(places))};
    if (ghost.points.size() < 3) continue;
    ghost.text = distance_of(frame, project_.frame());
    ghost.id = "ghost:" + ghost.text;
    ghost.fine = false;
    ghosts.push_back({screen.depth_of(placed(*there[joint], glm::dvec3(0.5))), std::move(ghost)});
  }
}

void Ghosts::add_trail(const GhostFrames& frames, const Selection& selection, const Screen& screen,
                       std::vector<Handle>& handles) {
  const animator::Film& film = project_.film();
  if (!selection.actor || !film.actors[*selection.actor].matrices.empty()) return;
  const animator::Actor& actor = film.actors[*selection.actor];
  const std::int64_t now = project_.frame();
  const auto first = std::uint32_t(std::max<std::int64_t>(now - std::int64_t{frames.before} * frames.step, 0));
  const auto last =
      std::uint32_t(std::min<std::int64_t>(now + std::int64_t{frames.after} * frames.step, film.frames - 1));
  const auto& channel = selection.joint ? actor.motion.pose[*selection.joint] : actor.motion.place;
  const std::uint32_t by = 1 + (last - first) / kMostTicks;
  std::vector<glm::dvec3> way;
  std::vector<Handle> ticks;
  for (std::uint32_t frame = first; frame <= last; frame += by) {
    const animator::ActorState& state = state_of(*selection.actor, frame);
    way.push_back(state.place);
    if (selection.joint) {
      const modeler::Axes& joint = state.joints[*selection.joint];
      way.back() = joint.turn * end_of(film.models[actor.model], *selection.joint) + joint.place;
    }
    const auto pixel = screen.pixel_of(way.back());
    if (!pixel) continue;
    Handle tick{"trail", "trail", {*pixel}, "", distance_of(frame, project_.frame())};
    tick.fine = false;
    tick.selected = is_key(channel, frame);
    ticks.push_back(std::move(tick));
  }
  if (std::ranges::all_of(way, [&](const glm::dvec3& place) { return place == way.front(); })) return;
  for (Polyline& line : screen.polylines(way)) handles.push_back({"trail", "trail", std::move(line)});
  std::ranges::move(ticks, std::back_inserter(handles));
}

// Of the segment's shape, in the unit cube.
const std::vector<glm::dvec3>& Ghosts::points_of(std::size_t segment) {
  const std::uint32_t number = moments_.now().segments[segment].shape;
  const auto [place, made] = points_.try_emplace(number);
  std::vector<glm::dvec3>& points = place->second;
  if (!made) return points;
  const auto add = [&](const std::array<float, 3>& point) { points.emplace_back(point[0], point[1], point[2]); };
  for (const wire::Patch& patch : moments_.patches_of(segment))
    for (const auto& point : patch.points) add(point);
  const wire::FilmData& shapes = moments_.shapes();
  const wire::Shape& shape = shapes.shapes[number];
  for (std::uint32_t i = 0; i < shape.meshlet_count; ++i) {
    const wire::Meshlet& meshlet = shapes.meshlets[shape.first_meshlet + i];
    for (std::uint32_t v = 0; v < meshlet.vertex_count; ++v) add(shapes.mesh_places[meshlet.first_vertex + v]);
  }
  const auto before = [](const glm::dvec3& one, const glm::dvec3& two) {
    return std::tie(one.x, one.y, one.z) < std::tie(two.x, two.y, two.z);
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() > kMostPoints) points = outermost(points);
  return points;
}

}  // namespace mars::studio
