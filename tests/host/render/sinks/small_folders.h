// Folders of frames for tests: small films, each frame of one colour.
#pragma once

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/render/sinks/frame_folder.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::sinks {

inline Manifest small_manifest() {
  return {"a film.json", std::string(32, 'a'), 6, 4, images::PictureFormat::png, 24, 12, {0, 1, 2, 5, 11}, {}, {}, {}};
}

inline Manifest in_format(images::PictureFormat format) {
  Manifest manifest = small_manifest();
  manifest.format = format;
  return manifest;
}

inline Manifest of_frames(std::vector<std::uint32_t> frames) {
  Manifest manifest = small_manifest();
  manifest.frames = std::move(frames);
  return manifest;
}

// Each frame of one colour.
inline void put_frames(FrameFolder& folder, const Manifest& manifest, std::uint32_t color,
                       FileSink::ContentOf content = {}) {
  FileSink sink(folder, std::move(content));
  compositor::Frame frame(manifest.width, manifest.height, 16, 0, images::facts_of(manifest.format).pixels);
  for (const std::uint32_t number : manifest.frames) {
    frame.number = number;
    std::fill(frame.pixels.begin(), frame.pixels.end(), color + number);
    sink.take(frame);
  }
}

// A folder with all its frames.
inline void fill(const std::filesystem::path& path, const Manifest& manifest, std::uint32_t color) {
  FrameFolder folder(path, manifest);
  put_frames(folder, manifest, color);
  folder.finish();
}

// Runs `act` as a person who is not root; whatever fails there fails the test.
inline void as_nobody(const std::filesystem::path& folder, const std::function<bool()>& act) {
  constexpr uid_t kNobody = 65534;
  if (geteuid() == 0) {
    ASSERT_EQ(chown(folder.c_str(), kNobody, kNobody), 0);
    for (const std::filesystem::directory_entry& entry : std::filesystem::recursive_directory_iterator(folder))
      ASSERT_EQ(chown(entry.path().c_str(), kNobody, kNobody), 0);
  }
  const pid_t child = fork();
  if (child == 0) {
    const bool may = geteuid() != 0 || (setgid(kNobody) == 0 && setuid(kNobody) == 0);
    _exit(may && act() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

inline std::string failure_to_claim(const std::filesystem::path& path, const Manifest& manifest) {
  return document::failure_of([&] { FrameFolder(path, manifest); });
}

}  // namespace mars::sinks
