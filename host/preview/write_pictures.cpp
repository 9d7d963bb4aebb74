#include "host/preview/write_pictures.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/images/picture_file.h"
#include "host/content/document/whole_file.h"
#include "host/preview/sheet.h"

namespace mars::preview {
namespace {

constexpr images::PictureSize kLargestGif{960, 540};  // unless a size is asked for: they are large files
constexpr images::PictureSize kOnSheet{320, 180};

bool is_picture(const WriteOptions& options) { return options.file.extension() == ".png"; }

void write_png(const std::filesystem::path& file, const images::Image& image) {
  document::write_whole_file(
      file, images::encode_picture(images::PictureFormat::png, image.width, image.height, image.pixels));
}

SharedImage ready(Pictures& pictures, std::uint32_t frame, images::PictureSize extent) {
  SharedImage image = pictures.picture(frame, extent);
  check(image != nullptr, "pictures to be written are ready");
  return image;
}

void write_video(Pictures& pictures, const WriteOptions& options, const std::vector<std::uint32_t>& frames,
                 images::PictureSize extent, const videos::Listener& listener) {
  const SharedImage first = ready(pictures, frames.front(), extent);
  videos::Source source{
      {first->width, first->height},   {1, 1}, pictures.rate() / options.every, frames, pictures.frames(),
      frames.front() / pictures.rate()};
  source.picture = [&](std::size_t place) { return place == 0 ? first : ready(pictures, frames[place], extent); };
  videos::write_video(source, {options.file, options.form, options.audio}, listener);
}

}  // namespace

void check_kind(const std::filesystem::path& file) {
  if (file.extension() != ".png" && !videos::is_video_name(file))
    throw Failure("'" + file.string() + "' ends in none of .png, " + videos::endings_text(), "",
                  "name a picture or contact sheet like sheet.png, or a video like film.mp4");
}

std::vector<std::uint32_t> frames_to_write(const WriteOptions& options, std::uint32_t film_frames) {
  const std::vector<std::uint32_t> asked = options.frames.value_or(film::FrameSet()).of_film(film_frames);
  std::vector<std::uint32_t> frames;
  for (std::size_t i = 0; i < asked.size(); i += options.every) frames.push_back(asked[i]);
  if (!is_picture(options) || options.frames || options.every > 1 || frames.size() <= kSheetFrames) return frames;
  std::vector<std::uint32_t> some;  // the first, the last, and evenly between
  for (std::size_t i = 0; i < kSheetFrames; ++i) some.push_back(frames[i * (frames.size() - 1) / (kSheetFrames - 1)]);
  return some;
}

images::PictureSize extent_to_write(const WriteOptions& options, images::PictureSize film, std::size_t frames) {
  if (options.extent) return *options.extent;
  if (is_picture(options) && frames > 1) return fitted(film, kOnSheet);
  const bool large = film.width > kLargestGif.width || film.height > kLargestGif.height;
  return large && options.file.extension() == ".gif" ? fitted(film, kLargestGif) : film;
}

void write_pictures(Pictures& pictures, const WriteOptions& options, const videos::Listener& listener) {
  const std::vector<std::uint32_t> frames = frames_to_write(options, pictures.frames());
  const images::PictureSize extent = extent_to_write(options, pictures.extent(), frames.size());
  // Better now than after the last frame.
  if (is_picture(options))
    document::check_can_write(options.file);
  else
    videos::check_order({options.file, options.form, options.audio}, extent);
  if (!is_picture(options)) return write_video(pictures, options, frames, extent, listener);
  std::vector<SheetPicture> shown;
  for (const std::uint32_t frame : frames) shown.push_back({frame, ready(pictures, frame, extent)});
  write_png(options.file, shown.size() == 1 ? *shown.front().image : contact_sheet(shown, options.columns));
}

void write_folder_video(const FolderPictures& pictures, const WriteOptions& options, const videos::Listener& listener) {
  std::vector<std::uint32_t> frames;
  for (const std::uint32_t place : frames_to_write(options, pictures.frames()))
    frames.push_back(pictures.reader().manifest().frames[place]);
  videos::Source source = videos::source_of(pictures.reader(), std::move(frames));
  const images::PictureSize extent = extent_to_write(options, source.size, source.frames.size());
  source.rate /= options.every;
  if (extent != source.size) {
    source.size = fitted(source.size, extent);
    source.picture = [whole = source.picture, size = source.size](std::size_t place) {
      return std::make_shared<const images::Image>(scaled(*whole(place), size));
    };
  }
  videos::write_video(source, {options.file, options.form, options.audio}, listener);
}

}  // namespace mars::preview
