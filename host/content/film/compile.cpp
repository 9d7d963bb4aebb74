#include "host/content/film/compile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "hal/failure/failure.h"
#include "host/content/animator/read_film.h"
#include "host/content/film/film_file.h"
#include "host/content/film/intervals.h"
#include "host/content/film/light_writer.h"
#include "host/content/film/material_writer.h"
#include "host/content/film/motion_writer.h"
#include "host/content/film/shape_writer.h"
#include "host/content/film/track_writer.h"

namespace mars::film {
namespace {

std::array<std::uint32_t, 2> checked_size(const std::array<std::uint32_t, 2>& size, const std::string& source) {
  for (const std::uint32_t side : size)
    if (side < 1 || side > wire::kMaxSide)
      throw Failure("cannot be " + std::to_string(size[0]) + "x" + std::to_string(size[1]) + " pixels", source,
                    "each side must have 1 to 16384 pixels");
  return size;
}

std::uint32_t checked_samples(std::uint32_t samples, const std::string& source) {
  if (!std::has_single_bit(samples) || samples > wire::kMostSamples)
    throw Failure("cannot have " + std::to_string(samples) + " samples a pixel", source, "choose 1, 2, 4, 8 or 16");
  return samples;
}

// Between keys a number may swing beyond what keys may give.
double within(const document::Range& range, double number) { return std::clamp(number, range.lowest, range.highest); }

class Compiler {
 public:
  Compiler(const animator::Film& film, const CompileOptions& options) : film_(film), options_(options) {}

  CompiledFilm compile() {
    add_settings();
    add_camera();
    write_lights(film_, data_);
    for (const animator::Actor& actor : film_.actors) add_segments(actor);
    CompiledFilm compiled;
    const std::size_t matrices = write_motion(film_, data_, compiled.lines);
    cut_intervals(data_, options_.cutting.value_or(film_.cutting), keyframes());
    pack(matrices, compiled);
    return compiled;
  }

  void check_camera() const {
    const animator::CameraMotion& motion = film_.camera;
    const std::uint32_t frames = frames_to_see(film_.frames, motion.eye, motion.at, motion.up);
    for (std::uint32_t frame = 0; frame < frames; ++frame) camera_at(frame);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& element, const std::string& remedy) const {
    throw Failure(what, film_.source.empty() ? element : film_.source + ": " + element, remedy);
  }

  void add_settings() {
    const auto size = checked_size(options_.size.value_or(std::array{film_.width, film_.height}), film_.source);
    data_.settings = {size[0], size[1], film_.frames, film_.dice, {}, float(film_.rate), {}};
    write_light_settings(film_, data_.settings);
    if (options_.samples) data_.settings.samples = checked_samples(*options_.samples, film_.source);
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
    const double half =
        within(animator::kFieldsOfView, animator::value_at(motion.fov, frame)) * (std::numbers::pi / 360);
    camera.focal = std::cos(half) / std::sin(half);
    camera.near = motion.near;
    camera.far = motion.far;
    camera.exposure = std::exp2(within(animator::kExposures, animator::value_at(motion.exposure, frame)));
    return camera;
  }

  void add_camera() {
    const animator::CameraMotion& motion = film_.camera;
    TrackWriter<wire::Camera> track(data_.cameras);
    const std::uint32_t frames =
        frames_to_see(film_.frames, motion.eye, motion.at, motion.up, motion.fov, motion.exposure);
    for (std::uint32_t frame = 0; frame < frames; ++frame) track.add(frame, camera_at(frame));
    data_.settings.camera = track.write(data_.changes);
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
                                materials_.track_of(actor, joint.segment->material)});
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
    add_all(film_.camera.eye, film_.camera.at, film_.camera.up, film_.camera.fov, film_.camera.exposure);
    for (const animator::LightMotion& light : film_.lights)
      add_all(light.vector, light.color, light.intensity, light.reach, light.at, light.cone);
    for (const animator::MaterialMotion& material : film_.materials) {
      if (!materials_.uses(material.name)) continue;
      add(material.color);
      for (const auto& channel : material.numbers) add(channel);
    }
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
  MaterialWriter materials_{film_, data_};
  std::unordered_map<std::size_t, std::vector<std::uint32_t>> model_shapes_;
  std::uint64_t instances_ = 0;  // patches and meshlets of all segments
  std::uint64_t joints_ = 0;     // of all actors
};

// The same block with another size and other samples: what a frame shows does not depend on them.
void change_pixels(CompiledFilm& film, const CompileOptions& options) {
  const wire::FilmView view = film.view();
  wire::FilmSettings settings = view.settings();
  if (options.size) {
    const auto size = checked_size(*options.size, film.source);
    settings.width = size[0];
    settings.height = size[1];
  }
  if (options.samples) settings.samples = checked_samples(*options.samples, film.source);
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
  change_pixels(film, options);
  return film;
}

}  // namespace mars::film
