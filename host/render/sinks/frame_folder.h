// The folder a film is rendered into: frame-0000.png (or .exr) and so on; frames.json, the manifest that says which
// frames of which film belong there, and the hash of each one's pixels; and film.mars, the compiled film. A frame is
// there if the manifest has its hash and its file is a regular one with something in it: then it is not rendered again.
// A manifest that is lost or damaged is made again by the run that notices (restore.h). From its first file to its
// last a run has a claim there (claim.h); what it alone knows meanwhile, the hashes of its frames, is in .runs
// (runs_folder.h).
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/film/compiled_film.h"
#include "host/content/document/whole_file.h"
#include "host/render/sinks/busy_time.h"
#include "host/render/sinks/claim.h"
#include "host/render/sinks/folder_turn.h"
#include "host/render/sinks/frame_encoder.h"
#include "host/render/sinks/lease.h"
#include "host/render/sinks/manifest.h"
#include "host/render/sinks/patience.h"
#include "host/render/sinks/process_name.h"
#include "host/render/sinks/restore.h"
#include "host/render/sinks/runs_folder.h"
#include "host/render/sinks/sink.h"
#include "host/render/sinks/status.h"
#include "host/render/sinks/status_file.h"
#include "host/render/sinks/unseen_rivals.h"
#include "host/render/sinks/writer_orders.h"

namespace mars::sinks {

// What a run makes of a folder of frames, decided in its turn: the manifest of the frames that stay, with their hashes,
// in the form of the film that is rendered now; that film, where film.mars is not it yet; and why the run may not go on
// so, which is thrown where no other run is in the way.
struct Continuation {
  Manifest manifest;
  const film::CompiledFilm* new_film = nullptr;
  std::optional<Failure> refusal = {};
  bool renders = true;  // no: the run claims no frame, and leaves manifest and film for others
};
// `there`: the folder's manifest, none where it has none. What it throws ends the run's claim.
using Continue = std::function<Continuation(const std::optional<Manifest>& there)>;

// Frames of the same compiled film in the same format stay, others do not.
Continue keep_same_film(const Manifest& wanted);

// Of frames that a run has rendered or found, somebody has removed some before the run ended.
class LostFrames : public Failure {
 public:
  LostFrames(const std::vector<std::uint32_t>& lost, const std::filesystem::path& folder);

