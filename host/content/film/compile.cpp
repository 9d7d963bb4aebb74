#include "host/content/film/compile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "hal/failure/failure.h"
#include "host/content/animator/direction.h"
#include "host/content/animator/read_film.h"
#include "host/content/film/film_file.h"
#include "host/content/film/intervals.h"
#include "host/content/film/motion_writer.h"
#include "host/content/film/shape_writer.h"

namespace mars::film {
namespace {

// Appends to a film's values and to one track of changes those that differ from the one before.
template <typename Value>
class TrackWriter {
 public:
  explicit TrackWriter(std::vector<Value>& values) : values_(values) {}

  void add(std::uint32_t frame, const Value& value) {
    if (!changes_.empty() && value == values_.back()) return;
    changes_.push_back({frame, static_cast<std::uint32_t>(values_.size())});
    values_.push_back(value);
  }

  wire::Track write(std::vector<wire::Change>& changes) const { return append_changes(changes, changes_); }

  static wire::Track append_changes(std::vector<wire::Change>& changes, const std::vector<wire::Change>& more) {
    if (changes.size() + more.size() > std::numeric_limits<std::uint32_t>::max())
      throw Failure("changes too often", "", "make the film shorter, or move fewer segments");
    const wire::Track track{static_cast<std::uint32_t>(changes.size()), static_cast<std::uint32_t>(more.size())};
    changes.insert(changes.end(), more.begin(), more.end());
    return track;
  }

 private:
  std::vector<Value>& values_;
  std::vector<wire::Change> changes_;
};

std::array<float, 3> floats(const glm::dvec3& v) { return {float(v.x), float(v.y), float(v.z)}; }

std::array<std::uint32_t, 2> checked_size(const std::array<std::uint32_t, 2>& size, const std::string& source) {
  for (const std::uint32_t side : size)
    if (side < 1 || side > wire::kMaxSide)
      throw Failure("cannot be " + std::to_string(size[0]) + "x" + std::to_string(size[1]) + " pixels", source,
                    "each side must have 1 to 16384 pixels");
  return size;
}

class Compiler {
 public:
  Compiler(const animator::Film& film, const CompileOptions& options) : film_(film), options_(options) {
    for (const animator::MaterialMotion& motion : film.materials) film_materials_.emplace(motion.name, &motion);
  }

  CompiledFilm compile() {
    add_settings();
    add_camera();
    for (const animator::LightMotion& light : film_.lights) add_light(light);
    for (const animator::Actor& actor : film_.actors) add_segments(actor);
    CompiledFilm compiled;
    const std::size_t matrices = write_motion(film_, data_, compiled.lines);
    cut_intervals(data_, options_.cutting.value_or(film_.cutting), keyframes());
    pack(matrices, compiled);
    return compiled;
  }

  void check_camera() const {
    const animator::CameraMotion& motion = film_.camera;
    const std::uint32_t frames = frames_to_see(motion.eye, motion.at, motion.up);
    for (std::uint32_t frame = 0; frame < frames; ++frame) camera_at(frame);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& element, const std::string& remedy) const {
    throw Failure(what, film_.source.empty() ? element : film_.source + ": " + element, remedy);
  }

  void add_settings() {
    const auto size = checked_size(options_.size.value_or(std::array{film_.width, film_.height}), film_.source);
    data_.settings = {size[0], size[1], film_.frames, film_.dice, floats(film_.background), float(film_.rate), {}};
  }

  wire::Camera camera_at(std::uint32_t frame) const {
    const animator::CameraMotion& motion = film_.camera;
    const glm::dvec3 eye = animator::value_at(motion.eye, frame), ahead = animator::value_at(motion.at, frame) - eye;
    const double distance = glm::length(ahead);
    const glm::dvec3 up = animator::value_at(motion.up, frame);
    const double length = glm::length(up);
    const auto refuse = [&](const char* what, const char* remedy) {
      fail(what, "camera, frame " + std::to_string(frame), remedy);
    };
    if (distance < 1e-9) refuse("has its eye where it looks at", "move eye or at");
    const glm::dvec3 forward = ahead / distance;
    const glm::dvec3 right = glm::cross(forward, up) / length;
    if (length < 1e-9 || glm::length(right) < 1e-6) refuse("looks along its up vector", "choose another up");
    const glm::dvec3 x = glm::normalize(right), axes[3] = {x, glm::cross(x, forward), -forward};
    wire::Camera camera;
    for (int row = 0; row < 3; ++row)
      camera.world_to_eye.m[row] = {axes[row].x, axes[row].y, axes[row].z, -glm::dot(axes[row], eye)};
    const double half = animator::value_at(motion.fov, frame) * (std::numbers::pi / 360);
    camera.focal = std::cos(half) / std::sin(half);
    camera.near = motion.near;
    camera.far = motion.far;
    return camera;
  }

