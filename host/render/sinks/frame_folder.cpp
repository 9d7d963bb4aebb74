#include "host/render/sinks/frame_folder.h"

#include <fcntl.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/film_file.h"
#include "host/content/film/frame_set.h"
#include "host/images/picture_file.h"
#include "host/render/sinks/claim.h"
#include "host/render/sinks/frame_mark.h"
#include "host/render/sinks/record.h"

namespace mars::sinks {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::chrono::seconds kShortPatience{2};  // of a run that fails: a person waits to learn why

void create_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) document::fail_file("create the folder", path, error.value());
  if (!fs::is_directory(path, error)) document::fail_file("create the folder", path, ENOTDIR);
}

// What the try before left where nothing could be changed. That it still cannot be removed is why this one fails.
void remove_part(const fs::path& part) {
  if (unlink(part.c_str()) != 0 && errno != ENOENT) document::fail_file("write", part, errno);
}

// Returns what all runs have used; none, and nothing is added, where the manifest is of another film or format.
// `known`: what the run knows of the folder, which stands in for a manifest that is lost or damaged.
std::optional<Usage> add_to_manifest(const Manifest& rendered, const Usage& used, const Manifest& known,
                                     const fs::path& folder, const RunsFolder& runs, const FolderTurn& turn,
                                     const Warn& warn = {}) {
  Found found = find_manifest(folder, &known);
  turn.confirm();
  Manifest& all = *found.manifest;
  if (!are_of_one_folder(all, rendered)) return std::nullopt;
  add_frames(all, rendered);
  all.usage += used;
  write_manifest(all, folder, runs);
  if (warn && !found.repaired.empty()) warn(repair_text(found.repaired));
  return all.usage;
}

bool is_whole(const Manifest& rendered) { return std::ranges::none_of(rendered.pixel_hashes, &std::string::empty); }

// Nothing of a run that has left no status.
Usage usage_of(const RunFiles& run, const Manifest& rendered) {
  const std::optional<Status> status = status_of(run);
  if (!status) return {};
  Usage used = status->used;
  if (!is_whole(rendered)) ++used.restarts;
  return used;
}

// Also makes room on a full disk for the manifest.
void remove_parts(const RunFiles& run) {
  std::error_code ignored;  // what stays is found by the next run
  for (const fs::path& file : run.files)
    if (file.extension() == document::kPartSuffix) fs::remove(file, ignored);
}

// The claim last, so that whatever is left of a run is known to be its.
void remove_files(const RunFiles& run, const FolderTurn& turn) {
  std::error_code ignored;
  for (const bool claims : {false, true})
    for (const fs::path& file : run.files)
      if ((file.extension() == kClaimEnding) == claims && file != turn.file()) fs::remove(file, ignored);
}

// Returns how many frames the run `ended` has rendered.
std::uint32_t settle_ended_runs(const fs::path& folder, const RunsFolder& runs, const FolderTurn& turn,
                                const std::string& ended = "") {
  std::uint32_t of_ended = 0;
  for (const RunFiles& run : runs.runs()) {
    if (run.run == runs.own_name() || (run.run != ended && !turn.has_ended(run))) continue;
    remove_parts(run);
    if (std::optional<Manifest> rendered = rendered_by(run)) {
      const std::uint32_t there = add_unrecorded_frames(folder, *rendered);
      const Usage used = usage_of(run, *rendered);
      if (add_to_manifest(*rendered, used, *rendered, folder, runs, turn) && run.run == ended) of_ended = there;
    }
    remove_files(run, turn);
  }
  return of_ended;
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; entry != end; entry.increment(error))
    names.insert(entry->path().filename().string());
  if (error) document::fail_file("list the folder", folder, error.value());
  return names;
}

// Why nothing can be written there any more, if that is so.
void refuse_gone(const fs::path& folder) {
  std::error_code none;
  if (fs::status(folder, none).type() == fs::file_type::not_found)
    throw Failure("the folder was removed or renamed while frames were rendered into it", folder.string(),
                  "the same command renders into a new one, or goes on once the folder has its name again");
}

