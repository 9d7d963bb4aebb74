#include "host/content/animator/reading/read_film.h"

#include <algorithm>
#include <limits>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/reading/read_carried.h"
#include "host/content/animator/reading/read_keys.h"
#include "host/content/animator/reading/read_lights.h"
#include "host/content/animator/reading/read_materials.h"
#include "host/content/animator/reading/rig.h"
#include "host/content/document/file.h"
#include "host/content/modeler/read_model.h"
#include "node/wire/film.h"

namespace mars::animator {
namespace {

glm::dvec3 angles_of(const document::Element& element) { return document::read_vector(element, keys::kDegrees); }

void read_size(const document::Element& element, Film& film) {
  document::require_size(element, 2);
  auto side = element.begin();
  film.width = document::read_count(*side, 1, wire::kMaxSide);
  film.height = document::read_count(*++side, 1, wire::kMaxSide);
}

std::uint32_t read_dice(const document::Element& element) {
  constexpr std::string_view adaptive[] = {"adaptive"};
  if (element.kind() == document::Kind::number) return document::read_count(element, 1, 256);
  if (element.kind() == document::Kind::text)
    return static_cast<std::uint32_t>(document::read_choice(element, adaptive));
  element.refuse(std::string("is ") + document::name_of(element.kind()),
                 "write \"adaptive\" or a number of quads a side");
}

glm::dvec2 shift_of(const document::Element& element) {
  document::require_size(element, 2);
  constexpr document::Range kShifts{-wire::kMostShift, wire::kMostShift};
  auto number = element.begin();
  const double x = document::read_number(*number, kShifts);
  return {x, document::read_number(*++number, kShifts)};
}

CameraMotion read_camera(const document::Element& element, wire::ColorSpace color, const Carriers& carriers) {
  const auto point_of = [&](const document::Element& point) { return read_point(point, carriers); };
  const document::Fields fields(element, keys::object("camera"));
  CameraMotion camera;
  if (const auto keys = fields.find("keys"))
    read_keys(*keys, keys::object("camera_key"),
              [&](const document::Fields& key, std::uint32_t frame, const Ease& ease) {
                add_key(camera.eye, key, "eye", frame, ease, point_of);
                add_key(camera.at, key, "at", frame, ease, point_of);
                add_key(camera.up, key, "up", frame, ease, place_of);
                add_key(camera.fov, key, "fov", frame, ease, number_of(key, "fov"));
                add_key(camera.height, key, "height", frame, ease, number_of(key, "height"));
                add_key(camera.shift, key, "shift", frame, ease, shift_of);
                add_key(camera.exposure, key, "exposure", frame, ease, number_of(key, "exposure"));
              });
  if (camera.eye.empty()) fields.required("eye");
  settle(camera.eye, fields, "eye", point_of);
  settle(camera.at, fields, "at", point_of);
  settle(camera.up, fields, "up", place_of);
  camera.projection = static_cast<wire::Projection>(fields.choice("projection"));
  settle(camera.fov, fields, "fov", number_of(fields, "fov"));
  settle(camera.height, fields, "height", number_of(fields, "height"));
  settle(camera.shift, fields, "shift", shift_of);
  if (const bool given = !camera.exposure.empty() || fields.find("exposure"); given && color == wire::ColorSpace::coded)
    element.refuse("has an exposure, but the film's colours are coded, as they are shown",
                   "leave exposure out, or \"color\": \"coded\"");
  settle(camera.exposure, fields, "exposure", number_of(fields, "exposure"));
  camera.near = fields.number("near");
  camera.far = fields.number("far");
  camera.interaxial = fields.number("interaxial");
  camera.convergence = fields.number("convergence");
  if (camera.far <= camera.near)
    element.refuse("has far " + document::shown(camera.far) + ", not beyond near " + document::shown(camera.near),
                   "make far larger");
  return camera;
}

// Reads the actors once the models and materials are known; then, as they may name each other, what carries them.
class ActorReader {
 public:
  ActorReader(const Film& film, const std::vector<modeler::Model>& models, std::vector<std::string> model_names)
      : film_models_(models), model_names_(std::move(model_names)), joints_(models.size()) {
    for (std::size_t i = 0; i < model_names_.size(); ++i) models_.emplace(model_names_[i], i);
    for (const MaterialMotion& material : film.materials) materials_.insert(material.name);
  }

