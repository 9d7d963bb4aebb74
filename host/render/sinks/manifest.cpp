#include "host/render/sinks/manifest.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "hal/failure/failure.h"
#include "hal/failure/plain_text.h"
#include "host/content/document/checksum.h"
#include "host/content/document/text.h"
#include "host/render/sinks/pixel_hash.h"
#include "host/render/sinks/record.h"
#include "node/wire/film_parts.h"

namespace mars::sinks {

using nlohmann::json;

namespace {

constexpr std::size_t kLongestFilm = 3 * 4096;  // bytes: of a path, of which each may be written as three
constexpr auto kKeys = std::to_array<std::string_view>(
    {"version",     "sum",    "film",          "checksum",     "width",   "height",  "format", "rate",
     "film_frames", "frames", "pixel_version", "pixel_hashes", "sources", "options", "names",  "first_number",
     "compression", "window", "pixel_aspect",  "ocio",         "layers",  "usage"});

// Unbroken stretches as [first, last] pairs, so that a long film's manifest stays short.
json stretches_of(const std::vector<std::uint32_t>& frames) {
  json stretches = json::array();
  for (std::size_t first = 0, end; first < frames.size(); first = end) {
    end = first + 1;
    while (end < frames.size() && frames[end] == frames[end - 1] + 1) ++end;
    stretches.push_back({frames[first], frames[end - 1]});
  }
  return stretches;
}

std::uint32_t frame_of(const json& number, std::uint32_t film_frames) {
  if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= film_frames)
    refuse_value("frames", number, "a whole number below film_frames, " + std::to_string(film_frames));
  return number.get<std::uint32_t>();
}

std::vector<std::uint32_t> frames_of(const json& stretches, std::uint32_t film_frames) {
  std::vector<std::uint32_t> frames;
  for (const json& stretch : stretches) {
    if (!stretch.is_array() || stretch.size() != 2) refuse_value("frames", stretch, "a stretch, [first, last]");
    const std::uint32_t first = frame_of(stretch[0], film_frames);
    const std::uint32_t last = frame_of(stretch[1], film_frames);
    const bool ascends = first <= last && (frames.empty() || frames.back() < first);
    if (!ascends) refuse_value("frames", stretch[0], "above all before, and at most the last of its stretch");
    for (std::uint32_t frame = first; frame <= last; ++frame) frames.push_back(frame);
  }
  return frames;
}

json hashes_json(const std::vector<std::string>& hashes) {
  json list = json::array();
  for (const std::string& hash : hashes) list.push_back(hash.empty() ? json() : json(hash));
  return list;
}

std::vector<std::string> hashes_of(const json& list, std::size_t frames) {
  if (list.size() != frames)
    throw Failure("pixel_hashes has " + std::to_string(list.size()) + " entries for " + std::to_string(frames) +
                      " frames",
                  "", "");
  std::vector<std::string> hashes;
  for (const json& hash : list) {
    if (!hash.is_null() && !is_pixel_hash(hash)) refuse_value("pixel_hashes", hash, "a hash of pixels or null");
    hashes.push_back(hash.is_null() ? "" : hash.get<std::string>());
  }
  return hashes;
}

json sources_json(const std::vector<Source>& sources) {
  json list = json::array();
  for (const Source& source : sources)
    list.push_back({source.path, source.checksum.empty() ? json() : json(source.checksum)});
  return list;
}

std::vector<Source> sources_of(const json& list) {
  std::vector<Source> sources;
  for (const json& source : list) {
    const bool pair = source.is_array() && source.size() == 2 && source[0].is_string() &&
                      (source[1].is_null() || is_checksum(source[1]));
    if (!pair) refuse_value("sources", source, "[path, checksum]");
    sources.push_back({source[0].get<std::string>(), source[1].is_null() ? "" : source[1].get<std::string>()});
  }
  return sources;
}

std::vector<std::string> words_of(const json& list) {
  std::vector<std::string> words;
  for (const json& word : list) {
    if (!word.is_string()) refuse_value("options", word, "a word");
    words.push_back(word.get<std::string>());
  }
  return words;
}

std::uint32_t version_of(const Record& record) {
  if (!record.has("version")) return 1;
  const auto version = static_cast<std::uint32_t>(record.whole_number("version", 2, kMostVersion));
  if (version > kManifestVersion)
    throw LaterManifest("it has version " + std::to_string(version) + " and this MARS knows manifests up to version " +
                            std::to_string(kManifestVersion),
                        "", "use the MARS that wrote it or a later one, or give another folder with -o");
  return version;
}

// An older MARS would render under other names, or other pictures.
std::uint32_t version_for(const Manifest& manifest) {
  constexpr std::uint32_t kOfPlainForms = 3, kOfWholePictures = 4;
  if (manifest.place != images::PicturePlace() || !manifest.view.empty() || manifest.layers != 0)
    return kManifestVersion;
  return form_of(manifest) == FrameForm{images::without_alpha(manifest.format)} ? kOfPlainForms : kOfWholePictures;
}

wire::PictureWindow window_of(const json& list) {
  constexpr std::int64_t kLeast[] = {-std::int64_t{wire::kMostMargin}, -std::int64_t{wire::kMostMargin}, 1, 1};
  const auto is_sound = [&](std::size_t i) {
    return list[i].is_number_integer() && list[i].get<std::int64_t>() >= kLeast[i] &&
           list[i].get<std::int64_t>() <= wire::kMaxSide;
  };
  if (list.size() != 4 || !is_sound(0) || !is_sound(1) || !is_sound(2) || !is_sound(3))
    refuse_value("window", list, "left, top, width and height of the whole picture");
  return {list[0].get<std::int32_t>(), list[1].get<std::int32_t>(), list[2].get<std::uint32_t>(),
          list[3].get<std::uint32_t>()};
}

float pixel_aspect_of(const Record& record) {
  constexpr double kMost = wire::kMostPixelAspect;
  const double aspect = record.positive_number("pixel_aspect");
  if (aspect < 1 / kMost || aspect > kMost)
    refuse_value("pixel_aspect", record.value("pixel_aspect"), "a number from 1/16 to 16");
  return static_cast<float>(aspect);
}

// None has been seen of another program in a file of version 1.
std::string unknown_keys(const json& from, std::uint32_t version) {
  json unknown = json::object();
  for (const auto& [key, value] : from.items())
    if (std::ranges::find(kKeys, key) == kKeys.end()) unknown[key] = value;
  if (unknown.empty()) return "";
  if (version == 1) Record(from).refuse_keys_but(kKeys);
  return unknown.dump();
}

}  // namespace

