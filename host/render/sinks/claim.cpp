#include "host/render/sinks/claim.h"

#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/frame_set.h"
#include "host/render/sinks/pixel_hash.h"
#include "host/render/sinks/record.h"

namespace mars::sinks {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::chrono::seconds kSyncPeriod{1};

std::optional<fs::path> file_of(const RunFiles& run, std::string_view ending) {
  const auto found = std::ranges::find_if(run.files, [&](const fs::path& file) { return file.extension() == ending; });
  return found == run.files.end() ? std::nullopt : std::optional(*found);
}

// As it can be read at a glance: of a long list only where it begins and ends.
std::string frames_text(const std::vector<std::uint32_t>& frames) {
  constexpr std::size_t kLongestList = 40;
  const std::string list = film::FrameSet(frames).text();
  if (frames.size() == 1) return "frame " + list;
  if (list.size() <= kLongestList) return "frames " + list;
  return std::to_string(frames.size()) + " frames from " + std::to_string(frames.front()) + " to " +
         std::to_string(frames.back());
}

// With the day unless it is today's.
std::string time_text(std::int64_t when) {
  const time_t then = when, now = time(nullptr);
  tm day{}, today{};
  localtime_r(&then, &day);
  localtime_r(&now, &today);
  const bool same_day = day.tm_year == today.tm_year && day.tm_yday == today.tm_yday;
  std::array<char, 40> text{};
  strftime(text.data(), text.size(), same_day ? "%H:%M:%S" : "%Y-%m-%d %H:%M:%S", &day);
  return text.data();
}

// "another run, process 4711 on host n1, renders frames 0-99 of film.json into this folder since 12:01:33"
std::string description(const Claim& claim, const std::string& which = "") {
  return "another run, process " + std::to_string(claim.process.number) + " on host " + claim.process.host +
         ", renders " + frames_text(claim.manifest.frames) + " of " + which + film_text(claim.manifest) +
         " into this folder since " + time_text(claim.since);
}

}  // namespace

std::string text_of(const Claim& claim) {
  json text = to_json(claim.process);
  text["since"] = claim.since;
  text["manifest"] = to_json(claim.manifest);
  return text.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

bool has_claim(const RunFiles& run) { return file_of(run, kClaimEnding).has_value(); }

std::optional<Claim> claim_of(const RunFiles& run) {
  const std::optional<fs::path> file = file_of(run, kClaimEnding);
  if (!file) return std::nullopt;
  const std::optional<std::string> text = document::read_file_if_there(*file, kLargestRecord);
  if (!text) return std::nullopt;
  try {
    const json from = parse_record(*text);
    const Record record(from);
    const auto since = static_cast<std::int64_t>(record.whole_number("since", 0, kLastSecond));
    return Claim{process_name_of(from), since, manifest_of(record.value("manifest"))};
  } catch (const Failure&) {
    return std::nullopt;
  }
}

std::optional<Manifest> rendered_by(const RunFiles& run) {
  std::optional<Claim> claim = claim_of(run);
  if (!claim) return std::nullopt;
  Manifest& manifest = claim->manifest;
  manifest.pixel_hashes.assign(manifest.frames.size(), "");
  const std::optional<fs::path> file = file_of(run, kHashesEnding);
  const std::optional<std::string> text = file ? document::read_file_if_there(*file, kLargestRecord) : std::nullopt;
  std::istringstream lines(text.value_or(""));
  std::uint32_t frame = 0;
  for (std::string hash; lines >> frame >> hash;) {
    if (is_pixel_hash(hash)) set_hash(manifest, frame, hash);  // the last line may have been cut off
  }
  return manifest;
}

HashLog::HashLog(fs::path file)
    : file_(std::move(file)),
      number_(open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666)) {
  if (number_ < 0) document::fail_file("write", file_, errno);
}

HashLog::~HashLog() { close(number_); }

void HashLog::add(std::uint32_t frame, const std::string& hash) {
  const std::string line = std::to_string(frame) + " " + hash + "\n";
  const std::lock_guard lock(mutex_);
  write_rest();
  rest_ = line;
  write_rest();
  sync_now_and_then();
}

// Frames whose hashes are lost are drawn again.
void HashLog::sync_now_and_then() {
  if (Clock::now() - synced_ < kSyncPeriod) return;
  synced_ = Clock::now();
  if (fdatasync(number_) != 0 && errno != EINVAL && errno != EINTR) document::fail_file("write", file_, errno);
}

void HashLog::write_rest() {
  while (!rest_.empty()) {
    const ssize_t written = write(number_, rest_.data(), rest_.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) document::fail_file("write", file_, errno);
    rest_.erase(0, static_cast<std::size_t>(written));
  }
}

std::optional<Failure> conflict_with(const RunFiles& run, const Manifest& wanted, const fs::path& folder) {
  const std::optional<Claim> rival = claim_of(run);
  if (!rival)
    return Failure("another run renders into this folder, and its claim cannot be read",
                   file_of(run, kClaimEnding)->string(), "give another folder with -o, or wait");
  const Manifest& theirs = rival->manifest;
  if (!are_of_one_folder(theirs, wanted)) {
    const std::string which = theirs.film == wanted.film ? "another version, size or format of " : "";
    return Failure(description(*rival, which), folder.string(), "give another folder with -o, or wait");
  }
  std::vector<std::uint32_t> both;
  std::ranges::set_intersection(theirs.frames, wanted.frames, std::back_inserter(both));
  if (both.empty()) return std::nullopt;
  return Failure(description(*rival), folder.string(),
                 "give other frames with --frames, another folder with -o, or wait");
}

}  // namespace mars::sinks
