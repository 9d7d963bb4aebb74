#include "host/render/resume/resume.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <barrier>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "host/content/document/checksum.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/compile.h"
#include "host/content/film/film_file.h"
#include "host/content/film/frame_content.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/temporary_folder.h"

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

  Wish wish() const { return {folder_ / "out", folder_ / "film.json", {}, {}, {}, false}; }

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
    const film::FrameContent content(opened.film.view());
    sinks::put_frames(*opened.folder, manifest, 7, [&](std::uint32_t frame) { return content.checksum(frame); });
    opened.folder->finish();
    return opened.frames;
  }

  static sinks::Manifest manifest_of(const Opened& opened) {
    const wire::PackedFilm view = opened.film.view();
    sinks::Manifest manifest;
    manifest.width = view.settings().width;
    manifest.height = view.settings().height;
    return manifest;
  }

  sinks::Manifest manifest() const { return sinks::read_manifest(folder_ / "out"); }
  std::string failure_of(const Wish& wish) {
    return document::failure_of([&] { open(wish); });
  }

  const test::TemporaryFolder folder_;
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
  sinks::Manifest without = manifest();
  sinks::set_hash(without, 4, "");
  document::write_whole_file(folder_ / "out/frames.json", sinks::to_json(without).dump());
  const Opened opened = open(wish());
  EXPECT_EQ(opened.frames, Frames{4});
  EXPECT_FALSE(fs::exists(folder_ / "out/frame-0004.png"));
}

TEST_F(Resume, AManifestThatIsLostOrDamagedIsMadeAgain) {
  render(wish(), 5);
  const sinks::Manifest before = manifest();
  for (const std::string text : {"", "nonsense"}) {
    if (text.empty())
      fs::remove(folder_ / "out/frames.json");
    else
      document::write_whole_file(folder_ / "out/frames.json", text);
    EXPECT_EQ(open(wish()).frames.size(), 7u);
    EXPECT_EQ(manifest(), before);
  }
  fs::remove(folder_ / "out/frames.json");
  fs::remove(folder_ / "out/film.mars");
  EXPECT_EQ(open(wish()).frames.size(), 7u) << "the film is compiled, and the frames are its";
}

// Also where nothing is left to render.
TEST_F(Resume, AManifestIsMadeAgainOfACompleteFolder) {
  render(wish());
  for (const fs::path& film : {folder_ / "film.json", folder_ / "out/film.mars"}) {
    document::write_whole_file(folder_ / "out/frames.json", "nonsense");
    Wish again = wish();
    again.film = film;
    EXPECT_EQ(count_if_complete(again), std::nullopt);
    EXPECT_TRUE(open(again).frames.empty());
    EXPECT_EQ(manifest().pixel_hashes.size(), 12u);
    EXPECT_EQ(count_if_complete(again), 12u);
  }
}

TEST_F(Resume, FramesThatStayedThroughAnEditAreKnownToBeTheFilms) {
  render(wish());
  write(film_text(12, 8));
  EXPECT_EQ(render(wish()).size(), 4u);
  document::write_whole_file(folder_ / "out/frames.json", "nonsense");
  EXPECT_TRUE(open(wish()).frames.empty());
  write(film_text(12, 6));
  document::write_whole_file(folder_ / "out/frames.json", "nonsense");
  EXPECT_EQ(open(wish()).frames.front(), 6u) << "an edit and a damage at once";
}

TEST_F(Resume, FramesOfAnotherPixelVersionAreNotMixed) {
  render(wish(), 5);
  sinks::Manifest older = manifest();
  older.pixel_version = wire::kFirstPixelVersion;
  const std::string text = sinks::to_json(older).dump();
  document::write_whole_file(folder_ / "out/frames.json", text);
  EXPECT_TRUE(document::holds(failure_of(wish()), "draws other pixels: their pixel version is 1, not 2 (give another"));
  EXPECT_EQ(document::read_file(folder_ / "out/frames.json"), text);
  Wish part = wish();
  part.frames = film::FrameSet("0-4");
  EXPECT_EQ(count_if_complete(part), 5u) << "nothing is mixed";
  EXPECT_TRUE(open(part).frames.empty());
  part.frames = film::FrameSet("0-5");
  part.overwrite = true;
  EXPECT_EQ(render(part).size(), 6u);
  EXPECT_EQ(manifest().pixel_version, wire::kPixelVersion);
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
  exr.form.format = images::PictureFormat::exr;
  EXPECT_EQ(count_if_complete(exr), std::nullopt);
  EXPECT_TRUE(document::holds(failure_of(exr), "are png, not exr")) << failure_of(exr);
  EXPECT_TRUE(document::holds(failure_of(exr), "--overwrite"));
  EXPECT_EQ(count_if_complete(wish()), 12u) << "nothing has changed";
  exr.overwrite = true;
  EXPECT_EQ(open(exr).frames.size(), 12u);
}

TEST_F(Resume, AlphaIsAnotherFormat) {
  render(wish());
  Wish alpha = wish();
  alpha.form.format = images::PictureFormat::png_alpha;
  EXPECT_TRUE(document::holds(failure_of(alpha), "are png, not png-alpha (leave out --alpha")) << failure_of(alpha);
  alpha.overwrite = true;
  EXPECT_EQ(render(alpha).size(), 12u);
  EXPECT_TRUE(document::holds(failure_of(wish()), "are png-alpha, not png (add --alpha")) << failure_of(wish());
}

