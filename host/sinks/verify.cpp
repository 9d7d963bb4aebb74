#include "host/sinks/verify.h"

#include <span>

#include "hal/failure.h"
#include "host/sinks/checksum.h"
#include "host/sinks/frame_folder.h"
#include "host/sinks/png_file.h"

namespace mars::host {

namespace fs = std::filesystem;

namespace {

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// "" where the frame is as it should be.
std::string trouble_with(const fs::path& file, const Manifest& manifest, Checksum& pixels) {
  if (!fs::exists(file)) return "missing";
  try {
    const Image image = read_png(file);
    if (image.width != manifest.width || image.height != manifest.height) {
      return size_text(image.width, image.height) + " pixels instead of " +
             size_text(manifest.width, manifest.height);
    }
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
  Checksum pixels;
  for (const std::uint32_t frame : manifest.frames) {
    const fs::path file = folder / frame_file_name(frame, manifest.film_frames);
    const std::string reason = trouble_with(file, manifest, pixels);
    if (!reason.empty()) verdict.troubles.push_back({frame, reason});
  }
  verdict.expected = static_cast<std::uint32_t>(manifest.frames.size());
  if (verdict.troubles.empty()) verdict.hash = pixels.digits();
  return verdict;
}

}  // namespace mars::host