std::string sum_of(json text) {
  text.erase("sum");
  const std::string all = text.dump(-1, ' ', false, json::error_handler_t::replace);
  return document::checksum_of(std::as_bytes(std::span(all)));
}

FrameForm form_of(const Manifest& manifest) {
  return {manifest.format, manifest.compression, manifest.names, manifest.view, manifest.layers};
}

void set_form(Manifest& manifest, const FrameForm& form) {
  manifest.format = form.format;
  manifest.compression = form.compression;
  manifest.names = form.names;
  manifest.view = form.view;
  manifest.layers = form.layers;
}

images::PictureBands bands_of(const Manifest& manifest) {
  return {manifest.format, manifest.width, manifest.height, manifest.compression, manifest.place, manifest.layers};
}

std::vector<std::string> words_of(const FrameForm& form) {
  std::vector<std::string> words;
  const auto add = [&](const char* option, const std::string& value) { words.insert(words.end(), {option, value}); };
  const images::PictureFormat format = images::without_alpha(form.format);
  if (format != images::PictureFormat::png) add("--format", images::facts_of(format).name);
  if (images::has_alpha(form.format)) words.push_back("--alpha");
  if (form.compression != images::Compression::zip) add("--compression", images::name_of(form.compression));
  if (form.layers != 0) add("--layers", images::text_of(form.layers));
  if (!form.names.pattern.empty()) add("--name", form.names.pattern);
  if (form.names.first_number != 0) add("--first-number", std::to_string(form.names.first_number));
  const auto add_text = [&](const char* option, const std::string& value) {
    if (!value.empty()) add(option, value);
  };
  add_text("--ocio", form.view.config);
  add_text("--display", form.view.display);
  add_text("--view", form.view.view);
  add_text("--ocio-input", form.view.input);
  return words;
}

