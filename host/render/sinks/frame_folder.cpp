#include "host/render/sinks/frame_folder.h"

#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/images/picture_file.h"
#include "host/render/sinks/claim.h"
#include "host/render/sinks/record.h"

namespace mars::sinks {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kManifestName = "frames.json";
constexpr std::chrono::seconds kShortPatience{2};  // of a run that fails: a person waits to learn why

void create_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) document::fail_file("create the folder", path, error.value());
  if (!fs::is_directory(path, error)) document::fail_file("create the folder", path, ENOTDIR);
}

// What frames.json says; none where there is none. Throws Failure where it cannot be read or says nothing sound: then
// it is unknown which frames belong into the folder, and no run may decide that none do.
std::optional<Manifest> read_frames_json(const fs::path& folder) {
  const fs::path path = folder / kManifestName;
  const std::optional<std::string> text = document::read_file_if_there(path, kLargestRecord);
  if (!text) return std::nullopt;
  try {
    return manifest_of(parse_record(*text));
  } catch (const Failure& failure) {
    throw Failure("not a manifest of frames: " + failure.problem, path.string(),
                  "remove it, and render all frames of the folder again");
  }
}

// The folder's manifest, if these frames belong there too.
std::optional<Manifest> manifest_for(const Manifest& wanted, const fs::path& folder) {
  std::optional<Manifest> old = read_frames_json(folder);
  return old && are_of_one_folder(*old, wanted) ? old : std::nullopt;
}

void write_manifest(const Manifest& manifest, const fs::path& folder, const RunsFolder& runs) {
  const std::string text = to_json(manifest).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
  document::replace_file(folder / kManifestName, runs.own_file(".frames.json.part"), std::as_bytes(std::span(text)));
}

// False, and nothing is added, where the manifest is of another film or format.
bool add_to_manifest(const Manifest& rendered, const fs::path& folder, const RunsFolder& runs, const FolderTurn& turn) {
  Manifest all = read_frames_json(folder).value_or(rendered);
  turn.confirm();
  if (!are_of_one_folder(all, rendered)) return false;
  add_frames(all, rendered);
  write_manifest(all, folder, runs);
  return true;
}

// Also makes room on a full disk for the manifest.
void remove_parts(const RunFiles& run) {
  std::error_code ignored;  // what stays is found by the next run
  for (const fs::path& file : run.files)
    if (file.extension() == document::kPartSuffix) fs::remove(file, ignored);
}

// The claim last, so that whatever is left of a run is known to be its.
void remove_files(const RunFiles& run, const FolderTurn& turn) {
  std::error_code ignored;  // likewise
  for (const bool claims : {false, true})
    for (const fs::path& file : run.files)
      if ((file.extension() == kClaimEnding) == claims && file != turn.file()) fs::remove(file, ignored);
}

void settle_ended_runs(const fs::path& folder, const RunsFolder& runs, const FolderTurn& turn) {
  for (const RunFiles& run : runs.runs()) {
    if (run.run == runs.own_name() || !turn.has_ended(run)) continue;
    remove_parts(run);
    if (const std::optional<Manifest> rendered = rendered_by(run)) add_to_manifest(*rendered, folder, runs, turn);
    remove_files(run, turn);
  }
}

void remove_frame(const fs::path& file) {
  if (unlink(file.c_str()) != 0 && errno != ENOENT) document::fail_file("remove", file, errno);
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
    : path_(std::move(path)), rendered_(manifest), runs_(path_, self) {
  rendered_.pixel_hashes.assign(rendered_.frames.size(), "");
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
  std::optional<Manifest> all = manifest_for(manifest, path_);
  if (!all) {  // other frames under the names to come would pass as this one's if the run were interrupted
    for (const std::uint32_t frame : manifest.frames) remove_frame(file_of(frame));
    all = manifest;
  }
  add_frames(*all, manifest);
  const std::string text = text_of(Claim{runs_.self(), time(nullptr), manifest});
  document::replace_file(runs_.own_file(kClaimEnding), runs_.own_file(".claim.part"), std::as_bytes(std::span(text)));
  lease_.emplace(runs_.own_file(kClaimEnding));
  hashes_.emplace(runs_.own_file(kHashesEnding));
  write_manifest(*all, path_, runs_);
}

FrameFolder::~FrameFolder() {
  try {
    finish_within(kShortPatience);
  } catch (const std::exception&) {
  }
}

void FrameFolder::finish() { finish_within(FolderTurn::kPatience); }

void FrameFolder::finish_within(std::chrono::milliseconds patience) {
  if (finished_) return;
  finished_ = true;
  const FolderTurn turn(runs_, patience);
  lease_->confirm();
  hashes_.reset();
  status_.reset();
  if (!add_to_manifest(rendered_, path_, runs_, turn))
    throw Failure("is no longer the manifest of the film that was rendered", (path_ / kManifestName).string(),
                  "see that nothing else writes it, and render the film again");
  for (const RunFiles& run : runs_.runs())
    if (run.run == runs_.own_name()) remove_files(run, turn);
  lease_.reset();
  sync_folder(path_);
}

void FrameFolder::show_status(std::function<std::string()> text) {
  status_.emplace(runs_.own_file(kStatusEnding), runs_.own_file(std::string(kStatusEnding) + ".part"), std::move(text));
}

fs::path FrameFolder::file_of(std::uint32_t frame) const { return path_ / frame_file_name(rendered_, frame); }

// The hash first: should the run be killed between the two, a frame without a file is missing, but a file without a
// hash would say nothing.
void FrameFolder::put(std::uint32_t frame, const std::string& pixel_hash, std::span<const std::byte> file) {
  lease_->check();
  hashes_->add(frame, pixel_hash);
  record(frame, pixel_hash);
  const std::string part = "." + frame_file_name(rendered_, frame) + std::string(document::kPartSuffix);
  document::replace_file(file_of(frame), runs_.own_file(part), file);
}

// In memory too: at its end a run depends on nothing that it would have to read again.
void FrameFolder::record(std::uint32_t frame, const std::string& pixel_hash) {
  const std::lock_guard lock(mutex_);
  set_hash(rendered_, frame, pixel_hash);
}

void clear_ended_runs(const fs::path& folder) {
  const RunsFolder runs(folder, this_process());
  if (!runs.exists()) return;
  try {
    settle_ended_runs(folder, runs, FolderTurn(runs, kShortPatience));
  } catch (const std::exception&) {
  }
}

Manifest read_manifest(const fs::path& folder) {
  // The runs first: what one has rendered is in frames.json before it is gone from there.
  std::vector<Manifest> unfinished;
  for (const RunFiles& run : RunsFolder(folder, this_process()).runs())
    if (std::optional<Manifest> rendered = rendered_by(run)) unfinished.push_back(std::move(*rendered));
  std::optional<Manifest> manifest = read_frames_json(folder);
  if (!manifest)
    throw Failure("no folder of frames: it has no frames.json", folder.string(),
                  "name the folder that was given to mars render with -o");
  for (const Manifest& rendered : unfinished)
    if (are_of_one_folder(rendered, *manifest)) add_frames(*manifest, rendered);
  return std::move(*manifest);
}

void FileSink::take(const compositor::Frame& frame) {
  folder_.put(frame.number, pixel_hash(frame.pixels),
              images::encode_picture(folder_.format(), frame.width, frame.height, frame.pixels));
}

}  // namespace mars::sinks
