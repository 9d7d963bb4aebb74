#include "host/videos/folder_source.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/shell_word.h"
#include "host/content/elementary/elementary.h"
#include "host/content/film/film_file.h"
#include "host/images/half_light.h"
#include "host/images/picture_file.h"
#include "host/render/sinks/frame_folder.h"
#include "host/render/sinks/frame_mark.h"
#include "host/videos/video_form.h"
#include "node/color/encoding.h"

namespace mars::videos {
namespace {

namespace fs = std::filesystem;

std::optional<film::CompiledFilm> film_in(const fs::path& folder, const sinks::Manifest& manifest) try {
  film::CompiledFilm film = film::load_compiled_film(folder / sinks::kFilmName);
  if (film.checksum() != manifest.checksum) return std::nullopt;
  return film;
} catch (const Failure&) {
  return std::nullopt;
}

std::string remedy_in(const fs::path& folder) {
  return "mars verify --repair " + document::shell_word(folder.string()) + " renders it again";
}

}  // namespace

FolderReader::FolderReader(fs::path folder, const Exposing& exposing)
    : folder_(std::move(folder)), manifest_(sinks::read_manifest(folder_)), exposing_(exposing) {
  if (!images::is_exr(manifest_.format)) {
    if (exposing_ == Exposing()) return;
    throw Failure("its frames are pictures that are exposed already, not light", folder_.string(),
                  "leave out --exposure, --curve and --ocio, or render with --format exr");
  }
  film_ = film_in(folder_, manifest_);
  if (!film_ && !(exposing_.stops && (exposing_.curve || exposing_.view)))
    throw Failure("its frames are light, and film.mars, which says how to expose it, is not there or not theirs",
                  folder_.string(), "say it: --exposure 0 --curve filmic");
}

images::Image FolderReader::read(std::uint32_t frame) const {
  const images::Image picture = picture_of(folder_ / sinks::frame_file_name(manifest_, frame), frame);
  return images::is_exr(manifest_.format) ? expose(picture, frame) : picture;
}

images::Image FolderReader::picture_of(const fs::path& file, std::uint32_t frame) const try {
  if (!sinks::is_frame_file(file))
    throw Failure("frame " + std::to_string(frame) + " is missing", folder_.string(), remedy_in(folder_));
  const bool light = images::is_exr(manifest_.format);
  images::Image picture = light ? images::read_picture(manifest_.format, file) : images::read_opaque(file);
  if (picture.width != manifest_.width || picture.height != manifest_.height)
    throw Failure("has " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                      " pixels instead of " + std::to_string(manifest_.width) + "x" + std::to_string(manifest_.height),
                  file.string(), remedy_in(folder_));
  return picture;
} catch (const Failure& failure) {
  throw sinks::DamagedFrame(failure.problem, failure.where, remedy_in(folder_));
}

wire::FilmSettings FolderReader::settings_at(std::uint32_t frame, wire::Camera& camera) const {
  wire::FilmSettings settings{};
  settings.color_space = wire::ColorSpace::linear;
  if (film_) {
    const wire::PackedFilm view = film_->view();
    settings = view.settings();
    camera = view.camera_at(frame);
  }
  if (exposing_.stops || exposing_.curve) settings.color_space = wire::ColorSpace::linear;
  if (exposing_.stops) camera.exposure = elementary::exp2(*exposing_.stops);
  if (exposing_.curve) settings.curve = *exposing_.curve;
  return settings;
}

images::Image FolderReader::expose(const images::Image& light, std::uint32_t frame) const {
  wire::Camera camera{};
  const wire::FilmSettings settings = settings_at(frame, camera);
  if (exposing_.view)
    return {light.width, light.height,
            images::shown_pixels(*exposing_.view, light.pixels, static_cast<float>(camera.exposure),
                                 wire::PixelFormat::rgb8)};
  const color::Encoding encoding = color::encoding_of(settings, camera, wire::PixelFormat::rgb8);
  images::Image shown{light.width, light.height, {}};
  shown.pixels.reserve(light.pixels.size() / 2);
  for (std::size_t i = 0; i + 1 < light.pixels.size(); i += 2) {
    const std::uint32_t low = light.pixels[i], high = light.pixels[i + 1];
    const float rgb[] = {images::light_of_half(low & 0xffff), images::light_of_half(low >> 16),
                         images::light_of_half(high & 0xffff)};
    shown.pixels.push_back(static_cast<std::uint32_t>(color::pixel_of(encoding, rgb)));
  }
  return shown;
}

std::string FolderReader::content(std::uint32_t frame) const {
  std::string content = sinks::hash_of(manifest_, frame);
  if (!images::is_exr(manifest_.format)) return content;
  wire::Camera camera{};
  const wire::FilmSettings settings = settings_at(frame, camera);
  return content + " " + std::to_string(static_cast<int>(settings.color_space)) + " " +
         std::to_string(static_cast<int>(settings.curve)) + " " +
         std::to_string(std::bit_cast<std::uint64_t>(camera.exposure)) +
         (exposing_.view ? " " + exposing_.view->name().checksum : "");
}

Source source_of(const FolderReader& reader, std::vector<std::uint32_t> frames) {
  const sinks::Manifest& manifest = reader.manifest();
  Source source{{manifest.width, manifest.height},
                images::ratio_of(manifest.place.pixel_aspect),
                manifest.rate,
                std::move(frames),
                manifest.film_frames,
                0,
                manifest.film,
                manifest.checksum};
  source.any_thread = true;
  if (!source.frames.empty()) source.begins = source.frames.front() / exact_rate(manifest.rate);
  const bool known =
      std::ranges::none_of(source.frames, [&](std::uint32_t frame) { return sinks::hash_of(manifest, frame).empty(); });
  source.picture = [&reader, numbers = source.frames](std::size_t place) {
    return std::make_shared<const images::Image>(reader.read(numbers[place]));
  };
  if (known)
    source.content = [&reader, numbers = source.frames](std::size_t place) { return reader.content(numbers[place]); };
  return source;
}

}  // namespace mars::videos