void add_form(const FrameForm& form, json& text) {
  text["format"] = images::facts_of(form.format).name;
  if (form.compression != images::Compression::zip) text["compression"] = images::name_of(form.compression);
  if (form.layers != 0) text["layers"] = images::text_of(form.layers);
  if (!form.names.pattern.empty()) text["names"] = form.names.pattern;
  if (form.names.first_number != 0) text["first_number"] = form.names.first_number;
  const images::ViewName& view = form.view;
  if (!view.empty()) text["ocio"] = {view.config, view.display, view.view, view.input, view.checksum};
}

namespace {

images::ViewName view_of(const json& list) {
  const auto is_text = [](const json& word) { return word.is_string() && !word.get_ref<const std::string&>().empty(); };
  if (list.size() != 5 || !std::ranges::all_of(list, is_text) || !is_checksum(list[4]))
    refuse_value("ocio", list, "config, display, view, input and checksum");
  const auto text = [&](std::size_t i) { return list[i].get<std::string>(); };
  return {text(0), text(1), text(2), text(3), text(4)};
}

wire::LayerSet layers_in(const Record& record, images::PictureFormat format) try {
  constexpr std::size_t kLongest = 200;
  if (!images::is_exr(format)) throw Failure("PNG files have no layers", "", "");
  return images::layers_in(record.text("layers", kLongest));
} catch (const Failure&) {
  refuse_value("layers", record.value("layers"), "layers of EXR files");
}

}  // namespace

void add_place(const images::PicturePlace& place, json& text) {
  const wire::PictureWindow& window = place.window;
  if (!window.is_whole()) text["window"] = {window.left, window.top, window.whole_width, window.whole_height};
  if (place.pixel_aspect != 1) text["pixel_aspect"] = place.pixel_aspect;
}

images::PicturePlace place_of(const Record& record) {
  images::PicturePlace place;
  if (record.has("window")) place.window = window_of(record.list("window"));
  if (record.has("pixel_aspect")) place.pixel_aspect = pixel_aspect_of(record);
  return place;
}

FrameForm form_of(const Record& record) {
  constexpr std::size_t kLongestName = 16, kLongestPattern = 1000;
  FrameForm form;
  if (record.has("format")) {
    const auto format = images::picture_format_of(record.text("format", kLongestName));
    if (!format) refuse_value("format", record.value("format"), "png, png16 or exr, or one with -alpha");
    form.format = *format;
  }
  if (record.has("compression")) {
    const auto compression = images::compression_of(record.text("compression", kLongestName));
    if (!compression) refuse_value("compression", record.value("compression"), "a compression of EXR files");
    form.compression = *compression;
  }
  if (record.has("layers")) form.layers = layers_in(record, form.format);
  if (record.has("names")) {
    form.names.pattern = record.text("names", kLongestPattern);
    if (images::frame_pattern(form.names.pattern) != form.names.pattern)
      refuse_value("names", record.value("names"), "names with # for the number");
  }
  if (record.has("first_number"))
    form.names.first_number =
        static_cast<std::uint32_t>(record.whole_number("first_number", 0, images::kMostFirstNumber));
  if (record.has("ocio")) form.view = view_of(record.list("ocio"));
  return form;
}

bool are_of_one_folder(const Manifest& a, const Manifest& b) {
  return a.checksum == b.checksum && form_of(a) == form_of(b) && a.pixel_version == b.pixel_version;
}

void add_frames(Manifest& manifest, const Manifest& more) {
  std::vector<std::uint32_t> frames;
  std::vector<std::string> hashes;
  const auto hash_of = [](const Manifest& from, std::size_t at) {
    return at < from.pixel_hashes.size() ? from.pixel_hashes[at] : std::string();
  };
  for (std::size_t a = 0, b = 0; a < manifest.frames.size() || b < more.frames.size();) {
    const bool in_more =
        b < more.frames.size() && (a == manifest.frames.size() || more.frames[b] <= manifest.frames[a]);
    const bool in_old = a < manifest.frames.size() && (!in_more || manifest.frames[a] == more.frames[b]);
    frames.push_back(in_more ? more.frames[b] : manifest.frames[a]);
    std::string hash = in_more ? hash_of(more, b) : "";
    if (hash.empty() && in_old) hash = hash_of(manifest, a);
    hashes.push_back(std::move(hash));
    a += in_old;
    b += in_more;
  }
  manifest.frames = std::move(frames);
  manifest.pixel_hashes = std::move(hashes);
}

