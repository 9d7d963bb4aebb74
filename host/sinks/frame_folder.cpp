#include "host/sinks/frame_folder.h"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "hal/failure.h"
#include "host/sinks/png_file.h"
#include "host/document/whole_file.h"
#include "node/film.h"

namespace mars::host {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kManifestName = "frames.json";

void create_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail_file("create the folder", path, error.value());
  if (!fs::is_directory(path)) fail_file("create the folder", path, ENOTDIR);
}

// Unbroken stretches as [first, last] pairs, so that a long film's manifest stays short.
json stretches_of(const std::vector<std::uint32_t>& frames) {
  json stretches = json::array();
  for (const std::uint32_t frame : frames) {
    if (!stretches.empty() && stretches.back()[1].get<std::uint64_t>() + 1 == frame) {
      stretches.back()[1] = frame;
    } else {
      stretches.push_back({frame, frame});
    }
  }
  return stretches;
}

// A whole number below `end`; JSON's own conversions would bend any other into one.
std::uint32_t whole_number(const json& from, std::uint32_t end) {
  if (!from.is_number_unsigned() || from.get<std::uint64_t>() >= end) {
    throw std::out_of_range(from.dump() + " is not a whole number below " + std::to_string(end));
  }
  return from.get<std::uint32_t>();
}

std::vector<std::uint32_t> frames_of(const json& stretches, std::uint32_t film_frames) {
  std::vector<std::uint32_t> frames;
  for (const json& stretch : stretches) {
    const std::uint32_t last = whole_number(stretch.at(1), film_frames);
    for (std::uint32_t frame = whole_number(stretch.at(0), film_frames); frame <= last; ++frame) {
      frames.push_back(frame);
    }
  }
  return frames;
}

json to_json(const Manifest& manifest) {
  return {{"film", manifest.film},
          {"checksum", manifest.checksum},
          {"width", manifest.width},
          {"height", manifest.height},
          {"rate", manifest.rate},
          {"film_frames", manifest.film_frames},
          {"frames", stretches_of(manifest.frames)}};
}

Manifest from_json(const json& from) {
  Manifest manifest;
  from.at("film").get_to(manifest.film);
  from.at("checksum").get_to(manifest.checksum);
  manifest.width = whole_number(from.at("width"), node::kMaxSide + 1);
  manifest.height = whole_number(from.at("height"), node::kMaxSide + 1);
  from.at("rate").get_to(manifest.rate);
  manifest.film_frames = whole_number(from.at("film_frames"), node::kMostFrames);
  manifest.frames = frames_of(from.at("frames"), manifest.film_frames);
  return manifest;
}

}  // namespace

namespace {

// The folder's manifest, if it has a sound one and that is of this very film.
std::optional<Manifest> manifest_of_same_film(const fs::path& folder, const Manifest& manifest) {
  if (!fs::exists(folder / kManifestName)) return std::nullopt;
  try {
    Manifest old = read_manifest(folder);
    if (old.checksum == manifest.checksum) return old;
  } catch (const Failure&) {
  }
  return std::nullopt;
}

std::vector<std::uint32_t> together(const std::vector<std::uint32_t>& some, const std::vector<std::uint32_t>& others) {
  std::vector<std::uint32_t> frames;
  std::ranges::set_union(some, others, std::back_inserter(frames));
  return frames;
}

}  // namespace

FrameFolder::FrameFolder(fs::path path, const Manifest& manifest)
    : path_(std::move(path)), film_frames_(manifest.film_frames) {
  create_folder(path_);
  remove_parts(path_);
  Manifest all = manifest;
  if (const auto before = manifest_of_same_film(path_, manifest))
    all.frames = together(before->frames, manifest.frames);
  else  // another film's frames under the names to come would pass as this one's if the run were interrupted
    for (const std::uint32_t frame : manifest.frames) fs::remove(file_of(frame));
  write_whole_file(path_ / kManifestName, to_json(all).dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

fs::path FrameFolder::file_of(std::uint32_t frame) const {
  return path_ / frame_file_name(frame, film_frames_);
}

std::string frame_file_name(std::uint32_t frame, std::uint32_t film_frames) {
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(film_frames - 1).size());
  const std::string number = std::to_string(frame);
  return "frame-" + std::string(digits - std::min(digits, number.size()), '0') + number + ".png";
}

void remove_parts(const fs::path& folder) {
  std::error_code ignored;  // what cannot be listed or removed will be told by the next write
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("frame") && name.ends_with(kPartSuffix)) fs::remove(entry.path(), ignored);
  }
}

Manifest read_manifest(const fs::path& folder) {
  const fs::path path = folder / kManifestName;
  if (!fs::exists(path)) {
    throw Failure("no folder of frames: it has no frames.json", folder.string(),
                  "name the folder that was given to mars render with -o");
  }
  const std::vector<std::byte> bytes = read_whole_file(path);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  try {
    return from_json(json::parse(text, text + bytes.size()));
  } catch (const std::exception& error) {
    throw Failure(std::string("not a manifest of frames: ") + error.what(), path.string(),
                  "render into the folder again");
  }
}

void PngSink::take(const Frame& frame) {
  write_whole_file(folder_.file_of(frame.number), encode_png(frame.width, frame.height, frame.pixels));
}

}  // namespace mars::host
