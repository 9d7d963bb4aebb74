#include "host/content/animator/keys/carry.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/pose/camera_points.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/fields.h"
#include "host/content/modeler/frames.h"

namespace mars::animator {
namespace {

struct Target {
  std::size_t actor, joint;
};

std::size_t actor_named(const Film& film, const std::string& name) {
  const auto found = std::ranges::find(film.actors, name, &Actor::name);
  if (found == film.actors.end()) {
    std::vector<std::string_view> names;
    for (const Actor& actor : film.actors) names.push_back(actor.name);
    throw Failure("is no actor of the film", "'" + name + "'",
                  document::did_you_mean(name, names, "name one of its actors"));
  }
  if (!found->matrices.empty())
    throw Failure("is moved by matrices", "actor '" + name + "'", "name an actor that is moved by keys");
  return static_cast<std::size_t>(found - film.actors.begin());
}

// "tom" or "tom/head": names have no slash.
Target target_named(const Film& film, const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::size_t actor = actor_named(film, text.substr(0, slash));
  if (slash == std::string::npos) return {actor, modeler::kNone};
  const auto& joints = film.model_of(actor).joints;
  const std::string name = text.substr(slash + 1);
  const auto found = std::ranges::find(joints, name, &modeler::Joint::name);
  if (found != joints.end()) return {actor, static_cast<std::size_t>(found - joints.begin())};
  std::vector<std::string_view> names;
  for (const modeler::Joint& joint : joints) names.push_back(joint.name);
  throw Failure("is no joint of '" + film.actors[actor].name + "'", "'" + name + "'",
                document::did_you_mean(name, names, "name one of its joints"));
}

std::string joint_name(const Film& film, const Target& target) {
  return target.joint == modeler::kNone ? "" : film.model_of(target.actor).joints[target.joint].name;
}

glm::dvec3 turn_of(const glm::dmat3& turn) { return rounded(pose_of(free_joint(), turn, glm::dvec3(0))); }

// The frame at which it began to be carried as it is without a break, by whatever.
std::uint32_t carried_since(const Actor& actor, std::uint32_t frame) {
  std::size_t key = stretch_at(actor.attach, frame).from;
  while (key > 0 && actor.attach[key - 1].value) --key;
  return actor.attach[key].frame;
}

// A change at the frame leaves what is before as it is, where nothing is on the way to another key with an actor.
void hold_before(const Channel<Point>& points, const KeyedPart& part, std::uint32_t frame, Track& track) {
  if (frame == 0 || key_at(track, frame - 1)) return;
  const Stretch stretch = stretch_at(points, frame - 1);
  if (stretch.from == stretch.to) put_key(track, {frame - 1, part.key_at(frame - 1), kLinear});
}

Remarks put_point(document::Json& film, const Film& meaning, const std::string& part, const Point& point,
                  std::uint32_t frame) {
  const Chosen camera = std::move(choose(film, meaning, {false, "camera", {part}}).front());
  Tracks tracks = tracks_of(*camera.thing.json);
  Track& track = tracks[part];
  hold_before(part == "eye" ? meaning.camera.eye : meaning.camera.at, camera.thing.part(part), frame, track);
  put_key(track, {frame, written(point, meaning), kLinear});
  return put(camera, tracks);
}

const Channel<Point>& points_of(const Film& film, const std::string& part) {
  return part == "eye" ? film.camera.eye : film.camera.at;
}

}  // namespace

void attach(document::Json& film, const Film& meaning, const std::string& name, const std::string& to,
            std::uint32_t frame, const Hold& hold) {
  const std::size_t actor = actor_named(meaning, name);
  const Target target = target_named(meaning, to);
  const std::vector<std::size_t> chain = chain_at(meaning.actors, target.actor, frame);
  if (std::ranges::count(chain, actor))
    throw Failure("would be carried by itself", "actor '" + name + "'",
                  "detach '" + meaning.actors[target.actor].name + "' first, or attach it to another actor");
  JointFrames frames(meaning);
  const modeler::Axes now = seen_from(frames.frame_of(target.actor, target.joint, frame), frames.root_of(actor, frame));
  ActorKey key;
  key.frame = frame;
  key.attach = AttachKey{meaning.actors[target.actor].name, joint_name(meaning, target),
                         hold.place.value_or(rounded(now.place)), hold.turn ? *hold.turn : turn_of(now.turn)};
  put_keys(film, name, {&key, 1});
}

void detach(document::Json& film, const Film& meaning, const std::string& name, std::uint32_t frame) {
  const std::size_t number = actor_named(meaning, name);
  const Actor& actor = meaning.actors[number];
  if (!attachment_at(actor, frame))
    throw Failure("is not attached at frame " + std::to_string(frame), "actor '" + name + "'",
                  "`mars animate FILM list` shows where it is");
  // Its own keys held until it was carried: they shall not lead on to where it is let go.
  make_keys(film, meaning, {false, name, {"place", "turn"}}, carried_since(actor, frame), std::nullopt,
            Beyond::refused);
  const modeler::Axes now = JointFrames(meaning).root_of(number, frame);
  ActorKey key;
  key.frame = frame;
  key.place = rounded(now.place);
  key.turn = turn_of(now.turn);
  key.attach = AttachKey{};
  put_keys(film, name, {&key, 1});
}

namespace {

// What to look at: the joint itself, or of a whole figure the middle of its height, not the feet.
glm::dvec3 middle_of(const Film& meaning, const Target& target) {
  if (target.joint != modeler::kNone) return glm::dvec3(0);
  const auto bounds = modeler::rest_bounds(meaning.model_of(target.actor));
  return bounds ? glm::dvec3(0, 0, document::rounded_to((bounds->min.z + bounds->max.z) / 2, 3)) : glm::dvec3(0);
}

}  // namespace

Remarks follow(document::Json& film, const Film& meaning, const std::string& to, std::uint32_t frame,
               const Following& following) {
  const Target target = target_named(meaning, to);
  Point point{{0, 0, 0}, target.actor, target.joint, following.joint_axes, following.level};
  JointFrames frames(meaning);
  const glm::dvec3 now = place_at(points_of(meaning, following.part), frame, frames);
  const modeler::Axes axes = frames.frame_of(target.actor, target.joint, frame);
  const glm::dvec3 away = now - axes.place;
  point.offset = rounded(point.joint_axes ? glm::transpose(axes.turn) * away : away);
  if (point.level) point.offset.z = rounded(now.z);
  if (following.part == "at") point.offset = middle_of(meaning, target);
  if (following.offset) point.offset = *following.offset;
  return put_point(film, meaning, following.part, point, frame);
}

Remarks unfollow(document::Json& film, const Film& meaning, const std::string& part, std::uint32_t frame) {
  const Channel<Point>& points = points_of(meaning, part);
  if (!follows(points))
    throw Failure("goes along with no actor", "camera, " + part, "`mars animate FILM list camera` shows its keys");
  JointFrames frames(meaning);
  return put_point(film, meaning, part, Point{rounded(place_at(points, frame, frames))}, frame);
}

}  // namespace mars::animator