  // Frames at which a value may differ from the frame before: 0, then up to the last key.
  template <typename... Channels>
  std::uint32_t frames_to_see(const Channels&... channels) const {
    const auto last = [](const auto& channel) { return channel.size() < 2 ? 0 : channel.back().frame; };
    return std::min(film_.frames, std::max({std::uint32_t(last(channels))...}) + 1);
  }

  void add_camera() {
    const animator::CameraMotion& motion = film_.camera;
    TrackWriter<wire::Camera> track(data_.cameras);
    const std::uint32_t frames = frames_to_see(motion.eye, motion.at, motion.up, motion.fov);
    for (std::uint32_t frame = 0; frame < frames; ++frame) track.add(frame, camera_at(frame));
    data_.settings.camera = track.write(data_.changes);
  }

  void add_light(const animator::LightMotion& light) {
    TrackWriter<wire::Light> track(data_.lights);
    const std::uint32_t frames = frames_to_see(light.vector, light.color, light.intensity);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      const glm::dvec3 vector =
          light.directional ? animator::direction_at(light.vector, frame) : animator::value_at(light.vector, frame);
      const glm::dvec3 color = animator::value_at(light.intensity, frame) * animator::value_at(light.color, frame);
      track.add(frame, {light.directional ? wire::LightKind::directional : wire::LightKind::point, floats(vector), floats(glm::max(color, 0.0))});
    }
    data_.light_tracks.push_back(track.write(data_.changes));
  }

  static wire::Material material_at(const animator::MaterialMotion& motion, std::uint32_t frame) {
    // An ease that overshoots must not leave what a material can be.
    const auto within = [&](const animator::Channel<double>& channel, double highest) {
      return float(std::clamp(animator::value_at(channel, frame), 0.0, highest));
    };
    return {floats(glm::clamp(animator::value_at(motion.color, frame), 0.0, 1.0)),
            within(motion.ambient, 10),
            within(motion.diffuse, 10),
            within(motion.specular, 10),
            within(motion.exponent, 10000),
            motion.sides};
  }

  wire::Track material_track(const animator::MaterialMotion& motion) {
    TrackWriter<wire::Material> track(data_.materials);
    const std::uint32_t frames =
        frames_to_see(motion.color, motion.ambient, motion.diffuse, motion.specular, motion.exponent);
    for (std::uint32_t frame = 0; frame < frames; ++frame) track.add(frame, material_at(motion, frame));
    return track.write(data_.changes);
  }

  wire::Track material_track(const wire::Material& material) {
    TrackWriter<wire::Material> track(data_.materials);
    track.add(0, material);
    return track.write(data_.changes);
  }

  // Segments of one material share a track. `key` names the material among all of the film's and its models'.
  template <typename Material>
  wire::Track shared_material(const std::string& key, const Material& material) {
    const auto known = material_tracks_.find(key);
    return known != material_tracks_.end() ? known->second
                                           : material_tracks_.emplace(key, material_track(material)).first->second;
  }

  wire::Track find_material(const animator::Actor& actor, std::string name) {
    bool of_film = !actor.material.empty();
    if (of_film) name = actor.material;
    const auto instead = std::find_if(actor.materials.begin(), actor.materials.end(),
                                      [&](const auto& change) { return change.first == name; });
    if (!of_film && instead != actor.materials.end()) {
      name = instead->second;
      of_film = true;
    }
    if (name.empty()) return shared_material("", modeler::kDefaultMaterial);
    if (!of_film)
      for (const modeler::NamedMaterial& own : film_.models[actor.model].materials)
        if (own.name == name) return shared_material(std::to_string(actor.model) + "/" + name, own.material);
    if (const auto found = film_materials_.find(name); found != film_materials_.end())
      return shared_material("/" + name, *found->second);
    fail("uses the material '" + name + "', which there is not", "actor '" + actor.name + "'",
         "add it to the film's materials");
  }

  const std::vector<std::uint32_t>& shapes_of(std::size_t model) {
    auto& numbers = model_shapes_.try_emplace(model).first->second;
    if (numbers.empty())
      for (const modeler::Shape& shape : film_.models[model].shapes) numbers.push_back(shapes_.add(shape));
    return numbers;
  }

