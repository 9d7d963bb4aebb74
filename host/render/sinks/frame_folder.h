// The folder a film is rendered into: frame-0000.png (or .exr) and so on, and frames.json, the manifest that says which
// frames of which film belong there, and the hash of each one's pixels. The manifest is written first, so that a folder
// without it, or with fewer frames than it names, is known to be unfinished. From its first file to its last a run has
// a claim there (claim.h); what it alone knows meanwhile, the hashes of its frames, is in .runs (runs_folder.h).
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "host/render/sinks/claim.h"
#include "host/render/sinks/folder_turn.h"
#include "host/render/sinks/lease.h"
#include "host/render/sinks/manifest.h"
#include "host/render/sinks/process_name.h"
#include "host/render/sinks/runs_folder.h"
#include "host/render/sinks/sink.h"
#include "host/render/sinks/status_file.h"

namespace mars::sinks {

class FrameFolder {
 public:
  // Creates the folder where it is missing, adds to its manifest what ended runs have rendered and clears away what
  // else they left, claims the frames, and writes the manifest; where there is one of the same compiled film in
  // the same format, its frames belong there too. Throws Failure, and has changed nothing of others', where another
  // run's claim is in the way.
  FrameFolder(std::filesystem::path path, const Manifest& manifest, const ProcessName& self = this_process());
  // As finish(), but waits less for its turn; what then is not written, the next run or clear_ended_runs finds.
  ~FrameFolder();
  FrameFolder(const FrameFolder&) = delete;
  FrameFolder& operator=(const FrameFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  images::PictureFormat format() const { return rendered_.format; }
  std::filesystem::path file_of(std::uint32_t frame) const;

  // From now on `text` is what the run's .status says (status_file.h). Until the end a thread calls it.
  void show_status(std::function<std::string()> text);

  // Writes a frame's file; from several threads at once. Throws Failure where it cannot, or the claim is lost.
  void put(std::uint32_t frame, const std::string& pixel_hash, std::span<const std::byte> file);

  // Writes the frames' hashes to the manifest and gives up the claim. Throws Failure where it cannot, and then leaves
  // its files in .runs.
  void finish();

 private:
  void claim(const FolderTurn& turn, const Manifest& manifest);
  void finish_within(std::chrono::milliseconds patience);
  void record(std::uint32_t frame, const std::string& pixel_hash);

  std::filesystem::path path_;
  std::mutex mutex_;  // guards the hashes of rendered_
  Manifest rendered_;
  RunsFolder runs_;
  std::optional<Lease> lease_;
  std::optional<HashLog> hashes_;
  std::optional<StatusFile> status_;
  bool finished_ = false;
};

// Does for runs that have ended without it, killed, what the next run would do: their frames' hashes go to the
// manifest, and what else they left is removed. Leaves alone what cannot be written, or not soon.
void clear_ended_runs(const std::filesystem::path& folder);

// With what runs that are not finished have rendered so far. Throws Failure where there is none, or no sound one.
Manifest read_manifest(const std::filesystem::path& folder);

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