// Names that were made in the folder are on the disk too; not every file system can do that.
void sync_folder(const fs::path& folder) {
  const int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  fsync(opened);
  close(opened);
}

}  // namespace

void write_manifest(const Manifest& manifest, const fs::path& folder, const RunsFolder& runs) {
  const std::string text = to_json(manifest).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
  const fs::path part = runs.own_file(".frames.json.part");
  remove_part(part);
  document::replace_file(folder / kManifestName, part, std::as_bytes(std::span(text)));
}

std::vector<std::uint32_t> missing_frames(const fs::path& folder, const Manifest& manifest,
                                          const std::vector<std::uint32_t>& frames) {
  std::vector<std::uint32_t> missing;
  for (const std::uint32_t frame : frames)
    if (hash_of(manifest, frame).empty() || !is_frame_file(folder / frame_file_name(manifest, frame)))
      missing.push_back(frame);
  return missing;
}

void clear_name(const fs::path& file) {
  if (unlink(file.c_str()) == 0 || errno == ENOENT) return;
  if (errno == EISDIR && rmdir(file.c_str()) == 0) return;
  document::fail_file("remove", file, errno);
}

Continue keep_same_film(const Manifest& wanted) {
  return [wanted](const std::optional<Manifest>& there) {
    return Continuation{there && are_of_one_folder(*there, wanted) ? *there : wanted};
  };
}

FrameFolder::FrameFolder(fs::path path, const Manifest& wanted, const Continue& go_on, Patience::Bounds bounds,
                         const ProcessName& self)
    : path_(std::move(path)),
      warn_(bounds.warn),
      patience_(bounds),
      rendered_(wanted),
      wanted_(wanted.frames),
      runs_(path_, self) {
  UnseenRivals unseen(bounds.warn);
  patience_.begin(path_, [&] {
    create_folder(path_);
    while (!try_to_enter(wanted, go_on, unseen)) std::this_thread::sleep_for(std::chrono::seconds(1));
  });
}

bool FrameFolder::try_to_enter(const Manifest& wanted, const Continue& go_on, UnseenRivals& unseen) {
  const FolderTurn turn(runs_, FolderTurn::kPatience, [this] { patience_.note_answer(); });
  try {
    return enter(turn, wanted, go_on, unseen);
  } catch (...) {
    give_back_claim();
    throw;
  }
}

void FrameFolder::give_back_claim() {
  hashes_.reset();
  lease_.reset();
  runs_.remove_own_files();
}

// False, and nothing is claimed, where it depends on a run that may have ended.
bool FrameFolder::enter(const FolderTurn& turn, const Manifest& wanted, const Continue& go_on, UnseenRivals& unseen) {
  settle_ended_runs(path_, runs_, turn);
  turn.confirm();
  const auto [there, repaired] = find_manifest(path_);
  auto [all, new_film, refusal, renders] = go_on(there);
  add_frames(all, wanted);
  begun_ = rendered_ = all;
  const std::vector<std::uint32_t> missing = missing_frames(path_, all, wanted.frames);
  rendered_.frames = renders ? missing : std::vector<std::uint32_t>();
  rendered_.pixel_hashes.assign(rendered_.frames.size(), "");
  if (must_wait(turn, !there || !are_of_one_folder(*there, all), unseen)) return false;
  if (refusal && !missing.empty()) throw *refusal;
  if (rendered_.frames.empty())
    finished_ = true;
  else
    claim();
  if (there != all || !repaired.empty()) write_manifest(all, path_, runs_);
  if (warn_ && !repaired.empty()) warn_(repair_text(repaired));
  if (new_film != nullptr) write_film(*new_film, turn);
  return true;
}

