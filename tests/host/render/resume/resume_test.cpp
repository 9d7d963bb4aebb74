#include "host/render/resume/resume.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <barrier>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/compile.h"
#include "host/content/film/film_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/host/render/sinks/temporary_folder.h"

namespace mars::resume {
namespace {

namespace fs = std::filesystem;
using Frames = std::vector<std::uint32_t>;

// A box that moves a little from frame to frame; in frame `turned` and later it is turned, too.
std::string film_text(int frames, int turned = 1000) {
  std::string keys =
      R"({"frame": 0, "place": [0, 0, 0]}, {"frame": )" + std::to_string(frames - 1) + R"(, "place": [1, 0, 0]})";
  std::string lamp = R"({"frame": 0, "turn": [0, 0, 0]})";
  if (turned < frames)
    lamp += R"(, {"frame": )" + std::to_string(turned - 1) + R"(, "turn": [0, 0, 0]}, {"frame": )" +
            std::to_string(turned) + R"(, "turn": [0, 0, 30]})";
  return R"({"frames": )" + std::to_string(frames) +
         R"(, "size": [16, 8], "camera": {"eye": [0, -6, 3], "at": [0, 0, 0]},
    "models": {"box": {"joints": [{"name": "side", "segment": {"shape": "box",
                                  "sbb": [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]]}}]}},
    "actors": [{"name": "mover", "model": "box", "keys": [)" +
         keys + R"(]}, {"name": "turner", "model": "box", "place": [2, 0, 0], "keys": [)" + lamp + "]}]}";
}

// A film's file and the folder that it is rendered into.
class Resume : public testing::Test {
 protected:
  Resume() { write(film_text(12)); }

  void write(const std::string& text) { document::write_whole_file(folder_ / "film.json", text); }

  Wish wish() const { return {folder_ / "out", folder_ / "film.json", {}, images::PictureFormat::png, {}, false}; }

  Opened open(const Wish& wish) {
    return resume::open(wish, [&] {
      ++compiled_;
      return film::load_film(wish.film);
    });
  }

  // Writes these of the frames that are left to render.
  Frames render(const Wish& wish, std::size_t most = 1000) {
    Opened opened = open(wish);
    if (!opened.folder) return {};
    sinks::Manifest manifest = manifest_of(opened);
    manifest.frames = opened.frames;
    manifest.frames.resize(std::min(most, opened.frames.size()));
    sinks::put_frames(*opened.folder, manifest, 7);
    opened.folder->finish();
    return opened.frames;
  }

  static sinks::Manifest manifest_of(const Opened& opened) {
    const wire::FilmView view = opened.film.view();
    sinks::Manifest manifest;
    manifest.width = view.settings().width;
    manifest.height = view.settings().height;
    return manifest;
  }

  sinks::Manifest manifest() const { return sinks::read_manifest(folder_ / "out"); }
  std::string failure_of(const Wish& wish) {
    return document::failure_of([&] { open(wish); });
  }

  const sinks::TemporaryFolder folder_;
  int compiled_ = 0;
};

TEST_F(Resume, GoesOnWhereAnEarlierRunStopped) {
  EXPECT_EQ(render(wish(), 5).size(), 12u);
  EXPECT_EQ(count_if_complete(wish()), std::nullopt);
  EXPECT_EQ(render(wish()), (Frames{5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(count_if_complete(wish()), 12u);
  EXPECT_EQ(render(wish()), Frames());
  EXPECT_EQ(compiled_, 1) << "the folder keeps the film";
}

TEST_F(Resume, AFrameWhoseFileIsGoneIsRenderedAgain) {
  render(wish());
  fs::remove(folder_ / "out/frame-0004.png");
  EXPECT_EQ(count_if_complete(wish()), std::nullopt);
  EXPECT_EQ(render(wish()), Frames{4});
}

TEST_F(Resume, AFrameWhoseHashIsLostIsRenderedAgainAndItsFileGoesFirst) {
  render(wish());
  const std::string text = document::read_file(folder_ / "out/frames.json");
  const std::string hash = sinks::hash_of(manifest(), 4);
  std::string without = text;
  without.replace(text.find('"' + hash + '"'), hash.size() + 2, "null");
  document::write_whole_file(folder_ / "out/frames.json", without);
  const Opened opened = open(wish());
  EXPECT_EQ(opened.frames, Frames{4});
  EXPECT_FALSE(fs::exists(folder_ / "out/frame-0004.png"));
}

TEST_F(Resume, OnlyFramesAskedForCount) {
  Wish part = wish();
  part.frames = film::FrameSet("3-5");
  EXPECT_EQ(render(part), (Frames{3, 4, 5}));
  EXPECT_EQ(count_if_complete(part), 3u);
  EXPECT_EQ(count_if_complete(wish()), std::nullopt);
  EXPECT_EQ(render(wish()), (Frames{0, 1, 2, 6, 7, 8, 9, 10, 11}));
}

TEST_F(Resume, OverwriteRendersAllAskedFor) {
  render(wish());
  Wish part = wish();
  part.frames = film::FrameSet("3-5");
  part.overwrite = true;
  EXPECT_EQ(count_if_complete(part), std::nullopt);
  EXPECT_EQ(render(part), (Frames{3, 4, 5}));
  EXPECT_EQ(count_if_complete(wish()), 12u) << "the others stay";
}

TEST_F(Resume, TheFilmThatTheFolderKeepsCanBeNamed) {
  render(wish(), 5);
  const sinks::Manifest before = manifest();
  Wish kept = wish();
  kept.film = folder_ / "out/film.mars";
  EXPECT_EQ(render(kept).size(), 7u);
  EXPECT_EQ(count_if_complete(kept), 12u);
  EXPECT_EQ(manifest().sources, before.sources) << "still those of the film's file";
  EXPECT_EQ(manifest().film, before.film);
}

TEST_F(Resume, AFilmThatIsLostOrDamagedIsCompiledAgain) {
  render(wish(), 5);
  for (const std::string text : {"", "nonsense"}) {
    if (text.empty())
      fs::remove(folder_ / "out/film.mars");
    else
      document::write_whole_file(folder_ / "out/film.mars", text);
    compiled_ = 0;
    EXPECT_EQ(open(wish()).frames.size(), 7u);
    EXPECT_EQ(compiled_, 1);
    EXPECT_NO_THROW(film::load_compiled_film(folder_ / "out/film.mars"));
  }
}

TEST_F(Resume, ACompleteFolderNeedsNoRightToWrite) {
  render(wish());
  fs::permissions(folder_ / "out", fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(count_if_complete(wish()), 12u);
  EXPECT_TRUE(open(wish()).frames.empty());
  fs::permissions(folder_ / "out", fs::perms::owner_all);
}

TEST_F(Resume, OtherFormatsAreRefused) {
  render(wish());
  Wish exr = wish();
  exr.format = images::PictureFormat::exr;
  EXPECT_EQ(count_if_complete(exr), std::nullopt);
  EXPECT_TRUE(document::holds(failure_of(exr), "are png, not exr")) << failure_of(exr);
  EXPECT_TRUE(document::holds(failure_of(exr), "--overwrite"));
  EXPECT_EQ(count_if_complete(wish()), 12u) << "nothing has changed";
  exr.overwrite = true;
  EXPECT_EQ(open(exr).frames.size(), 12u);
}

TEST_F(Resume, OfAnEditedFilmOnlyChangedFramesAreRenderedAgain) {
  render(wish(), 10);
  write(film_text(12, 8));
  EXPECT_EQ(count_if_complete(wish()), std::nullopt);
  Opened opened = open(wish());
  EXPECT_EQ(opened.frames, (Frames{8, 9, 10, 11})) << opened.changed;
  EXPECT_TRUE(document::holds(opened.changed, "film.json has changed: frames 8-9 are to be rendered again (interval"))
      << opened.changed;
  EXPECT_FALSE(fs::exists(folder_ / "out/frame-0009.png")) << "it would pass as the new film's";
  opened.folder.reset();
  EXPECT_EQ(render(wish()).size(), 4u);
  EXPECT_EQ(count_if_complete(wish()), 12u);
  EXPECT_EQ(document::checksum_of(film::load_compiled_film(folder_ / "out/film.mars").block()), manifest().checksum);
}

TEST_F(Resume, OfAnEditedFilmFramesThatAreNotAskedForAreForgotten) {
  render(wish());
  write(film_text(12, 8));
  Wish part = wish();
  part.frames = film::FrameSet("0-8");
  EXPECT_EQ(render(part), Frames{8});
  EXPECT_EQ(render(wish()), (Frames{9, 10, 11}));
}

TEST_F(Resume, AnEditThatChangesNoPictureRendersNothing) {
  render(wish());
  write(film_text(12) + "\n\n");
  EXPECT_EQ(count_if_complete(wish()), std::nullopt) << "the film must be compiled to know";
  EXPECT_EQ(render(wish()), Frames());
  EXPECT_EQ(count_if_complete(wish()), 12u) << "now it is known";
}

TEST_F(Resume, AFilmMayBecomeLongerAndShorter) {
  render(wish());
  // Of the longer film the box moves more slowly: only where it begins does it stand where it stood.
  write(film_text(14));
  Opened longer = open(wish());
  EXPECT_EQ(longer.frames.size(), 13u) << longer.changed;
  longer.folder.reset();
  render(wish());
  std::string text = film_text(14);
  text.replace(text.find("\"frames\": 14"), 12, "\"frames\": 5");
  write(text.replace(text.find("{\"frame\": 13"), 12, "{\"frame\": 4"));
  Opened shorter = open(wish());
  EXPECT_EQ(shorter.asked, 5u);
  EXPECT_TRUE(document::holds(shorter.changed, "the film ends before frame 5 now")) << shorter.changed;
  EXPECT_EQ(manifest().film_frames, 5u);
  EXPECT_EQ(manifest().frames.size(), 5u);
}

TEST_F(Resume, AnotherFilmOrSizeIsRefusedAndChangesNothing) {
  render(wish());
  const std::string before = document::read_file(folder_ / "out/frames.json");
  document::write_whole_file(folder_ / "other.json", R"({"frames": 12, "size": [16, 8], "background": [1, 0, 0],
      "camera": {"eye": [0, -6, 3], "at": [0, 0, 0]}, "models": {}, "actors": []})");
  Wish another = wish();
  another.film = folder_ / "other.json";
  EXPECT_TRUE(document::holds(failure_of(another), "are of another film, ")) << failure_of(another);
  std::string wide = film_text(12);
  write(wide.replace(wide.find("[16, 8]"), 7, "[32, 8]"));
  EXPECT_TRUE(document::holds(failure_of(wish()), "are 16x8 with 4 samples a pixel, not 32x8")) << failure_of(wish());
  for (const std::string& failure : {failure_of(another), failure_of(wish())})
    EXPECT_TRUE(document::holds(failure, "--overwrite")) << failure;
  EXPECT_EQ(document::read_file(folder_ / "out/frames.json"), before);
  EXPECT_EQ(folder_.entries(), 3u);
  another.overwrite = true;
  EXPECT_EQ(open(another).frames.size(), 12u);
}

TEST_F(Resume, TheSameFilmInAnotherFileGoesOn) {
  render(wish(), 5);
  film::save_film(film::load_film(folder_ / "film.json"), folder_ / "compiled.mars");
  Wish compiled = wish();
  compiled.film = folder_ / "compiled.mars";
  EXPECT_EQ(open(compiled).frames.size(), 7u);
}

TEST_F(Resume, WithoutItsFilmAnEditedOnesFolderIsRefused) {
  render(wish());
  fs::remove(folder_ / "out/film.mars");
  write(film_text(12, 8));
  EXPECT_TRUE(document::holds(failure_of(wish()), "film.mars, which would tell")) << failure_of(wish());
}

// As of runs on machines whose compiled films differ in a last bit: all go on with the film of the first.
TEST_F(Resume, RunsThatStartAtOnceRenderOneFilm) {
  constexpr std::uint32_t kRuns = 6;
  std::vector<std::jthread> runs;
  std::vector<std::string> checksums(kRuns);
  std::barrier compiled(kRuns);
  for (std::uint32_t run = 0; run < kRuns; ++run)
    runs.emplace_back([&, run] {
      Wish part = wish();
      part.frames = film::FrameSet(std::to_string(2 * run) + "-" + std::to_string(2 * run + 1));
      const Opened opened = resume::open(part, [&] {
        film::CompiledFilm film = film::load_film(part.film);
        const wire::FilmView view = film.view();
        // The last bit of a matrix.
        const_cast<wire::Matrix&>(view.matrices()[3]).m[0][3] += 1e-15 * run;
        compiled.arrive_and_wait();
        return film;
      });
      checksums[run] = document::checksum_of(opened.film.block());
      sinks::Manifest manifest = manifest_of(opened);
      manifest.frames = opened.frames;
      sinks::put_frames(*opened.folder, manifest, 7);
      opened.folder->finish();
    });
  runs.clear();
  EXPECT_EQ(std::set(checksums.begin(), checksums.end()).size(), 1u);
  EXPECT_EQ(document::checksum_of(film::load_compiled_film(folder_ / "out/film.mars").block()), manifest().checksum);
  EXPECT_EQ(count_if_complete(wish()), 12u);
}

}  // namespace
}  // namespace mars::resume