TEST_F(Resume, OtherNamesAreRefused) {
  Wish named = wish();
  named.form.names = {"shot_####", 1001};
  render(named, 5);
  EXPECT_TRUE(fs::exists(folder_ / "out/shot_1001.png"));
  EXPECT_EQ(render(named).size(), 7u);
  EXPECT_EQ(count_if_complete(named), 12u);
  EXPECT_EQ(count_if_complete(wish()), std::nullopt);
  EXPECT_TRUE(document::holds(failure_of(wish()), "their first is 'shot_1001', not 'frame-0000'"))
      << failure_of(wish());
  EXPECT_TRUE(document::holds(failure_of(wish()), "--name 'shot_####' --first-number 1001")) << failure_of(wish());
  EXPECT_TRUE(
      document::holds(command_for("out", manifest(), film::FrameSet()), "--name 'shot_####' --first-number 1001"));
}

TEST_F(Resume, OtherNamesThanTheUsualCanBeLeftOut) {
  render(wish());
  Wish named = wish();
  named.form.names = {"shot_####", 1001};
  EXPECT_TRUE(document::holds(failure_of(named), "leave out --name 'shot_####' --first-number 1001"))
      << failure_of(named);
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

// The files say so themselves.
TEST_F(Resume, FramesOfAnotherFilmInNoListAreNotOverwritten) {
  render(wish());
  fs::remove(folder_ / "out/film.mars");
  fs::remove(folder_ / "out/frames.json");
  EXPECT_EQ(open(wish()).frames.size(), 0u) << "they are of the film";
  fs::remove(folder_ / "out/film.mars");
  fs::remove(folder_ / "out/frames.json");
  write(film_text(12, 8));
  EXPECT_TRUE(document::holds(failure_of(wish()), "say that they are of another film")) << failure_of(wish());
  Wish again = wish();
  again.overwrite = true;
  EXPECT_EQ(open(again).frames.size(), 12u);
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

TEST_F(Resume, TheKeptFilmIsTakenWhateverBecomesOfItsFiles) {
  render(wish(), 5);
  Wish kept = wish();
  kept.kept_film = true;
  for (const std::string& text : {film_text(12, 3), film_text(12).substr(0, 100), std::string()}) {
    if (text.empty())
      fs::remove(folder_ / "film.json");
    else
      write(text);
    const Opened opened = open(kept);
    EXPECT_EQ(opened.frames.size(), 7u) << opened.changed;
    EXPECT_EQ(opened.changed, "");
  }
  EXPECT_EQ(compiled_, 1);
  const std::vector<sinks::Source> sources = manifest().sources;
  EXPECT_EQ(render(kept).size(), 7u);
  EXPECT_EQ(manifest().sources, sources) << "a person's next run sees that they have changed";
  EXPECT_EQ(count_if_complete(kept), 12u);
  EXPECT_EQ(count_if_complete(wish()), std::nullopt);
}

TEST_F(Resume, WithoutAKeptFilmItIsCompiledAsAtFirst) {
  Wish kept = wish();
  kept.kept_film = true;
  EXPECT_EQ(render(kept, 5).size(), 12u);
  fs::remove(folder_ / "out/film.mars");
  EXPECT_EQ(render(kept, 1).size(), 7u);
  EXPECT_EQ(compiled_, 2);
  fs::remove(folder_ / "out/film.mars");
  write(film_text(12).substr(0, 100));
  EXPECT_TRUE(document::holds(failure_of(kept), "out keeps no film.mars of its frames")) << failure_of(kept);
  EXPECT_TRUE(document::holds(failure_of(kept), "film.json:")) << failure_of(kept);
}

// As mars submit does, for jobs to come.
TEST_F(Resume, AFilmIsLeftForRunsToCome) {
  Wish left = wish(), kept = wish();
  left.renders = false;
  kept.kept_film = true;
  Opened opened = open(left);
  EXPECT_FALSE(opened.folder);
  EXPECT_EQ(manifest().frames.size(), 12u);
  fs::remove(folder_ / "film.json");
  EXPECT_EQ(render(kept, 5).size(), 12u);
  write(film_text(12, 3));
  opened = open(left);
  EXPECT_TRUE(document::holds(opened.changed, "frames 3-4 are to be rendered again")) << opened.changed;
  fs::remove(folder_ / "film.json");
  EXPECT_EQ(render(kept), (Frames{3, 4, 5, 6, 7, 8, 9, 10, 11})) << "the person's newer film, which wins";
  EXPECT_EQ(compiled_, 2);
}

TEST_F(Resume, AFilmIsLeftBesideARunOfTheSameAlone) {
  Wish left = wish(), part = wish();
  left.renders = false;
  part.frames = film::FrameSet("0-5");
  const Opened running = open(part);
  EXPECT_NO_THROW(open(left));
  EXPECT_EQ(manifest().frames.size(), 12u);
  write(film_text(12, 3));
  EXPECT_TRUE(document::holds(failure_of(left), "renders frames 0-5 of another version, size or format of"))
      << failure_of(left);
  EXPECT_EQ(manifest().checksum, document::checksum_of(running.film.block()));
}

TEST_F(Resume, OverwriteOfAFilmThatIsLeftCountsOnce) {
  render(wish());
  Wish left = wish(), kept = wish();
  left.renders = false;
  left.overwrite = kept.kept_film = true;
  open(left);
  EXPECT_EQ(render(kept, 5).size(), 12u);
  EXPECT_EQ(render(kept).size(), 7u);
}

TEST_F(Resume, ALookAtTheFilmChangesNothing) {
  const auto look = [&] { return film_for(wish(), [&] { return film::load_film(wish().film); }); };
  EXPECT_EQ(look().view().settings().frames, 12u);
  EXPECT_EQ(folder_.entries(), 1u);
  render(wish());
  std::string wide = film_text(12);
  write(wide.replace(wide.find("[16, 8]"), 7, "[32, 8]"));
  EXPECT_TRUE(document::holds(document::failure_of(look), "are 16x8 with 4 samples a pixel, not 32x8"));
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
        const wire::PackedFilm view = film.view();
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
