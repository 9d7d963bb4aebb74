#include "host/render/sinks/verify.h"

#include <optional>
#include <span>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/checksum.h"
#include "host/images/picture_file.h"
#include "host/render/sinks/frame_folder.h"

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
    const images::Image image = images::read_picture(manifest.format, file);
    if (image.width != manifest.width || image.height != manifest.height) {
      return size_text(image.width, image.height) + " pixels instead of " + size_text(manifest.width, manifest.height);
    }
    if (expected && expected->empty())
      return "its run ended before it recorded the pixels, or the film has changed since";
    if (expected && pixel_hash(image.pixels) != *expected) return "other pixels than were rendered";
    pixels.add(std::as_bytes(std::span(image.pixels)));
    return "";
  } catch (const Failure& failure) {
    return failure.problem;
  }
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
    const auto expected = verdict.compared ? std::optional(manifest.pixel_hashes[i]) : std::nullopt;
    const std::string reason = trouble_with(file, manifest, expected, pixels);
    if (!reason.empty()) verdict.troubles.push_back({frame, reason});
  }
  verdict.expected = static_cast<std::uint32_t>(manifest.frames.size());
  if (verdict.troubles.empty()) verdict.hash = pixels.digits();
  return verdict;
}

void remove_wrong_files(const fs::path& folder, const Verdict& verdict) {
  const Manifest manifest = read_manifest(folder);
  for (const Verdict::Trouble& trouble : verdict.troubles)
    remove_frame(folder / frame_file_name(manifest, trouble.frame));
}

}  // namespace mars::sinks