  std::vector<Actor> read_all(const document::Element& list) {
    document::require_kind(list, document::Kind::list);
    std::vector<Actor> actors;
    for (const document::Element actor : list) actors.push_back(read(actor, actors.size()));
    read_attachments(attachments_, film_models_, actors);
    return actors;
  }

  void read_one(const document::Element& element, std::size_t number, std::vector<Actor>& actors) {
    actors[number] = read(element, number);
    read_attachments(attachments_, film_models_, actors);
  }

 private:
  Actor read(const document::Element& element, std::size_t number) {
    const document::Fields fields(element, keys::object("actor"));
    Actor actor;
    actor.name = modeler::read_name(fields.required("name"));
    if (!names_.insert(actor.name).second)
      element.refuse("is a second actor named " + document::in_quotes(actor.name), "give every actor its own name");
    actor.model = find_model(fields.required("model"));
    if (const auto material = fields.find("material")) actor.material = film_material(*material);
    if (const auto materials = fields.find("materials")) read_materials(*materials, actor);
    read_motion(fields, actor, number);
    return actor;
  }

  const modeler::Model& model_of(const Actor& actor) const { return film_models_[actor.model]; }

  std::size_t find_model(const document::Element& element) const {
    const std::string name = document::read_text(element);
    if (const auto found = models_.find(name); found != models_.end()) return found->second;
    const std::vector<std::string_view> names(model_names_.begin(), model_names_.end());
    element.refuse("is " + document::in_quotes(name) + ", which is none of the film's models",
                   document::did_you_mean(name, names, "add it to the film's models"));
  }

  std::string film_material(const document::Element& element) const {
    const std::string name = document::read_text(element);
    if (materials_.contains(name)) return name;
    const std::vector<std::string_view> names(materials_.begin(), materials_.end());
    element.refuse("is " + document::in_quotes(name) + ", which is none of the film's materials",
                   document::did_you_mean(name, names, "add it to the film's materials"));
  }

  void read_materials(const document::Element& element, Actor& actor) const {
    document::require_kind(element, document::Kind::object);
    std::vector<std::string_view> used;
    for (const modeler::Joint& joint : model_of(actor).joints)
      if (joint.segment && !joint.segment->material.empty()) used.push_back(joint.segment->material);
    for (const document::Element item : element) {
      if (std::find(used.begin(), used.end(), item.key()) == used.end())
        item.refuse("is no material that a segment of its model uses",
                    document::did_you_mean(item.key(), used, "name a material of the model's segments"));
      actor.materials.emplace_back(item.key(), film_material(item));
    }
  }

  void read_motion(const document::Fields& fields, Actor& actor, std::size_t number) {
    actor.motion.pose.resize(model_of(actor).joints.size());
    if (const auto matrices = fields.find("matrices")) {
      for (const std::string_view key : {"keys", "place", "turn", "pose", "attach"})
        if (const auto other = fields.find(key))
          other->refuse("stands beside matrices", "move an actor by keys or by matrices, not by both");
      read_matrices(*matrices, actor);
    }
    const std::size_t attached_before = attachments_.size();
    if (const auto keys = fields.find("keys"))
      read_keys(*keys, keys::object("actor_key"),
                [&](const document::Fields& key, std::uint32_t frame, const Ease& ease) {
                  add_key(actor.motion.place, key, "place", frame, ease, place_of);
                  add_key(actor.motion.turn, key, "turn", frame, ease, angles_of);
                  if (const auto pose = key.find("pose")) read_pose(*pose, frame, ease, actor);
                  if (const auto attach = key.find("attach")) add_attachment(*attach, frame, number);
                });
    if (const auto attach = fields.find("attach")) {
      if (attachments_.size() > attached_before) refuse_still(*attach);
      add_attachment(*attach, 0, number);
    }
    settle(actor.motion.place, fields, "place", place_of);
    settle(actor.motion.turn, fields, "turn", angles_of);
    if (const auto pose = fields.find("pose")) read_still_pose(*pose, actor);
  }