  std::uint32_t frames;
};

// A frame's file is missing or torn, where it is needed.
class DamagedFrame : public Failure {
 public:
  using Failure::Failure;
};

class FrameFolder {
 public:
  // Creates the folder where it is missing, adds to its manifest what ended runs have rendered and clears away what
  // else they left, decides by `go_on` which frames stay, claims those of `wanted` that are not there, removes files
  // under their names, and writes the manifest and film.mars. Throws Failure, and has changed nothing of others', where
  // another run's claim is in the way. What cannot be written for a while is waited for as `bounds` say, here and
  // later; `bounds.warn` also reports a wait until it is known whether a run still lives.
  FrameFolder(std::filesystem::path path, const Manifest& wanted, const Continue& go_on, Patience::Bounds bounds = {},
              const ProcessName& self = this_process());
  FrameFolder(std::filesystem::path path, const Manifest& wanted, const ProcessName& self = this_process(),
              Patience::Bounds bounds = {})
      : FrameFolder(std::move(path), wanted, keep_same_film(wanted), std::move(bounds), self) {}
  // As finish(), but waits less for its turn, and not at all where nodes may still write files; what then is not
  // written, the next run or clear_ended_runs finds.
  ~FrameFolder();
  FrameFolder(const FrameFolder&) = delete;
  FrameFolder& operator=(const FrameFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // The run's name, under which it has its claim.
  const std::string& run() const { return runs_.own_name(); }
  images::PictureFormat format() const { return rendered_.format; }
  images::PictureBands bands() const { return bands_of(rendered_); }
  std::filesystem::path file_of(std::uint32_t frame) const;
  // Those asked for that are not there: this run is to write them.
  const std::vector<std::uint32_t>& frames() const { return rendered_.frames; }

  // From now on `status` is what the run's .status says (status_file.h), beside what the folder itself counts; and what
  // the run has used goes to the manifest with its frames. Until the end a thread calls it.
  void show_status(std::function<Status()> status);
  // More that was used for the run's frames: bytes of files that nodes wrote, faces that it joins. From any thread.
  void note_used(const Usage& used);
  // All runs of the folder together, once this one is finished.
  Usage whole_usage() const { return whole_usage_.value_or(Usage()); }

  // What the frame's file says (frame_mark.h).
  images::FileFacts facts_of(std::uint32_t frame, const std::string& pixel_hash, const std::string& content) const;
  // Writes a frame's file; from several threads at once. Throws Failure where it cannot, the claim is lost, or the
  // folder is gone.
  void put(std::uint32_t frame, const std::string& pixel_hash, const document::Pieces& file);

  // Where nodes write frames' files: their orders; a file by which they see that they have the same folder, and
  // whether theirs, of a machine's first node, comes. A frame's file is there; throws Failure where the claim is lost.
  WriterOrders writer_orders() const;
  void add_probe();
  bool sees_probe_of(std::int32_t node) const;
  void note_written(std::uint32_t frame, const std::string& pixel_hash);
  // As note_written(), which threw FileFailure; waits until storage takes it, as `bounds` say.
  void wait_to_note_written(std::uint32_t frame, const std::string& pixel_hash);
  // Throws Failure where the folder or the claim is gone: then nodes cannot write either.
  void confirm_claim();

  // Writes the frames' hashes to the manifest and gives up the claim; also film.mars where that is not `film`, the one
  // that was rendered, any more. Throws Failure where it cannot, and then leaves its files in .runs.
  void finish(const film::CompiledFilm* film = nullptr);

  // As Patience says.
  void check() { patience_.check(); }
  void give_up() { patience_.give_up(); }

 private:
  bool try_to_enter(const Manifest& wanted, const Continue& go_on, UnseenRivals& unseen);
  bool enter(const FolderTurn& turn, const Manifest& wanted, const Continue& go_on, UnseenRivals& unseen);
  bool must_wait(const FolderTurn& turn, bool another_film, UnseenRivals& unseen) const;
  void write_film(const film::CompiledFilm& film, const FolderTurn& turn) const;
  void claim();
  void give_back_claim();
  void remove_frames(const std::vector<std::uint32_t>& frames) const;
  void finish_within(std::chrono::milliseconds patience, const film::CompiledFilm* film = nullptr);
  void refuse_lost_frames() const;
  void record(std::uint32_t frame, const std::string& pixel_hash);
  Status status_now();
  Usage own_usage();
  Manifest known() const;

  std::filesystem::path path_;
  const Warn warn_;
  Patience patience_;
  std::mutex mutex_;  // guards used_ and the hashes of rendered_
  Manifest rendered_;
  Manifest begun_;                     // the folder's when the run began
  std::vector<std::uint32_t> wanted_;  // frames, also those that were there
  RunsFolder runs_;
  std::optional<Lease> lease_;
  std::optional<HashLog> hashes_;
  Usage used_;                        // beside what the status has
  std::function<Status()> shown_;     // none: the run shows no status
  std::optional<Usage> whole_usage_;  // once this run's is in the manifest
  std::optional<StatusFile> status_;
  bool nodes_write_ = false;
  bool finished_ = false;
};

// Does for runs that have ended without it, killed, what the next run would do: their frames' hashes go to the
// manifest, also those of frames whose files were not recorded yet, and what else they left is removed. Leaves alone
// what cannot be written, or not soon. `ended`: a run that the caller knows to have ended, on whichever machine; "":
// none. Returns how many frames that run has rendered; 0: it did not leave word of any.
std::uint32_t clear_ended_runs(const std::filesystem::path& folder, const std::string& ended = "");

// Whether files there say that they are frames.
bool has_frames(const std::filesystem::path& folder);

// Removes the folder with its frames, and with what runs have left there that were killed. False, and all stays, where
// somebody renders there, or has put something else there, as a job of Slurm its output, or where frames.json cannot be
// read.
bool remove_folder(const std::filesystem::path& folder);

// With what runs that are not finished have rendered so far. Throws Failure where there is none, or no sound one.
Manifest read_manifest(const std::filesystem::path& folder);
// Those of `frames` that are not there: `manifest` has no hash of theirs, or the folder no file with something in it.
std::vector<std::uint32_t> missing_frames(const std::filesystem::path& folder, const Manifest& manifest,
                                          const std::vector<std::uint32_t>& frames);

// What has the name of a file to come, where something has it: a file, a link, a pipe, a device, an empty folder. Opens
// nothing.
void clear_name(const std::filesystem::path& file);

// In the folder's turn, which `runs` has.
void write_manifest(const Manifest& manifest, const std::filesystem::path& folder, const RunsFolder& runs);

// Writes every frame as a file of the folder.
class FileSink : public Sink {
 public:
  // The checksum of what decides a frame's pixels (frame_content.h); from several threads at once.
  using ContentOf = std::function<std::string(std::uint32_t frame)>;

  // `folder` must outlive the sink. `content`: none where it is not known.
  // `film`: of frames with layers.
  explicit FileSink(FrameFolder& folder, ContentOf content = {}, FrameEncoder::Encode encode = encode_band,
                    const wire::PackedFilm* film = nullptr);
  void take(compositor::Frame& frame) override;
  bool restores() const override { return true; }
  images::FileWork made() const override;
  void check() override { folder_.check(); }
  void give_up() override { folder_.give_up(); }

 private:
  FrameFolder& folder_;
  const ContentOf content_;
  FrameEncoder encoder_;
  mutable std::mutex mutex_;  // guards what follows
  images::FileWork made_;     // but for storing_seconds
  BusyTime storing_;
};

}  // namespace mars::sinks
