// The folder a film is rendered into: frame-0000.png (or .exr) and so on; frames.json, the manifest that says which
// frames of which film belong there, and the hash of each one's pixels; and film.mars, the compiled film. A frame is
// there if the manifest has its hash and its file exists: then it is not rendered again. From its first file to its
// last a run has a claim there (claim.h); what it alone knows meanwhile, the hashes of its frames, is in .runs
// (runs_folder.h).
#pragma once

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
#include "host/render/sinks/claim.h"
#include "host/render/sinks/folder_turn.h"
#include "host/render/sinks/lease.h"
#include "host/render/sinks/manifest.h"
#include "host/render/sinks/process_name.h"
#include "host/render/sinks/runs_folder.h"
#include "host/render/sinks/sink.h"
#include "host/render/sinks/unseen_rivals.h"

namespace mars::sinks {

inline constexpr const char* kFilmName = "film.mars";

// What a run makes of a folder of frames, decided in its turn: the manifest of the frames that stay, with their hashes,
// in the form of the film that is rendered now; that film, where film.mars is not it yet; and why the run may not go on
// so, which is thrown where no other run is in the way.
struct Continuation {
  Manifest manifest;
  const film::CompiledFilm* new_film = nullptr;
  std::optional<Failure> refusal = {};
};
// `there`: the folder's manifest, none where it has none. What it throws ends the run's claim.
using Continue = std::function<Continuation(const std::optional<Manifest>& there)>;

// Frames of the same compiled film in the same format stay, others do not.
Continue keep_same_film(const Manifest& wanted);

class FrameFolder {
 public:
  // Creates the folder where it is missing, adds to its manifest what ended runs have rendered and clears away what
  // else they left, decides by `go_on` which frames stay, claims those of `wanted` that are not there, removes files
  // under their names, and writes the manifest and film.mars. Throws Failure, and has changed nothing of others', where
  // another run's claim is in the way; `warn` learns that it is waited for whether a run still lives.
  FrameFolder(std::filesystem::path path, const Manifest& wanted, const Continue& go_on, const Warn& warn = {},
              const ProcessName& self = this_process());
  FrameFolder(std::filesystem::path path, const Manifest& wanted, const ProcessName& self = this_process())
      : FrameFolder(std::move(path), wanted, keep_same_film(wanted), {}, self) {}
  // As finish(), but waits less for its turn; what then is not written, the next run or clear_ended_runs finds.
  ~FrameFolder();
  FrameFolder(const FrameFolder&) = delete;
  FrameFolder& operator=(const FrameFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  images::PictureFormat format() const { return rendered_.format; }
  std::filesystem::path file_of(std::uint32_t frame) const;
  // Those asked for that are not there: this run is to write them.
  const std::vector<std::uint32_t>& frames() const { return rendered_.frames; }

  // Writes a frame's file; from several threads at once. Throws Failure where it cannot, or the claim is lost.
  void put(std::uint32_t frame, const std::string& pixel_hash, std::span<const std::byte> file);

  // Writes the frames' hashes to the manifest and gives up the claim. Throws Failure where it cannot, and then leaves
  // its files in .runs.
  void finish();

 private:
  bool enter(const FolderTurn& turn, const Manifest& wanted, const Continue& go_on, UnseenRivals& unseen);
  bool must_wait(const FolderTurn& turn, bool another_film, UnseenRivals& unseen) const;
  void write_film(const film::CompiledFilm& film, const FolderTurn& turn) const;
  void claim();
  void remove_frames(const std::vector<std::uint32_t>& frames) const;
  void finish_within(std::chrono::milliseconds patience);
  void record(std::uint32_t frame, const std::string& pixel_hash);

  std::filesystem::path path_;
  std::mutex mutex_;  // guards the hashes of rendered_
  Manifest rendered_;
  RunsFolder runs_;
  std::optional<Lease> lease_;
  std::optional<HashLog> hashes_;
  bool finished_ = false;
};

// Does for runs that have ended without it, killed, what the next run would do: their frames' hashes go to the
// manifest, and what else they left is removed. Leaves alone what cannot be written, or not soon.
void clear_ended_runs(const std::filesystem::path& folder);

// With what runs that are not finished have rendered so far. Throws Failure where there is none, or no sound one.
Manifest read_manifest(const std::filesystem::path& folder);
// What frames.json alone says; none where there is none. Throws Failure where it cannot be read or is not sound: then
// it is unknown which frames belong into the folder, and no run may decide that none do.
std::optional<Manifest> read_frames_json(const std::filesystem::path& folder);

// Those of `frames` that are not there: `manifest` has no hash of theirs, or the folder no file.
std::vector<std::uint32_t> missing_frames(const std::filesystem::path& folder, const Manifest& manifest,
                                          const std::vector<std::uint32_t>& frames);

// Writes every frame as a file of the folder.
class FileSink : public Sink {
 public:
  // `folder` must outlive the sink.
  explicit FileSink(FrameFolder& folder) : folder_(folder) {}
  void take(const compositor::Frame& frame) override;

 private:
  FrameFolder& folder_;
};

}  // namespace mars::sinks
