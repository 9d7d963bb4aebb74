// A folder's manifest, made again where frames.json is lost or damaged: from what a run knows, from the claims in
// .runs, from film.mars, and from what the frames' files say of themselves (frame_mark.h). No frame is decoded: mars
// verify compares pixels with the hashes. What nothing says is lost: frames that were asked for and left no trace, and
// of a folder that no run knows the film's name, its sources and its options, which the next rendering writes again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "host/render/sinks/manifest.h"

namespace mars::sinks {

inline constexpr const char* kManifestName = "frames.json";
inline constexpr const char* kFilmName = "film.mars";
// Whether a folder of frames has a file of this name, or may have.
bool is_own_name(const std::string& name);

// What frames.json says is not what a run wrote.
class DamagedManifest : public Failure {
 public:
  using Failure::Failure;
};

struct Restored {
  Manifest manifest;
  // Files with frames' names that say nothing of themselves, as those of the first pixel version, or that are damaged.
  // Where no run knows them, their frames are in the manifest without a hash.
  std::uint32_t unmarked = 0;
  // Files with frames' names that say that they are others, or are empty or no files. Where no run knows what was asked
  // for, their frames are in the manifest without a hash, too.
  std::uint32_t others = 0;
};

// `known`: what the asking run knows of the folder; nullptr: nothing. None where nothing says of which film the frames
// are, or frames of several films do. Throws Failure where the folder cannot be listed.
std::optional<Restored> restore_manifest(const std::filesystem::path& folder, const Manifest* known);

// What frames.json alone says; none where there is none. Throws DamagedManifest; and Failure where it cannot be read.
std::optional<Manifest> read_frames_json(const std::filesystem::path& folder);

struct Found {
  std::optional<Manifest> manifest;  // none: the folder has no frames
  std::string repaired;              // what was wrong with frames.json, which `manifest` stands in for; "": nothing
};
// For a run: what frames.json says, or what is restored where that is lost or damaged. Throws DamagedManifest where
// files that say nothing of themselves may be frames of any film, or nothing says of which film the frames are.
Found find_manifest(const std::filesystem::path& folder, const Manifest* known = nullptr);

// What was done about a manifest's problem, for people; and what they can do.
std::string repair_text(const std::string& problem);
std::string repair_remedy(const std::filesystem::path& folder);

// Names of files that frames of `manifest` would replace, and that do not say that MARS has made them; ascending.
std::vector<std::string> others_files(const std::filesystem::path& folder, const Manifest& manifest);

// Adds hashes, to frames of `manifest` that have none, of those whose files say that they are of its very film. Returns
// whether there are frames that say that they are of other films, and none of this one.
bool add_marked_frames(const std::filesystem::path& folder, Manifest& manifest);

// A run may end before it has recorded all that its nodes have written. `manifest` is what it renders, with the hashes
// that it has recorded: adds those that the files of its other frames say, for files have frames' names only once they
// are whole. Returns how many frames have a hash and a file then. Throws Failure where the folder cannot be listed.
std::uint32_t add_unrecorded_frames(const std::filesystem::path& folder, Manifest& manifest);

}  // namespace mars::sinks