// Whether a run in the way may have ended. Throws Failure where one is that lives. Where this run renders nothing, and
// the folder's frames stay those of one film, others do not mind it.
bool FrameFolder::must_wait(const FolderTurn& turn, bool another_film, UnseenRivals& unseen) const {
  bool wait = false;
  if (rendered_.frames.empty() && !another_film) return false;
  for (const RunFiles& run : runs_.runs()) {
    if (!has_claim(run) || turn.has_ended(run)) continue;
    const std::optional<Failure> conflict = conflict_with(run, rendered_, path_);
    if (!conflict) continue;
    if (!unseen.may_have_ended(run, turn, conflict->problem)) throw *conflict;
    wait = true;
  }
  return wait;
}

// That may take long: the turn stays this run's meanwhile.
void FrameFolder::write_film(const film::CompiledFilm& film, const FolderTurn& turn) const {
  const Lease held(turn.file());
  std::error_code none;
  if (!fs::is_regular_file(fs::symlink_status(path_ / kFilmName, none))) clear_name(path_ / kFilmName);
  film::save_film(film, path_ / kFilmName, runs_.own_file(".film.mars.part"));
  sync_folder(path_);
}

void FrameFolder::claim() {
  Manifest claimed = rendered_;
  claimed.pixel_hashes.clear();
  claimed.usage = {};
  const std::string text = text_of(Claim{runs_.self(), time(nullptr), claimed});
  document::replace_file(runs_.own_file(kClaimEnding), runs_.own_file(".claim.part"), std::as_bytes(std::span(text)));
  lease_.emplace(runs_.own_file(kClaimEnding));
  hashes_.emplace(runs_.own_file(kHashesEnding));
  remove_frames(rendered_.frames);
}

// What other runs left under the names to come would pass as this one's if it were interrupted between a frame's hash
// and its file; also where the machine loses its power then.
void FrameFolder::remove_frames(const std::vector<std::uint32_t>& frames) const {
  const std::set<std::string> names = names_in(path_);
  bool removed = false;
  for (const std::uint32_t frame : frames) {
    if (!names.contains(frame_file_name(rendered_, frame))) continue;
    clear_name(file_of(frame));
    removed = true;
  }
  if (removed) sync_folder(path_);
}

LostFrames::LostFrames(const std::vector<std::uint32_t>& lost, const fs::path& folder)
    : Failure("frames that were rendered are gone: " + film::FrameSet(lost).text(), folder.string(),
              "the same command renders them again"),
      frames(static_cast<std::uint32_t>(lost.size())) {}

FrameFolder::~FrameFolder() {
  if (finished_ || nodes_write_) return;
  try {
    finish_within(kShortPatience);
  } catch (const std::exception&) {
  }
}

void FrameFolder::finish(const film::CompiledFilm* film) {
  if (std::exchange(finished_, true)) return;
  try {
    patience_.write(path_ / kManifestName, [&] { finish_within(FolderTurn::kPatience, film); });
  } catch (const Failure&) {
    refuse_gone(path_);
    throw;
  }
  refuse_lost_frames();
}

void FrameFolder::finish_within(std::chrono::milliseconds patience, const film::CompiledFilm* film) {
  const FolderTurn turn(runs_, patience, [this] { patience_.note_answer(); });
  lease_->confirm();
  hashes_.reset();
  const Usage used = whole_usage_ ? Usage() : own_usage();
  status_.reset();
  const std::optional<Usage> whole = add_to_manifest(rendered_, used, known(), path_, runs_, turn, warn_);
  if (!whole)
    throw Failure("is no longer the manifest of the film that was rendered", (path_ / kManifestName).string(),
                  "see that nothing else writes it, and render the film again");
  whole_usage_ = whole;
  if (film != nullptr && !film::is_saved(*film, path_ / kFilmName)) {
    write_film(*film, turn);
    if (warn_) warn_(std::string(kFilmName) + " was lost or damaged: it is written again");
  }
  for (const RunFiles& run : runs_.runs())
    if (run.run == runs_.own_name()) remove_files(run, turn);
  lease_.reset();
  sync_folder(path_);
}

// Of what this run wrote or found, somebody may have removed files meanwhile.
void FrameFolder::refuse_lost_frames() const {
  const Manifest all = known();
  std::vector<std::uint32_t> lost;
  for (const std::uint32_t frame : missing_frames(path_, all, wanted_))
    if (!hash_of(all, frame).empty()) lost.push_back(frame);
  if (!lost.empty()) throw LostFrames(lost, path_);
}

