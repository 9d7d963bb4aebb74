#include "host/render/sinks/frame_mark.h"

#include <sys/stat.h>

#include <cerrno>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "host/content/document/whole_file.h"
#include "host/images/picture_file.h"
#include "host/render/sinks/pixel_hash.h"
#include "host/render/sinks/record.h"
#include "node/wire/film_parts.h"

namespace mars::sinks {

using nlohmann::json;

namespace {

std::uint32_t number_in(const Record& record, std::string_view key, std::uint32_t lowest, std::uint32_t highest) {
  return static_cast<std::uint32_t>(record.whole_number(key, lowest, highest));
}

FrameMark mark_of(const json& from) {
  const Record record(from);
  FrameMark mark;
  mark.film = record.checksum("film");
  if (record.has("content")) mark.content = record.checksum("content");
  mark.film_frames = number_in(record, "film_frames", 1, wire::kMostFrames);
  mark.frame = number_in(record, "frame", 0, mark.film_frames - 1);
  mark.rate = record.positive_number("rate");
  mark.form = form_of(record);
  mark.place = place_of(record);
  mark.pixel_version = number_in(record, "pixel_version", 1, kMostVersion);
  const json& hash = record.value("pixel_hash");
  if (!is_pixel_hash(hash)) refuse_value("pixel_hash", hash, "a hash of pixels");
  mark.pixel_hash = hash.get<std::string>();
  return mark;
}

}  // namespace

std::string text_of(const FrameMark& mark) {
  json text = {{"film", mark.film},
               {"frame", mark.frame},
               {"film_frames", mark.film_frames},
               {"rate", mark.rate},
               {"pixel_version", mark.pixel_version},
               {"pixel_hash", mark.pixel_hash}};
  add_form(mark.form, text);
  add_place(mark.place, text);
  if (!mark.content.empty()) text["content"] = mark.content;
  return text.dump();
}

std::optional<FrameMark> mark_of(const std::string& text) try {
  return mark_of(parse_record(text));
} catch (const Failure&) {
  return std::nullopt;
}

std::optional<FrameMark> read_mark(const std::filesystem::path& file) {
  const std::optional<std::string> note = images::read_note(file);
  return note ? mark_of(*note) : std::nullopt;
}

bool is_named_as_frame(const std::string& file_name, const std::optional<FrameMark>& mark) {
  if (file_name.starts_with("frame-")) return true;
  return mark && file_name == images::frame_name(mark->form.names, mark->frame, mark->film_frames) +
                                  images::facts_of(mark->form.format).ending;
}

bool is_frame_file(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) == 0) return S_ISREG(status.st_mode) && status.st_size > 0;
  if (errno != ENOENT && errno != ENOTDIR && errno != ELOOP) document::fail_file("look at", file, errno);
  return false;
}

FrameMark mark_in(const Manifest& manifest, std::uint32_t frame, const std::string& pixel_hash,
                  const std::string& content) {
  return {manifest.checksum, content,           frame,          manifest.film_frames,
          manifest.rate,     form_of(manifest), manifest.place, manifest.pixel_version,
          pixel_hash};
}

images::FileFacts facts_in(const Manifest& manifest, std::uint32_t frame, const std::string& pixel_hash,
                           const std::string& content) {
  return {text_of(mark_in(manifest, frame, pixel_hash, content)), manifest.rate, frame};
}

}  // namespace mars::sinks
