#include "host/render/sinks/verify.h"

#include <optional>
#include <span>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/checksum.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/images/picture_file.h"
#include "host/render/sinks/claim.h"
#include "host/render/sinks/folder_turn.h"
#include "host/render/sinks/frame_folder.h"
#include "host/render/sinks/pixel_hash.h"

namespace mars::sinks {

namespace fs = std::filesystem;

namespace {

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// "" where the frame is as it should be. `expected`: the hash of its pixels; none where nobody recorded any.
std::string trouble_with(const fs::path& file, const Manifest& manifest, const std::optional<std::string>& expected,
                         document::Checksum& pixels) {
  std::error_code none;
  if (fs::status(file, none).type() == fs::file_type::not_found) return "missing";
  try {
    const images::Image image = images::read_picture(manifest.format, file, manifest.layers);
    if (image.width != manifest.width || image.height != manifest.height) {
      return size_text(image.width, image.height) + " pixels instead of " + size_text(manifest.width, manifest.height);
    }
    if (expected && expected->empty())
      return "its run ended before it recorded the pixels, or the film has changed since";
    if (expected && pixel_hash_like(*expected, bands_of(manifest), image.pixels) != *expected)
      return "other pixels than were rendered";
    pixels.add(std::as_bytes(std::span(image.pixels)));
    return "";
  } catch (const Failure& failure) {
    return failure.problem;
  }
}

// None where nobody recorded any; "" where this frame's is not known.
std::optional<std::string> expected_hash(const Manifest& manifest, std::uint32_t frame) {
  return manifest.pixel_hashes.empty() ? std::nullopt : std::optional(hash_of(manifest, frame));
}

// What it writes now is not wrong.
void refuse_living_runs(const RunsFolder& runs, const FolderTurn& turn, const fs::path& folder) {
  for (const RunFiles& run : runs.runs()) {
    if (!has_claim(run) || turn.has_ended(run)) continue;
    const ProcessName process = process_of(run);
    throw Failure("another run, process " + std::to_string(process.number) + " on host " + process.host +
                      ", renders into this folder",
                  folder.string(), "repair it when that run has ended");
  }
}

std::string frames_text(const Restored& restored) {
  std::string text = document::counted(restored.manifest.frames.size(), "frame");
  if (restored.unmarked > 0)
    text += ", of which " + std::to_string(restored.unmarked) +
            " say nothing of themselves, as of an older MARS: they are rendered again";
  if (restored.others > 0)
    text += ", of which " + std::to_string(restored.others) + " are of another film, or empty: they are rendered again";
  return text;
}

}  // namespace

Verdict verify_folder(const fs::path& folder) {
  const Manifest manifest = read_manifest(folder);
  Verdict verdict;
  verdict.pixels = images::facts_of(manifest.format).pixels_text;
  verdict.compared = !manifest.pixel_hashes.empty();
  document::Checksum pixels;
  for (std::size_t i = 0; i < manifest.frames.size(); ++i) {
    const std::uint32_t frame = manifest.frames[i];
    const fs::path file = folder / frame_file_name(manifest, frame);
    const std::string reason = trouble_with(file, manifest, expected_hash(manifest, frame), pixels);
    if (!reason.empty()) verdict.troubles.push_back({frame, reason});
  }
  verdict.expected = static_cast<std::uint32_t>(manifest.frames.size());
  verdict.film_frames = manifest.film_frames;
  if (verdict.troubles.empty()) verdict.hash = pixels.digits();
  return verdict;
}

std::string repair_manifest(const fs::path& folder) {
  std::optional<DamagedManifest> damaged;
  std::error_code none;
  if (!fs::is_directory(folder, none)) return "";
  try {
    if (read_frames_json(folder)) return "";
  } catch (const DamagedManifest& failure) {
    damaged = failure;
  }
  const RunsFolder runs(folder, this_process());
  const FolderTurn turn(runs);
  refuse_living_runs(runs, turn, folder);
  const std::optional<Restored> restored = restore_manifest(folder, nullptr);
  turn.confirm();
  if (restored && !restored->manifest.frames.empty()) {
    write_manifest(restored->manifest, folder, runs);
    return repair_text(damaged ? damaged->problem : "it is gone") + ": " + frames_text(*restored);
  }
  if (!damaged && !restored && has_frames(folder))
    throw Failure(
        "its frames are of several films or damaged, and neither frames.json nor film.mars says which belongs there",
        folder.string(),
        "render that film again with -o " + document::shell_word(folder.string()) +
            ": its frames stay, and the others are replaced");
  if (!damaged) return "";
  throw Failure(damaged->problem + "; and neither film.mars nor the frames say of which film these are", damaged->where,
                "remove it, and render all frames of the folder again");
}

void remove_wrong_files(const fs::path& folder, const Verdict& verdict) {
  const RunsFolder runs(folder, this_process());
  const FolderTurn turn(runs);
  refuse_living_runs(runs, turn, folder);
  const Manifest manifest = read_manifest(folder);
  document::Checksum pixels;
  for (const Verdict::Trouble& trouble : verdict.troubles) {
    const fs::path file = folder / frame_file_name(manifest, trouble.frame);
    if (!trouble_with(file, manifest, expected_hash(manifest, trouble.frame), pixels).empty()) clear_name(file);
  }
}

}  // namespace mars::sinks