  void add_segments(const animator::Actor& actor) {
    const modeler::Model& model = film_.models[actor.model];
    const auto& shapes = shapes_of(actor.model);
    for (const modeler::Joint& joint : model.joints) {
      if (!joint.segment) continue;
      data_.segments.push_back({shapes[joint.segment->shape],
                                add_name(actor.name + "/" + joint.name),
                                {},
                                find_material(actor, joint.segment->material)});
      instances_ += data_.shapes[data_.segments.back().shape].size();
    }
    joints_ += model.joints.size();
    if (instances_ > std::numeric_limits<std::uint32_t>::max() || joints_ > std::numeric_limits<std::uint32_t>::max())
      fail("have more than 4294967295 patches and pieces of meshes", "actors", "use fewer actors");
  }

  std::uint32_t add_name(const std::string& name) {
    if (data_.names.size() + name.size() + 1 > std::numeric_limits<std::uint32_t>::max())
      fail("have names of more than 4 GB", "actors", "shorten them");
    const auto offset = static_cast<std::uint32_t>(data_.names.size());
    data_.names.insert(data_.names.end(), name.c_str(), name.c_str() + name.size() + 1);
    return offset;
  }

  std::vector<std::uint32_t> keyframes() const {
    std::vector<std::uint32_t> frames;
    const auto add = [&](const auto& channel) {
      for (const auto& key : channel) frames.push_back(key.frame);
    };
    const auto add_all = [&](const auto&... channels) { (add(channels), ...); };
    add_all(film_.camera.eye, film_.camera.at, film_.camera.up, film_.camera.fov);
    for (const animator::LightMotion& light : film_.lights) add_all(light.vector, light.color, light.intensity);
    for (const animator::MaterialMotion& m : film_.materials)
      if (material_tracks_.contains("/" + m.name)) add_all(m.color, m.ambient, m.diffuse, m.specular, m.exponent);
    for (const animator::Actor& actor : film_.actors) {
      add_all(actor.motion.place, actor.motion.turn);
      for (const auto& poses : actor.motion.pose) add(poses);
    }
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    return frames;
  }

  void pack(std::size_t matrices, CompiledFilm& film) const {
    wire::pack_around(data_, matrices, [&](std::size_t bytes) {
      check(bytes % sizeof(CompiledFilm::Line) == 0, "a packed film is whole lines of 64 bytes");
      film.lines.resize(bytes / sizeof(CompiledFilm::Line));
      return reinterpret_cast<std::byte*>(film.lines.data());
    });
    film.source = film_.source;
    film.actors = static_cast<std::uint32_t>(film_.actors.size());
    film.joints = static_cast<std::uint32_t>(joints_);
  }

  const animator::Film& film_;
  const CompileOptions& options_;
  wire::FilmData data_;
  ShapeWriter shapes_{data_};
  std::unordered_map<std::string_view, const animator::MaterialMotion*> film_materials_;
  std::unordered_map<std::string, wire::Track> material_tracks_;
  std::unordered_map<std::size_t, std::vector<std::uint32_t>> model_shapes_;
  std::uint64_t instances_ = 0;  // patches and meshlets of all segments
  std::uint64_t joints_ = 0;     // of all actors
};

// The same block with another size: what a frame shows does not depend on it.
void resize(CompiledFilm& film, const std::array<std::uint32_t, 2>& wanted) {
  const auto size = checked_size(wanted, film.source);
  const wire::FilmView view = film.view();
  wire::FilmSettings settings = view.settings();
  settings.width = size[0];
  settings.height = size[1];
  const auto offset = reinterpret_cast<const std::byte*>(&view.settings()) - film.block().data();
  std::memcpy(reinterpret_cast<std::byte*>(film.lines.data()) + offset, &settings, sizeof settings);
}

}  // namespace

CompiledFilm compile(const animator::Film& film, const CompileOptions& options) {
  return Compiler(film, options).compile();
}

void check_camera(const animator::Film& film) { Compiler(film, {}).check_camera(); }

CompiledFilm load_film(const std::filesystem::path& path, const CompileOptions& options) {
  if (!is_compiled_film(path)) return compile(animator::read_film(path), options);
  if (options.cutting)
    throw Failure("is compiled, its intervals are cut", path.string(), "choose --intervals with the film file itself");
  CompiledFilm film = load_compiled_film(path);
  if (options.size) resize(film, *options.size);
  return film;
}

}  // namespace mars::film
