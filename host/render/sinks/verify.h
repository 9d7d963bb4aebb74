// Looks a folder of frames over: is every frame the manifest names there, whole, of the right size, and with the pixels
// that were rendered? The hash over all pixels is the same for two renderings of one film only if all their pixels are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mars::sinks {

struct Verdict {
  struct Trouble {
    std::uint32_t frame;
    std::string reason;
  };

  std::uint32_t expected = 0;     // frames
  std::uint32_t film_frames = 0;  // of the whole film
  std::string pixels;             // what their pixels are: "8-bit sRGB"
  std::vector<Trouble> troubles;  // frames that are missing or wrong, ascending
  bool compared = true;           // with the hashes of what was rendered; no: the manifest has none
  std::string hash;               // XXH3's 128 bits over the pixels of all frames in order; "" with troubles
};

// Throws Failure where there is no folder or no manifest.
Verdict verify_folder(const std::filesystem::path& folder);

// Makes frames.json again where it is lost or damaged, and gives a line about that; "" where the manifest is sound, or
// the folder has nothing of which it could be made. Throws Failure where a run renders into the folder, or nothing says
// of which film the frames are.
std::string repair_manifest(const std::filesystem::path& folder);

// Removes the files of frames in which it found trouble, and in which there still is some. Throws Failure, and removes
// none, while a run renders into the folder.
void remove_wrong_files(const std::filesystem::path& folder, const Verdict& verdict);

}  // namespace mars::sinks