  void add_attachment(const document::Element& element, std::uint32_t frame, std::size_t actor) {
    require_version_2(element);
    attachments_.push_back({actor, frame, element});
  }

  [[noreturn]] static void refuse_still(const document::Element& element) {
    element.refuse("is also set by keys", "take it out here, or out of every key");
  }

  void read_still_pose(const document::Element& element, Actor& actor) {
    document::require_kind(element, document::Kind::object);
    for (const document::Element item : element) {
      const std::size_t joint = find_joint(item, actor);
      if (!actor.motion.pose[joint].empty()) refuse_still(item);
      actor.motion.pose[joint].push_back({0, pose_of(item, model_of(actor).joints[joint])});
    }
  }

  void read_pose(const document::Element& element, std::uint32_t frame, const Ease& ease, Actor& actor) {
    document::require_kind(element, document::Kind::object);
    for (const document::Element item : element) {
      const std::size_t number = find_joint(item, actor);
      const modeler::Joint& joint = model_of(actor).joints[number];
      actor.motion.pose[number].push_back(
          read_part(item, frame, ease, [&](const document::Element& value) { return pose_of(value, joint); }));
    }
  }

  static glm::dvec3 pose_of(const document::Element& element, const modeler::Joint& joint) {
    const glm::dvec3 pose = document::read_vector(element, keys::kDegrees);
    if (const auto broken = broken_limit(joint, pose))
      element.refuse("joint '" + joint.name + "' " + *broken, "keep it within the limits, or widen them in its model");
    return pose;
  }

  // `item` is named after a joint of the actor's model.
  std::size_t find_joint(const document::Element& item, const Actor& actor) {
    auto& numbers = joints_[actor.model];
    const auto& joints = model_of(actor).joints;
    if (numbers.empty())
      for (std::size_t i = 0; i < joints.size(); ++i) numbers.emplace(joints[i].name, i);
    if (const auto found = numbers.find(item.key()); found != numbers.end()) return found->second;
    std::vector<std::string_view> names;
    for (const modeler::Joint& joint : joints) names.push_back(joint.name);
    item.refuse("is no joint of the model '" + model_names_[actor.model] + "'",
                document::did_you_mean(item.key(), names, "name a joint of this model"));
  }

  static modeler::Axes read_matrix(const document::Element& element) {
    document::require_size(element, 3);
    modeler::Axes frame;
    int row = 0;
    for (const document::Element numbers : element) {
      document::require_size(numbers, 4);
      int column = 0;
      for (const document::Element number : numbers) {
        (column < 3 ? frame.turn[column][row] : frame.place[row]) = document::read_number(number);
        ++column;
      }
      ++row;
    }
    return frame;
  }

  // Those of segments, and bones of skins.
  static std::vector<bool> joints_with_matrices(std::span<const modeler::Joint> joints) {
    std::vector<bool> with(joints.size());
    for (std::size_t joint = 0; joint < joints.size(); ++joint) {
      if (!joints[joint].segment) continue;
      with[joint] = true;
      for (const modeler::Bone& bone : joints[joint].segment->bones) with[bone.joint] = true;
    }
    return with;
  }

  void read_matrices(const document::Element& list, Actor& actor) {
    const auto& joints = model_of(actor).joints;
    const std::vector<bool> moved = joints_with_matrices(joints);
    actor.matrices.resize(joints.size());
    read_keys(list, keys::object("matrices_key"), [&](const document::Fields& key, std::uint32_t frame, const Ease&) {
      const document::Element segments = key.required("segments");
      document::require_kind(segments, document::Kind::object);
      for (const document::Element item : segments) {
        const std::size_t joint = find_joint(item, actor);
        if (!moved[joint])
          item.refuse("has no segment and is no bone of a skin", "give matrices of joints that have one or are one");
        actor.matrices[joint].push_back({frame, read_matrix(item), kLinear});
      }
    });
    for (std::size_t joint = 0; joint < joints.size(); ++joint)
      if (moved[joint] && (actor.matrices[joint].empty() || actor.matrices[joint][0].frame != 0))
        list.refuse("has no matrix of '" + joints[joint].name + "' at frame 0",
                    "give every segment and every bone its matrix at frame 0, then only what changes");
  }

