#include "host/content/film/compile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/film/film_file.h"
#include "host/content/film/film_writer.h"
#include "host/content/film/intervals.h"
#include "host/content/film/light_writer.h"
#include "host/content/film/moment.h"
#include "host/content/film/motion_writer.h"

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

// Each eye looks the same way as the camera, from its own side; its picture is shifted so that both show what is at the
// convergence's distance in the same place. So verticals stay vertical, as eyes that turn inwards would not keep them.
void see_by(Eye eye, const animator::Film& film, wire::FilmData& data) {
  const animator::CameraMotion& motion = film.camera;
  if (motion.projection == wire::Projection::orthographic)
    throw Failure("has no stereo pair: parallel rays show the same from both sides", film.source + ": camera",
                  "make the projection perspective, or leave --eye out");
  if (motion.projection == wire::Projection::panorama)
    throw Failure("has no stereo pair: two eyes side by side see no depth to their sides", film.source + ": camera",
                  "make the projection perspective, or leave --eye out");
  const double aside = (eye == Eye::left ? -0.5 : 0.5) * motion.interaxial;
  const double aspect = double(data.settings.width) * data.settings.pixel_aspect / data.settings.height;
  for (wire::Camera& camera : data.cameras) {
    camera.world_to_eye.m[0][3] -= aside;
    camera.shift_x -= aside * camera.focal / (2 * motion.convergence * aspect);
    if (std::abs(camera.shift_x) > wire::kMostShift)
      throw Failure("has eyes that are farther apart than their convergence allows", film.source + ": camera",
                    "make interaxial smaller or convergence larger");
  }
}

class Compiler {
 public:
  Compiler(const animator::Film& film, const CompileOptions& options) : film_(film), options_(options) {}

  CompiledFilm compile() {
    writer_.write_settings();
    change_settings();
    if (options_.eye != Eye::middle) see_by(options_.eye, film_, data_);
    set_window(options_.crop, options_.margin, film_.source, data_.settings);
    writer_.write_segments(write_shapes(film_, data_));
    CompiledFilm compiled = empty_film(options_.in_file);
    const std::size_t matrices = write_motion(film_, data_, compiled.lines);
    cut_intervals(data_, options_.cutting.value_or(film_.cutting), keyframes());
    pack(matrices, compiled);
    return compiled;
  }

  Cut cut(const FilmShapes& shapes) {
    data_.shapes = shapes.parts.shapes;
    data_.meshlets = shapes.parts.meshlets;
    data_.net_patches = shapes.parts.net_patches;
    data_.skin_bones = shapes.parts.skin_bones;
    writer_.write_settings();
    writer_.write_segments(shapes.numbers);
    CompiledFilm::Lines matrices;
    write_motion(film_, data_, matrices);
    cut_intervals(data_, film_.cutting, keyframes());
    return {std::move(data_.intervals), std::move(data_.moving)};
  }

 private:
  void change_settings() {
    const auto size = checked_size(options_.size.value_or(std::array{film_.width, film_.height}), film_.source);
    data_.settings.width = size[0];
    data_.settings.height = size[1];
    if (options_.samples) data_.settings.samples = checked_samples(*options_.samples, film_.source);
  }

  std::vector<std::uint32_t> keyframes() const {
    std::vector<std::uint32_t> frames;
    const auto add = [&](const auto& channel) {
      for (const auto& key : channel) frames.push_back(key.frame);
    };
    const auto add_all = [&](const auto&... channels) { (add(channels), ...); };
    const animator::CameraMotion& camera = film_.camera;
    add_all(camera.eye, camera.at, camera.up, camera.fov, camera.height, camera.shift, camera.exposure);
    for (const animator::LightMotion& light : film_.lights)
      add_all(light.vector, light.color, light.intensity, light.reach, light.at, light.cone, light.size);
    for (const animator::MaterialMotion& material : film_.materials) {
      if (!writer_.uses(material)) continue;
      add(material.color);
      for (const auto& channel : material.numbers) add(channel);
    }
    for (const animator::Actor& actor : film_.actors) {
      add_all(actor.motion.place, actor.motion.turn, actor.attach);
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
    let_pages_go(film.lines);
    film.source = film_.source;
    film.actors = static_cast<std::uint32_t>(film_.actors.size());
    for (const animator::Actor& actor : film_.actors)
      film.joints += static_cast<std::uint32_t>(film_.models[actor.model].joints.size());
  }

  const animator::Film& film_;
  const CompileOptions& options_;
  wire::FilmData data_;
  FilmWriter writer_{film_, {0, film_.frames}, data_};
};

void make_whole(wire::FilmSettings& settings) {
  settings.width = settings.whole_width();
  settings.height = settings.whole_height();
  settings.window = {};
}

// The same block with another size, another part of the picture and other samples: what a frame shows does not depend
// on them.
void change_pixels(CompiledFilm& film, const CompileOptions& options) {
  const wire::PackedFilm view = film.view();
  wire::FilmSettings settings = view.settings();
  if (!settings.window.is_whole()) {
    if (options.size)
      throw Failure("is a part of a picture, compiled as " + size_text(settings), film.source,
                    "choose --size with the film file itself");
    if (options.crop || options.margin > 0) make_whole(settings);
  }
  if (options.size) {
    const auto size = checked_size(*options.size, film.source);
    settings.width = size[0];
    settings.height = size[1];
  }
  if (options.crop || options.margin > 0) set_window(options.crop, options.margin, film.source, settings);
  if (options.samples) settings.samples = checked_samples(*options.samples, film.source);
  const auto offset = reinterpret_cast<const std::byte*>(&view.settings()) - film.block().data();
  std::memcpy(reinterpret_cast<std::byte*>(film.lines.data()) + offset, &settings, sizeof settings);
}

}  // namespace

CompiledFilm compile(const animator::Film& film, const CompileOptions& options) {
  return Compiler(film, options).compile();
}

Cut cut_of(const animator::Film& film, const FilmShapes& shapes) { return Compiler(film, {}).cut(shapes); }

void check_camera_and_lights(const animator::Film& film) {
  animator::JointFrames joints(film);
  const std::uint32_t frames = camera_frames(film.camera, film.frames);
  for (std::uint32_t frame = 0; frame < frames; ++frame) camera_at(film, frame, joints);
  wire::FilmData written;
  write_lights(film, {0, film.frames}, written);
}

CompiledFilm load_film(const std::filesystem::path& path, const CompileOptions& options) {
  if (!is_compiled_film(path)) return compile(animator::read_film(path), options);
  if (options.cutting)
    throw Failure("is compiled, its intervals are cut", path.string(), "choose --intervals with the film file itself");
  if (options.eye != Eye::middle)
    throw Failure("is compiled, as its camera sees it", path.string(), "choose --eye with the film file itself");
  CompiledFilm film = load_compiled_film(path, options.in_file);
  change_pixels(film, options);
  return film;
}

}  // namespace mars::film