void set_hash(Manifest& manifest, std::uint32_t frame, const std::string& hash) {
  const auto place = std::ranges::lower_bound(manifest.frames, frame);
  if (place != manifest.frames.end() && *place == frame)
    manifest.pixel_hashes[static_cast<std::size_t>(place - manifest.frames.begin())] = hash;
}

std::string hash_of(const Manifest& manifest, std::uint32_t frame) {
  const auto place = std::ranges::lower_bound(manifest.frames, frame);
  const auto at = static_cast<std::size_t>(place - manifest.frames.begin());
  const bool has_it = place != manifest.frames.end() && *place == frame && at < manifest.pixel_hashes.size();
  return has_it ? manifest.pixel_hashes[at] : "";
}

std::string film_text(const Manifest& manifest) {
  const std::string& film = manifest.film;
  constexpr std::size_t kLongestShown = 200;  // bytes
  std::size_t from = film.size() - std::min(film.size(), kLongestShown);
  while (from < film.size() && (static_cast<unsigned char>(film[from]) & 0xc0) == 0x80) ++from;  // within a letter
  return (from > 0 ? "..." : "") + plain_line(film.substr(from));
}

json to_json(const Manifest& manifest) {
  json text = manifest.more.empty() ? json::object() : json::parse(manifest.more);
  text.update({{"version", version_for(manifest)},
               {"film", manifest.film},
               {"checksum", manifest.checksum},
               {"width", manifest.width},
               {"height", manifest.height},
               {"rate", manifest.rate},
               {"film_frames", manifest.film_frames},
               {"frames", stretches_of(manifest.frames)},
               {"pixel_version", manifest.pixel_version}});
  add_form(form_of(manifest), text);
  add_place(manifest.place, text);
  if (!manifest.pixel_hashes.empty()) text["pixel_hashes"] = hashes_json(manifest.pixel_hashes);
  if (!manifest.sources.empty()) text["sources"] = sources_json(manifest.sources);
  if (!manifest.options.empty()) text["options"] = manifest.options;
  add_usage(manifest.usage, text);
  text["sum"] = sum_of(text);
  return text;
}

Manifest manifest_of(const json& from) {
  const Record record(from);
  const std::uint32_t version = version_of(record);
  if (version > 1 && record.checksum("sum") != sum_of(from)) throw Failure("its sum is that of another text", "", "");
  Manifest manifest;
  manifest.more = unknown_keys(from, version);
  manifest.pixel_version = version == 1
                               ? wire::kFirstPixelVersion
                               : static_cast<std::uint32_t>(record.whole_number("pixel_version", 1, kMostVersion));
  manifest.film = record.text("film", kLongestFilm);
  manifest.checksum = record.checksum("checksum");
  manifest.width = static_cast<std::uint32_t>(record.whole_number("width", 1, wire::kMaxSide));
  manifest.height = static_cast<std::uint32_t>(record.whole_number("height", 1, wire::kMaxSide));
  set_form(manifest, form_of(record));
  manifest.place = place_of(record);
  manifest.rate = record.positive_number("rate");
  manifest.film_frames = static_cast<std::uint32_t>(record.whole_number("film_frames", 1, wire::kMostFrames));
  manifest.frames = frames_of(record.list("frames"), manifest.film_frames);
  if (from.contains("pixel_hashes"))
    manifest.pixel_hashes = hashes_of(record.list("pixel_hashes"), manifest.frames.size());
  if (from.contains("sources")) manifest.sources = sources_of(record.list("sources"));
  if (from.contains("options")) manifest.options = words_of(record.list("options"));
  manifest.usage = usage_of(record);
  return manifest;
}

std::optional<std::uint32_t> frame_of_file(const Manifest& manifest, const std::string& name) {
  const std::string_view ending = images::facts_of(manifest.format).ending;
  if (!name.ends_with(ending)) return std::nullopt;
  return images::frame_of_name(manifest.names, name.substr(0, name.size() - ending.size()), manifest.film_frames);
}

std::string frame_file_name(const Manifest& manifest, std::uint32_t frame) {
  return images::frame_name(manifest.names, frame, manifest.film_frames) + images::facts_of(manifest.format).ending;
}

}  // namespace mars::sinks
