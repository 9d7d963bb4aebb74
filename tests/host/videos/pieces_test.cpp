// Pieces of videos by programs that stand for ffmpeg and ffprobe.
#include "host/videos/pieces.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::videos {
namespace {

// Two frames of four pixels.
Source two_frames() {
  Source source;
  source.size = {2, 2};
  source.frames = {0, 1};
  source.film_frames = 2;
  source.picture = [](std::size_t) {
    return std::make_shared<const images::Image>(images::Image{2, 2, std::vector<std::uint32_t>(4)});
  };
  source.content = [](std::size_t place) { return std::to_string(place); };
  return source;
}

// ffmpeg ends well here whatever it has written, and ffprobe counts one picture. Nothing is kept for a second try.
TEST(Pieces, ThatLackPicturesAreNotKept) {
  const test::TemporaryFolder folder;
  const auto program = [&](const char* name, const char* script) {
    const std::filesystem::path path = folder / name;
    std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path.string();
  };
  const std::string ffmpeg = program("ffmpeg", "exec cat >/dev/null");
  program("ffprobe", R"(echo '{"streams": [{"codec_type": "video", "nb_read_packets": "1"}]}')");
  const std::string before = std::getenv("PATH");
  setenv("PATH", (folder.path().string() + ":" + before).c_str(), 1);
  const Source source = two_frames();
  Order order;
  order.file = folder / "film.mp4";
  const auto encode = [&] {
    Pieces pieces(source, form_of(order.file, {}), order, {}, folder.path());
    pieces.encode(ffmpeg, {});
  };
  for (int times = 0; times < 2; ++times) {
    const std::string failure = document::failure_of(encode);
    EXPECT_TRUE(document::holds(failure, "film.mp4: ffmpeg wrote 1 of 2 pictures")) << failure;
  }
  setenv("PATH", before.c_str(), 1);
}

}  // namespace
}  // namespace mars::videos