  const std::vector<modeler::Model>& film_models_;
  std::vector<std::string> model_names_;
  std::unordered_map<std::string, std::size_t> models_;
  std::unordered_set<std::string_view> materials_;
  std::vector<std::unordered_map<std::string_view, std::size_t>> joints_;  // of each model, filled when asked
  std::unordered_set<std::string> names_;
  std::vector<WrittenAttachment> attachments_;
};

modeler::Model read_film_model(const document::Element& element, const Film& film,
                               const std::filesystem::path& folder) {
  std::vector<std::string_view> materials;
  for (const MaterialMotion& material : film.materials) materials.push_back(material.name);
  if (element.kind() == document::Kind::text) {
    const std::filesystem::path path = document::read_file_name(element, folder);
    const document::Document model = document::read_document(element, path);
    return modeler::read_model(model.root(), materials);
  }
  if (element.kind() != document::Kind::object)
    element.refuse(std::string("is ") + document::name_of(element.kind()),
                   "name a model file, or write the model here");
  return modeler::read_model(element, materials);
}

std::uint32_t read_samples(const document::Element& element) {
  const double number = document::read_number(element);
  for (std::uint32_t samples = 1; samples <= wire::kMostSamples; samples *= 2)
    if (number == samples) return samples;
  element.refuse("is " + document::shown(number), "write 1, 2, 4, 8 or 16");
}

// How its numbers become what is shown.
void read_colors(const document::Fields& fields, Film& film) {
  film.color = static_cast<wire::ColorSpace>(fields.choice("color"));
  const bool coded = film.color == wire::ColorSpace::coded;
  if (const auto curve = fields.find("curve"); curve && coded)
    curve->refuse("stands in a film whose colours are coded, as they are shown",
                  "leave curve out, or \"color\": \"coded\"");
  film.curve = coded ? wire::Curve::none : static_cast<wire::Curve>(fields.choice("curve"));
  film.background = fields.color("background");
  if (const auto fog = fields.find("fog")) film.fog = read_fog(*fog, film.background);
}

// But for the lights of a film without any, which stand as its camera does.
void read_lighting(const document::Fields& fields, Film& film) {
  const auto lights = fields.find("lights"), ambient = fields.find("ambient");
  if (lights) film.lights = read_lights(*lights);
  if (ambient)
    film.ambient = read_ambient(*ambient);
  else if (!lights)
    film.ambient = rig_ambient(film.color);
}

// Before anything else is read: a newer film may have keys that are not known here.
void check_version(const document::Element& film) {
  const auto version = film.find("version");
  if (!version) return;
  const std::uint32_t number = document::read_count(*version, 1, std::numeric_limits<std::uint32_t>::max());
  if (number > kFilmVersion)
    version->refuse("is " + std::to_string(number) + ", but this MARS reads films up to version " +
                        std::to_string(kFilmVersion),
                    "use a newer MARS, or make the film without what is new in that version");
}

std::filesystem::path sound_of(const document::Element& audio) {
  return std::filesystem::path(audio.document().name()).parent_path() / document::read_text(audio);
}

void read_settings(const document::Fields& fields, Film& film) {
  film.frames = document::read_count(fields.required("frames"), fields.key("frames"));
  film.rate = fields.number("rate");
  if (const auto audio = fields.find("audio")) film.audio = sound_of(*audio);
  fields.number("audio_delay");
  read_colors(fields, film);
  read_size(fields.value("size"), film);
  film.pixel_aspect = fields.number("pixel_aspect");
  film.samples = read_samples(fields.value("samples"));
  film.dice = read_dice(fields.value("dice"));
  film.cutting = static_cast<Cutting>(fields.choice("intervals"));
}

// `read_models` fills `models`, which become the film's unless it throws.
template <typename ReadModels>
Film read_film_with(const document::Element& element, std::vector<modeler::Model>& models, ReadModels read_models) {
  if (element.find("joints") || element.find("from"))
    element.refuse("is a model, not a film",
                   "look at it with mars preview, or name it in a film: \"models\": {\"dog\": \"dog.json\"}");
  check_version(element);
  const document::Fields fields(element, keys::object("film"));
  Film film;
  film.source = element.document().name();
  read_settings(fields, film);
  const document::Element camera = fields.required("camera");
  read_lighting(fields, film);
  if (const auto materials = fields.find("materials")) film.materials = read_materials(*materials);
  std::vector<std::string> model_names;
  const document::Element named = fields.required("models");
  document::require_kind(named, document::Kind::object);
  for (const document::Element model : named) model_names.push_back(modeler::checked_name(model, model.key()));
  read_models(named, film);
  film.actors = ActorReader(film, models, std::move(model_names)).read_all(fields.required("actors"));
  film.camera = read_camera(camera, film.color, Carriers(film.actors, models));
  film.models = std::move(models);
  if (!fields.find("lights")) film.lights = rig_lights(film);
  return film;
}

void read_actor_again(const document::Element& element, std::size_t number, const document::Json& json, Film& film) {
  std::vector<std::string> names;
  for (const auto& model : json.at("models").items()) names.push_back(model.key());
  Actor before = film.actors[number];
  try {
    ActorReader(film, film.models, std::move(names)).read_one(element, number, film.actors);
  } catch (...) {
    film.actors[number] = std::move(before);
    throw;
  }
}

}  // namespace

Film read_film(const document::Element& element, const std::filesystem::path& folder) {
  std::vector<modeler::Model> models;
  return read_film_with(element, models, [&](const document::Element& named, const Film& film) {
    for (const document::Element model : named) models.push_back(read_film_model(model, film, folder));
  });
}

// Models' segments may name the film's materials.
bool same_models(const document::Json& one, const document::Json& two) {
  const auto names = [](const document::Json& film) {
    std::vector<std::string_view> names;
    if (const auto found = film.find("materials"); found != film.end() && found->is_object())
      for (const auto& item : found->items()) names.push_back(item.key());
    return names;
  };
  const auto models = one.find("models"), others = two.find("models");
  return models != one.end() && others != two.end() && *models == *others && names(one) == names(two);
}

Film read_film(const document::Element& element, std::vector<modeler::Model>& models) {
  return read_film_with(element, models, [&](const document::Element& named, const Film&) {
    check(named.size() == models.size(), "a film is read again with all its models");
  });
}

void require_new_sound(const document::Element& film, const Film& before) {
  const auto audio = film.find("audio");
  if (audio && sound_of(*audio) != before.audio) document::read_file_name(*audio);
}

std::optional<FilmPart> part_of(const Film& film, const std::string& thing) {
  using Kind = FilmPart::Kind;
  const auto actor = std::ranges::find(film.actors, thing, &Actor::name);
  if (actor != film.actors.end()) return FilmPart{Kind::actor, static_cast<std::size_t>(actor - film.actors.begin())};
  if (thing == "camera") return FilmPart{Kind::camera};
  if (thing.starts_with("light/")) return FilmPart{Kind::lights};
  if (thing.starts_with("material/")) return FilmPart{Kind::materials};
  return std::nullopt;
}

document::Json::json_pointer pointer_to(FilmPart part) {
  using Pointer = document::Json::json_pointer;
  switch (part.kind) {
    case FilmPart::Kind::camera: return Pointer("/camera");
    case FilmPart::Kind::lights: return Pointer("/lights");
    case FilmPart::Kind::materials: return Pointer("/materials");
    case FilmPart::Kind::actor: break;
  }
  return Pointer("/actors") / part.actor;
}

void read_again(FilmPart part, const document::Json& json, Film& film) {
  const document::Document document(json.at(pointer_to(part)).dump(), film.source);
  switch (part.kind) {
    case FilmPart::Kind::camera:
      film.camera = read_camera(document.root(), film.color, Carriers(film.actors, film.models));
      break;
    case FilmPart::Kind::lights: film.lights = read_lights(document.root()); break;
    case FilmPart::Kind::materials: film.materials = read_materials(document.root()); break;
    case FilmPart::Kind::actor: read_actor_again(document.root(), part.actor, json, film); break;
  }
  if (!json.contains("lights")) film.lights = rig_lights(film);  // which stand as the camera does
}

Film read_film(const std::filesystem::path& path) {
  const document::Document document = document::read_document(path);
  return read_film(document.root(), path.parent_path());
}

}  // namespace mars::animator