// All that stands in for a manifest that is lost.
Manifest FrameFolder::known() const {
  Manifest known = begun_;
  known.pixel_hashes.resize(known.frames.size());
  add_frames(known, rendered_);
  return known;
}

images::FileFacts FrameFolder::facts_of(std::uint32_t frame, const std::string& pixel_hash,
                                        const std::string& content) const {
  return facts_in(begun_, frame, pixel_hash, content);
}

void FrameFolder::show_status(std::function<Status()> status) {
  shown_ = std::move(status);
  status_.emplace(runs_.own_file(kStatusEnding), runs_.own_file(std::string(kStatusEnding) + ".part"),
                  [this] { return text_of(status_now()); });
}

void FrameFolder::note_used(const Usage& used) {
  const std::lock_guard lock(mutex_);
  used_ += used;
}

Status FrameFolder::status_now() {
  Status now = shown_ ? shown_() : Status();
  const std::lock_guard lock(mutex_);
  now.used += used_;
  return now;
}

Usage FrameFolder::own_usage() {
  Usage used = status_now().used;
  if (!shown_ && used.processor_seconds == 0) return {};  // nobody counts
  if (!is_whole(rendered_)) ++used.restarts;
  return used;
}

fs::path FrameFolder::file_of(std::uint32_t frame) const { return path_ / frame_file_name(rendered_, frame); }

// The hash first: should the run be killed between the two, a frame without a file is missing, but a file without a
// hash would say nothing.
void FrameFolder::put(std::uint32_t frame, const std::string& pixel_hash, const document::Pieces& file) try {
  const fs::path part = runs_.own_file("." + frame_file_name(rendered_, frame) + std::string(document::kPartSuffix));
  bool recorded = false;
  patience_.write(file_of(frame), [&] {
    lease_->check();
    if (recorded) remove_part(part);
    if (!recorded) hashes_->add(frame, pixel_hash);
    if (!recorded) record(frame, pixel_hash);
    recorded = true;
    document::replace_file(file_of(frame), part, file);
  });
  Usage written;
  for (const std::span<const std::byte> piece : file) written.bytes += piece.size();
  note_used(written);
} catch (const Failure&) {
  refuse_gone(path_);
  lease_->confirm();
  throw;
}

WriterOrders FrameFolder::writer_orders() const {
  Manifest manifest = begun_;
  manifest.frames.clear();
  manifest.pixel_hashes.clear();
  return {fs::absolute(path_), fs::absolute(runs_.own_file("")), manifest};
}

void FrameFolder::add_probe() {
  nodes_write_ = true;
  document::create_file(writer_orders().host_probe(), "");
}

bool FrameFolder::sees_probe_of(std::int32_t node) const { return appears(writer_orders().node_probe(node)); }

void FrameFolder::confirm_claim() {
  refuse_gone(path_);
  lease_->confirm();
}

void FrameFolder::note_written(std::uint32_t frame, const std::string& pixel_hash) {
  lease_->check();
  hashes_->add(frame, pixel_hash);
  record(frame, pixel_hash);
}

void FrameFolder::wait_to_note_written(std::uint32_t frame, const std::string& pixel_hash) {
  patience_.write(runs_.own_file(kHashesEnding), [&] { note_written(frame, pixel_hash); });
}

// In memory too: at its end a run depends on nothing that it would have to read again.
void FrameFolder::record(std::uint32_t frame, const std::string& pixel_hash) {
  const std::lock_guard lock(mutex_);
  set_hash(rendered_, frame, pixel_hash);
}

std::uint32_t clear_ended_runs(const fs::path& folder, const std::string& ended) {
  const RunsFolder runs(folder, this_process());
  if (!runs.exists()) return 0;
  try {
    return settle_ended_runs(folder, runs, FolderTurn(runs, kShortPatience), ended);
  } catch (const std::exception&) {
    return 0;
  }
}

