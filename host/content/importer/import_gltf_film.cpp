#include "host/content/importer/import_gltf_film.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>

#include "host/content/animator/keys/edit.h"
#include "host/content/document/text.h"
#include "host/content/importer/gltf/film_camera.h"
#include "host/content/importer/gltf/film_clock.h"
#include "host/content/importer/gltf/film_lights.h"
#include "host/content/importer/joint_motion.h"
#include "host/content/importer/motions/film_text.h"
#include "host/content/importer/motions/motion_frames.h"
#include "host/content/importer/scene_motion.h"

namespace mars::importer {
namespace {

using document::Json;

constexpr double kKeysShow = 1e-4;   // of the model's size: what is nearer to where it should be, keys show
constexpr double kPlaceTrue = 1e-6;  // of the model's size
constexpr std::size_t kMostNamed = 8;

// "walk, run, ... 3 more".
std::string some_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < kMostNamed; ++i)
    text += (i > 0 ? ", " : "") + document::printable(names[i], 40);
  return names.size() > kMostNamed ? text + " and " + std::to_string(names.size() - kMostNamed) + " more" : text;
}

// A matrix as films have them, rounded as all of their numbers are.
Json rows_of(const glm::dmat4& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) {
    Json numbers = Json::array();
    for (int column = 0; column < 4; ++column)
      numbers.push_back(document::plain_number(animator::rounded(matrix[column][row])));
    rows.push_back(std::move(numbers));
  }
  return rows;
}

// The actor that matrices move: at each frame those that have changed.
ActorText actor_by_matrices(const std::string& name, const JointMotions& joints) {
  ActorText actor{{{"name", name}, {"model", name}}, 0};
  std::map<std::size_t, Json> held;  // of each joint
  Json list = Json::array();
  for (std::size_t frame = 0; frame < joints.frames(); ++frame) {
    const std::vector<glm::dmat4> moves = joints.moves_at(frame);
    Json segments = Json::object();
    for (std::size_t joint = 0; joint < moves.size(); ++joint) {
      if (!joints.needs_matrix(joint)) continue;
      Json rows = rows_of(joints.matrix(joint, moves[joint]));
      if (Json& before = held[joint]; before != rows) segments[joints.joints()[joint].name] = before = std::move(rows);
    }
    if (!segments.empty()) list.push_back({{"frame", frame}, {"segments", std::move(segments)}});
  }
  actor.keys = list.size();
  actor.json["matrices"] = std::move(list);
  return actor;
}

// "5 joints slide, up to 0.3 units, and 2 change their scale".
std::string beyond_keys(const JointMotions::ByKeys& keys) {
  std::string text;
  if (keys.sliding > 0)
    text = document::counted(keys.sliding, "joint slides", "joints slide") + ", up to " +
           document::formatted("%.3g units", keys.farthest);
  if (keys.scaled > 0)
    text +=
        (text.empty() ? "" : ", and ") + document::counted(keys.scaled, "joint changes", "joints change") + " in scale";
  return text.empty() ? "joints do more than turn" : text;
}

class GltfFilm {
 public:
  GltfFilm(const ImportOptions& options, FileKind kind, const Stance& stance)
      : options_(options),
        scene_(is_gltf(kind) ? read_gltf_scene(options.from, options.animation)
                             : read_scene_motion(options.from, options.animation)),
        clock_(film_clock(options.from, scene_, options.rate)),
        rest_(rest_of_nodes(scene_, clock_)),
        model_(read_mesh(options, kind, stance, rest_)),
        nodes_(scene_, clock_, stance.upright, model_.factor),
        joints_(model_, nodes_, rest_),
        report_(report_of(model_, kind, stance)),
        seen_(joints_.box()),
        size_(glm::length(model_.extent)) {}

  ImportedText import() {
    report_.model = "film of " + document::counted(clock_.frames, "frame") + " at " + document::shown(clock_.rate) +
                    " a second, actor '" + options_.joint + "'";
    list_animations();
    Json actor = this->actor().json;  // it may widen limits of the model
    FilmText film{clock_.frames, clock_.rate, options_.joint, model_text_of(model_), {}, std::move(actor)};
    add_camera(film);
    add_lights(film);
    return {std::move(report_), film_text(std::move(film)), std::move(model_.images)};
  }

