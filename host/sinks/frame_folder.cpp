#include "host/sinks/frame_folder.h"

#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "hal/failure.h"
#include "host/document/whole_file.h"
#include "host/sinks/claim.h"
#include "host/sinks/png_file.h"

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

Manifest read_frames_json(const fs::path& folder) {
  const fs::path path = folder / kManifestName;
  if (!fs::exists(path)) {
    throw Failure("no folder of frames: it has no frames.json", folder.string(),
                  "name the folder that was given to mars render with -o");
  }
  const std::vector<std::byte> bytes = read_whole_file(path);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  try {
    return manifest_of(json::parse(text, text + bytes.size()));
  } catch (const std::exception& error) {
    throw Failure(std::string("not a manifest of frames: ") + error.what(), path.string(),
                  "render into the folder again");
  }
}

// The folder's manifest, if it has a sound one and that is of this very film.
std::optional<Manifest> manifest_of_same_film(const fs::path& folder, const std::string& checksum) {
  try {
    Manifest old = read_frames_json(folder);
    if (old.checksum == checksum) return old;
  } catch (const Failure&) {
  }
  return std::nullopt;
}

void write_manifest(const Manifest& manifest, const fs::path& folder, const RunsFolder& runs) {
  const std::string text = to_json(manifest).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
  replace_file(folder / kManifestName, runs.own_file(".frames.json.part"), std::as_bytes(std::span(text)));
}

// Adds what a run has rendered to the manifest, unless that is of another film by now, and removes the run's files: its
// claim last, so that whatever is left of them is known to be its. The run has ended, or is this one at its end.
void settle(const RunFiles& run, const fs::path& folder, const RunsFolder& runs, const FolderTurn& turn) {
  std::error_code ignored;  // what stays is found by the next run
  for (const fs::path& file : run.files)
    if (file.extension() == kPartSuffix) fs::remove(file, ignored);
  if (const std::optional<Manifest> rendered = rendered_by(run)) {
    const bool missing = !fs::exists(folder / kManifestName);
    std::optional<Manifest> all = missing ? rendered : manifest_of_same_film(folder, rendered->checksum);
    turn.confirm();
    if (all) add_frames(*all, *rendered);
    if (all) write_manifest(*all, folder, runs);
  }
  for (const bool claims : {false, true})
    for (const fs::path& file : run.files)
      if ((file.extension() == kClaimEnding) == claims && file != turn.file()) fs::remove(file, ignored);
}

void settle_ended_runs(const fs::path& folder, const RunsFolder& runs, const FolderTurn& turn) {
  for (const RunFiles& run : runs.runs())
    if (run.run != runs.own_name() && turn.has_ended(run)) settle(run, folder, runs, turn);
}

// Names that were made in the folder are on the disk too; not every file system can do that.
void sync_folder(const fs::path& folder) {
  const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  fsync(opened);
  close(opened);
}

}  // namespace

FrameFolder::FrameFolder(fs::path path, const Manifest& manifest, const ProcessName& self)
    : path_(std::move(path)), film_frames_(manifest.film_frames), runs_(path_, self) {
  create_folder(path_);
  const FolderTurn turn(runs_);
  try {
    claim(turn, manifest);
  } catch (...) {
    runs_.remove_own_files();
    throw;
  }
}

void FrameFolder::claim(const FolderTurn& turn, const Manifest& manifest) {
  for (const RunFiles& run : runs_.runs())
    if (has_claim(run) && !turn.has_ended(run)) refuse_rival(run, manifest, path_);
  settle_ended_runs(path_, runs_, turn);
  turn.confirm();
  std::optional<Manifest> all = manifest_of_same_film(path_, manifest.checksum);
  if (!all) {  // another film's frames under the names to come would pass as this one's if the run were interrupted
    for (const std::uint32_t frame : manifest.frames) fs::remove(file_of(frame));
    all = manifest;
  }
  add_frames(*all, manifest);
  const std::string text = text_of(Claim{runs_.self(), time(nullptr), manifest});
  replace_file(runs_.own_file(kClaimEnding), runs_.own_file(".claim.part"), std::as_bytes(std::span(text)));
  lease_.emplace(runs_.own_file(kClaimEnding));
  hashes_.emplace(runs_.own_file(kHashesEnding));
  write_manifest(*all, path_, runs_);
}

FrameFolder::~FrameFolder() {
  try {
    finish();
  } catch (const std::exception&) {
  }
}

void FrameFolder::finish() {
  if (finished_) return;
  finished_ = true;
  const FolderTurn turn(runs_);
  lease_->confirm();
  hashes_.reset();
  for (const RunFiles& run : runs_.runs())
    if (run.run == runs_.own_name()) settle(run, path_, runs_, turn);
  lease_.reset();
  sync_folder(path_);
}

fs::path FrameFolder::file_of(std::uint32_t frame) const { return path_ / frame_file_name(frame, film_frames_); }

// The hash first: should the run be killed between the two, a frame without a file is missing, but a file without a
// hash would say nothing.
void FrameFolder::put(std::uint32_t frame, const std::string& pixel_hash, std::span<const std::byte> png) {
  lease_->check();
  hashes_->add(frame, pixel_hash);
  const std::string part = "." + frame_file_name(frame, film_frames_) + std::string(kPartSuffix);
  replace_file(file_of(frame), runs_.own_file(part), png);
}

void clear_ended_runs(const fs::path& folder) {
  const RunsFolder runs(folder, this_process());
  if (!runs.exists()) return;
  try {
    settle_ended_runs(folder, runs, FolderTurn(runs));
  } catch (const std::exception&) {
  }
}

Manifest read_manifest(const fs::path& folder) {
  // The runs first: what one has rendered is in frames.json before it is gone from there.
  std::vector<Manifest> unfinished;
  for (const RunFiles& run : RunsFolder(folder, this_process()).runs())
    if (std::optional<Manifest> rendered = rendered_by(run)) unfinished.push_back(std::move(*rendered));
  Manifest manifest = read_frames_json(folder);
  for (const Manifest& rendered : unfinished)
    if (rendered.checksum == manifest.checksum) add_frames(manifest, rendered);
  return manifest;
}

void PngSink::take(const Frame& frame) {
  folder_.put(frame.number, pixel_hash(frame.pixels), encode_png(frame.width, frame.height, frame.pixels));
}

}  // namespace mars::host