bool has_frames(const fs::path& folder) {
  std::error_code none;
  for (fs::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none)) {
    const fs::path& path = entry->path();
    if (!images::is_picture_name(path) || !is_frame_file(path)) continue;
    const std::optional<FrameMark> mark = read_mark(path);
    if (mark && is_named_as_frame(path.filename().string(), mark)) return true;
  }
  return false;
}

bool remove_folder(const fs::path& folder) {
  clear_ended_runs(folder);
  std::error_code none;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none))
    files.push_back(entry->path());
  std::optional<Manifest> manifest;
  try {
    manifest = read_frames_json(folder);
  } catch (const DamagedManifest&) {  // frames that have names of MARS's choice are known without it
  } catch (const Failure&) {
    return false;
  }
  for (const fs::path& file : files) {
    const std::string name = file.filename().string();
    const bool own = is_own_name(name) || (manifest && frame_of_file(*manifest, name));
    if (!own || name == kRunsName) return false;
  }
  // Frames first, then the manifest, which names them, then the film: where this process is killed meanwhile, the next
  // one finds a folder with which it can go on, also with another film.
  const auto place = [](const fs::path& file) {
    return file.filename() == kFilmName ? 2 : file.filename() == kManifestName ? 1 : 0;
  };
  std::ranges::stable_sort(files, {}, place);
  for (const fs::path& file : files) fs::remove(file, none);
  return fs::remove(folder, none);
}

Manifest read_manifest(const fs::path& folder) {
  // The runs first: what one has rendered is in frames.json before it is gone from there.
  std::vector<Manifest> unfinished;
  for (const RunFiles& run : RunsFolder(folder, this_process()).runs())
    if (std::optional<Manifest> rendered = rendered_by(run)) {
      add_unrecorded_frames(folder, *rendered);
      unfinished.push_back(std::move(*rendered));
    }
  std::optional<Manifest> manifest = read_frames_json(folder);
  std::error_code none;
  if (!manifest && (fs::exists(folder / kFilmName, none) || has_frames(folder)))
    throw Failure("it has frames or a film.mars, but no frames.json any more", folder.string(), repair_remedy(folder));
  if (!manifest)
    throw Failure("no folder of frames: it has no frames.json", folder.string(),
                  "name the folder that was given to mars render with -o");
  for (const Manifest& rendered : unfinished)
    if (are_of_one_folder(rendered, *manifest)) add_frames(*manifest, rendered);
  return std::move(*manifest);
}

namespace {

images::PictureBands bands_for(const FrameFolder& folder, const wire::PackedFilm* film) {
  images::PictureBands bands = folder.bands();
  if (film != nullptr) bands.set_film(*film);
  return bands;
}

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

FileSink::FileSink(FrameFolder& folder, ContentOf content, FrameEncoder::Encode encode, const wire::PackedFilm* film)
    : folder_(folder), content_(std::move(content)), encoder_(bands_for(folder, film), std::move(encode)) {}

void FileSink::take(compositor::Frame& frame) {
  const double begun = seconds_now();
  const EncodedFrame encoded = encoder_.encode(frame);
  const std::string hash = encoded.pixel_hash();
  const std::string content = content_ ? content_(frame.number) : "";
  const images::PictureEnds ends = encoder_.ends_of(encoded, folder_.facts_of(frame.number, hash, content));
  const std::vector<std::span<const std::byte>> pieces = encoder_.pieces(encoded, ends);
  const double made = seconds_now();
  folder_.put(frame.number, hash, pieces);
  const std::lock_guard lock(mutex_);
  ++made_.files;
  made_.encoded_bytes += encoded.encoded_bytes;
  for (const std::span<const std::byte> piece : pieces) made_.file_bytes += piece.size();
  made_.making_seconds += made - begun;
  storing_.add(made, seconds_now());
}

images::FileWork FileSink::made() const {
  const std::lock_guard lock(mutex_);
  images::FileWork made = made_;
  made.storing_seconds = storing_.seconds();
  return made;
}

}  // namespace mars::sinks