 private:
  void list_animations() {
    const GltfAnimations& all = scene_.animations;
    if (all.shown) {
      report_.read.push_back("the animation '" + document::printable(all.shown->name, 40) + "' of " +
                             document::formatted("%.4g s", all.shown->end()));
      list_unread(all.shown->weights, "animated weight of morph targets", "animated weights of morph targets");
      list_unread(all.shown->others, "channel of an animation that moves no node",
                  "channels of an animation that move no node");
    }
    if (!all.others.empty())
      report_.not_read.push_back(document::counted(all.others.size(), "further animation") + ": " +
                                 some_of(all.others) + " (--animation chooses one)");
  }

  void list_unread(std::size_t count, const char* one, const char* several) {
    if (count > 0) report_.not_read.push_back(document::counted(count, one, several));
  }

  // By keys where these show all that the file does, unless a person has chosen.
  ActorText actor() {
    JointMotions::ByKeys keys = joints_.by_keys();
    const bool all = keys.error <= kKeysShow * size_;
    if (options_.motion.value_or(all ? ImportMotion::keys : ImportMotion::matrices) == ImportMotion::matrices) {
      ActorText actor = actor_by_matrices(options_.joint, joints_);
      report_.made.push_back("matrices at " + document::counted(actor.keys, "frame") +
                             (all ? "" : ": " + beyond_keys(keys) + ", which keys cannot show"));
      return actor;
    }
    widen_limits(keys.motion);
    ActorText actor = actor_text(options_.joint, joints_.joints(), keys.motion, kPlaceTrue * size_);
    if (actor.keys > 0) report_.made.push_back("keys at " + document::counted(actor.keys, "frame"));
    if (!all)
      report_.not_read.push_back("how " + beyond_keys(keys) + ": the model is up to " +
                                 document::formatted("%.3g", keys.error) +
                                 " units from where the file has it (--motion matrices shows it)");
    return actor;
  }

  // Of limbs, where the motion takes them beyond what people's joints do.
  void widen_limits(ActorMotion& motion) {
    std::vector<modeler::Joint> joints = joints_.joints();
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      if (model_.joints[joint].limits) joints[joint].limits = *model_.joints[joint].limits;
    Motion fitted{clock_.rate, {}, std::move(motion.poses)};
    const std::vector<std::string> widened = fit_limits(joints, fitted);
    motion.poses = std::move(fitted.poses);
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      if (model_.joints[joint].limits) model_.joints[joint].limits = joints[joint].limits;
    if (!widened.empty())
      report_.made.push_back("wider limits for " + document::counted(widened.size(), "joint", "joints") +
                             " that the motion takes beyond them: " + some_of(widened));
  }

  void add_camera(FilmText& film) {
    if (scene_.cameras.empty()) {
      const glm::dvec3 margin((seen_.max - seen_.min) * 0.05);
      film.camera = camera_text(seen_.min - margin, seen_.max + margin);
      return;
    }
    FilmCamera camera = film_camera(scene_.cameras, nodes_, seen_, model_.factor);
    film.camera = std::move(camera.json);
    film.size = camera.size;
    report_.made.push_back("a camera");
    list_unread(scene_.cameras.size() - 1, "further camera", "further cameras");
  }

  void add_lights(FilmText& film) {
    const glm::dvec3 middle = (seen_.min + seen_.max) / 2.0;
    FilmLights lights = film_lights(scene_.lights, nodes_, middle, glm::length(seen_.max - seen_.min), model_.factor);
    film.lights = std::move(lights.json);
    if (lights.lights > 0)
      report_.made.push_back(document::counted(lights.lights, "light") +
                             (lights.dimmed == 1 ? ""
                                                 : ", " + document::formatted("%.3g", lights.dimmed) +
                                                       " times as bright as in the file, so that films can show it"));
    list_unread(scene_.unread_lights, "light of a kind that is not known", "lights of kinds that are not known");
    list_unread(lights.too_many, "light more than a film can have", "lights more than a film can have");
  }

  const ImportOptions& options_;
  GltfScene scene_;
  FilmClock clock_;
  std::vector<glm::dmat4> rest_;
  MeshFile model_;
  NodesInFilm nodes_;
  JointMotions joints_;
  ImportReport report_;
  modeler::Box seen_;
  double size_;
};

}  // namespace

ImportedText import_gltf_film(const ImportOptions& options, FileKind kind, const Stance& stance) {
  return GltfFilm(options, kind, stance).import();
}

}  // namespace mars::importer
