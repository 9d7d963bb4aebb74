#include "host/sinks/manifest.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "host/options/frame_set.h"
#include "host/sinks/checksum.h"
#include "node/film.h"

namespace mars::host {

using nlohmann::json;

namespace {

// Unbroken stretches as [first, last] pairs, so that a long film's manifest stays short.
json stretches_of(const std::vector<std::uint32_t>& frames) {
  json stretches = json::array();
  const FrameSet set(frames);
  for (const FrameSet::Stretch& stretch : set.stretches()) stretches.push_back({stretch.first, *stretch.last});
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
    const std::uint32_t first = whole_number(stretch.at(0), film_frames);
    if (!frames.empty() && first <= frames.back()) throw std::out_of_range("frames do not ascend");
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
  if (list.size() != frames) throw std::out_of_range("pixel_hashes has not one entry for each frame");
  std::vector<std::string> hashes;
  for (const json& hash : list) hashes.push_back(hash.is_null() ? "" : hash.get<std::string>());
  return hashes;
}

}  // namespace

std::string pixel_hash(const std::vector<std::uint32_t>& pixels) {
  return checksum_of(std::as_bytes(std::span(pixels)));
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

json to_json(const Manifest& manifest) {
  json text = {{"film", manifest.film},
               {"checksum", manifest.checksum},
               {"width", manifest.width},
               {"height", manifest.height},
               {"rate", manifest.rate},
               {"film_frames", manifest.film_frames},
               {"frames", stretches_of(manifest.frames)}};
  if (!manifest.pixel_hashes.empty()) text["pixel_hashes"] = hashes_json(manifest.pixel_hashes);
  return text;
}

Manifest manifest_of(const json& from) {
  Manifest manifest;
  from.at("film").get_to(manifest.film);
  from.at("checksum").get_to(manifest.checksum);
  manifest.width = whole_number(from.at("width"), node::kMaxSide + 1);
  manifest.height = whole_number(from.at("height"), node::kMaxSide + 1);
  from.at("rate").get_to(manifest.rate);
  manifest.film_frames = whole_number(from.at("film_frames"), node::kMostFrames + 1);
  manifest.frames = frames_of(from.at("frames"), manifest.film_frames);
  if (from.contains("pixel_hashes"))
    manifest.pixel_hashes = hashes_of(from.at("pixel_hashes"), manifest.frames.size());
  return manifest;
}

std::string frame_file_name(std::uint32_t frame, std::uint32_t film_frames) {
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(film_frames - 1).size());
  const std::string number = std::to_string(frame);
  return "frame-" + std::string(digits - std::min(digits, number.size()), '0') + number + ".png";
}

}  // namespace mars::host
