#include "host/render/sinks/frame_folder.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/images/png_file.h"
#include "host/render/sinks/pixel_hash.h"
#include "host/render/sinks/verify.h"
#include "node/wire/film.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/render/sinks/small_folders.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using images::PictureFormat;

// A run of `manifest` that is killed when it has written the frames of `written`, and a part of another.
void run_and_kill(const fs::path& path, const Manifest& manifest, const std::vector<std::uint32_t>& written,
                  const ProcessName& as = {}) {
  const pid_t child = fork();
  if (child == 0) {
    FrameFolder folder(path, manifest, as.number == 0 ? this_process() : as);
    put_frames(folder, of_frames(written), 7);
    for (const fs::directory_entry& entry : fs::directory_iterator(path / ".runs"))
      if (entry.path().extension() == ".claim")
        document::create_file(fs::path(entry.path()).replace_extension(".frame.part"), "x");
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(FrameFolder, NamesSortAsFramesDo) {
  const auto name = [](std::uint32_t frame, std::uint32_t film_frames, PictureFormat format = PictureFormat::png) {
    Manifest manifest = in_format(format);
    manifest.film_frames = film_frames;
    return frame_file_name(manifest, frame);
  };
  EXPECT_EQ(name(0, 1), "frame-0000.png");
  EXPECT_EQ(name(9999, 10000), "frame-9999.png");
  EXPECT_EQ(name(7, 10001), "frame-00007.png");
  EXPECT_EQ(name(4294967294, 4294967295), "frame-4294967294.png");
  EXPECT_EQ(name(3, 10, PictureFormat::png16), "frame-0003.png");
  EXPECT_EQ(name(3, 10, PictureFormat::exr), "frame-0003.exr");
}

TEST(FrameFolder, IsMadeWithItsManifest) {
  const test::TemporaryFolder folder;
  Manifest manifest = small_manifest();
  const FrameFolder frames(folder / "a/b", manifest);
  manifest.pixel_hashes.resize(5);
  EXPECT_EQ(read_manifest(folder / "a/b"), manifest) << "no hash is known yet";
  EXPECT_EQ(frames.file_of(3), folder / "a/b/frame-0003.png");
}

TEST(FrameFolder, ManifestsKeepNamesThatAreNoText) {
  const test::TemporaryFolder folder;
  Manifest manifest = small_manifest();
  manifest.film = "\xff.json";
  const FrameFolder frames(folder.path(), manifest);
  EXPECT_EQ(read_manifest(folder.path()).frames, manifest.frames);
}

TEST(FrameFolder, AtItsEndOnlyFramesAndManifestAreThere) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  EXPECT_EQ(folder.entries(), 6u);
  EXPECT_EQ(read_manifest(folder.path()).pixel_hashes[1],
            hash_of_bands(std::vector{hash_of_band(std::vector<std::uint32_t>(24, 8))}));
}

// The file `ending` of the only run in the folder.
fs::path file_of_run(const fs::path& folder, const std::string& ending) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / ".runs"))
    if (entry.path().extension() == ending) return entry.path();
  return {};
}

TEST(FrameFolder, WhatItHasRenderedDoesNotDependOnReadingItsClaimAgain) {
  const test::TemporaryFolder folder;
  FrameFolder frames(folder.path(), small_manifest());
  put_frames(frames, small_manifest(), 7);
  document::write_whole_file(file_of_run(folder.path(), ".claim"), "nonsense");
  document::write_whole_file(file_of_run(folder.path(), ".hashes"), "");
  frames.finish();
  EXPECT_TRUE(verify_folder(folder.path()).troubles.empty());
  EXPECT_EQ(folder.entries(), 6u);
}

TEST(FrameFolder, ARunThatCannotRecordItsHashesFails) {
  const test::TemporaryFolder folder;
  FrameFolder frames(folder.path(), of_frames({1}));
  put_frames(frames, of_frames({1}), 7);
  fs::remove(folder / "frames.json");
  fs::create_directory(folder / "frames.json");
  const std::string failure = document::failure_of([&] { frames.finish(); });
  EXPECT_TRUE(document::holds(failure, "frames.json: is not a regular file")) << failure;
  EXPECT_TRUE(fs::exists(file_of_run(folder.path(), ".hashes")));
}

TEST(FrameFolder, ARunThatFailsDoesNotWaitForOneThatHangs) {
  const test::TemporaryFolder folder;
  auto frames = std::make_unique<FrameFolder>(folder.path(), small_manifest());
  ProcessName elsewhere = this_process();
  elsewhere.boot = "another";
  const RunsFolder hangs(folder.path(), elsewhere);
  hangs.add_own_file(kTurnEnding, to_json(elsewhere).dump());
  const auto began = std::chrono::steady_clock::now();
  std::jthread clears([&] { clear_ended_runs(folder.path()); });
  frames.reset();
  clears.join();
  EXPECT_LT(std::chrono::steady_clock::now() - began, 30s);
}

TEST(FrameFolder, TheLongestFilmsManifestIsRead) {
  const test::TemporaryFolder folder;
  Manifest manifest = of_frames({0, wire::kMostFrames - 1});
  manifest.film_frames = wire::kMostFrames;
  fill(folder.path(), manifest, 7);
  EXPECT_EQ(read_manifest(folder.path()).frames, manifest.frames);
}

TEST(FrameFolder, ARunThatFailsRecordsWhatItHasRendered) {
  const test::TemporaryFolder folder;
  {
    FrameFolder frames(folder.path(), small_manifest());
    put_frames(frames, of_frames({1, 2}), 7);
  }
  EXPECT_EQ(folder.entries(), 3u);
  EXPECT_EQ(verify_folder(folder.path()).troubles.size(), 3u);
}

TEST(FrameFolder, WhatAKilledRunHasRenderedIsKnownBeforeAndAfterItIsClearedAway) {
  const test::TemporaryFolder folder;
  run_and_kill(folder.path(), small_manifest(), {1, 2});
  EXPECT_EQ(verify_folder(folder.path()).troubles.size(), 3u);
  EXPECT_TRUE(fs::exists(folder / ".runs"));
  clear_ended_runs(folder.path());
  EXPECT_EQ(folder.entries(), 3u);
  EXPECT_EQ(verify_folder(folder.path()).troubles.size(), 3u);
  run_and_kill(folder.path(), small_manifest(), {5});
  fill(folder.path(), of_frames({0, 11}), 7);
  EXPECT_EQ(folder.entries(), 6u) << "the next run does the same";
  EXPECT_TRUE(verify_folder(folder.path()).troubles.empty());
}

TEST(FrameFolder, ClearingMakesNoFolder) {
  const test::TemporaryFolder folder;
  clear_ended_runs(folder.path());
  clear_ended_runs(folder / "none");
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(FrameFolder, IsRemovedWithWhatAKilledRunLeft) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "out";
  fill(path, small_manifest(), 7);
  EXPECT_TRUE(remove_folder(path));
  run_and_kill(path, small_manifest(), {1, 2});
  EXPECT_TRUE(remove_folder(path));
  fill(path, small_manifest(), 7);
  document::write_whole_file(path / "frames.json", "{");
  EXPECT_TRUE(remove_folder(path));
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(FrameFolder, IsNotRemovedWhereOthersHaveSomething) {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "out";
  fill(path, small_manifest(), 7);
  {
    const FrameFolder running(path, of_frames({3}));
    EXPECT_FALSE(remove_folder(path));
  }
  document::write_whole_file(path / "slurm-7.out", "");
  EXPECT_FALSE(remove_folder(path));
  fs::remove(path / "slurm-7.out");
  fs::remove(path / "frames.json");
  fs::create_directory(path / "frames.json");
  EXPECT_FALSE(remove_folder(path)) << "nobody knows what it is";
  EXPECT_TRUE(fs::exists(path / "frame-0002.png"));
}

TEST(FrameFolder, PartsOfARunThatGoesOnStay) {
  const test::TemporaryFolder folder;
  FrameFolder frames(folder.path(), of_frames({1}));
  const fs::path of_another = folder / ".runs/vm-1-another.frame-0003.png.part";
  document::create_file(of_another, "its run has ended");
  fs::last_write_time(of_another, fs::last_write_time(of_another) - 65s);
  const fs::path part = file_of_run(folder.path(), ".claim").replace_extension(".frame-0001.png.part");
  document::create_file(part, "half a frame");
  fill(folder.path(), of_frames({2}), 7);
  clear_ended_runs(folder.path());
  EXPECT_TRUE(fs::exists(part));
  EXPECT_FALSE(fs::exists(of_another));
  fs::remove(part);
  put_frames(frames, of_frames({1}), 7);
  frames.finish();
  EXPECT_TRUE(verify_folder(folder.path()).troubles.empty());
}

TEST(FrameFolder, RunsThatWouldBeMixedAreRefusedAndChangeNothing) {
  const test::TemporaryFolder folder;
  FrameFolder frames(folder.path(), of_frames({1, 2}));
  put_frames(frames, of_frames({1}), 7);
  const std::string manifest = document::read_file(folder / "frames.json");
  EXPECT_TRUE(
      document::holds(failure_to_claim(folder.path(), of_frames({2, 3})), "renders frames 1-2 of a film.json into"));
  Manifest other = of_frames({1, 3});
  other.checksum = std::string(32, 'b');
  other.film = "other.json";
  EXPECT_TRUE(document::holds(failure_to_claim(folder.path(), other), "renders frames 1-2 of a film.json into"));
  EXPECT_EQ(document::read_file(folder / "frames.json"), manifest);
  EXPECT_TRUE(fs::exists(frames.file_of(1)));
  EXPECT_EQ(failure_to_claim(folder.path(), of_frames({3})), "");
  put_frames(frames, of_frames({2}), 7);
  frames.finish();
  EXPECT_EQ(failure_to_claim(folder.path(), other), "") << "once it has ended";
}

TEST(FrameFolder, OfARunOnAnotherMachineTheClaimCountsForAMinute) {
  const test::TemporaryFolder folder;
  ProcessName elsewhere = this_process();
  elsewhere.boot = "another";
  run_and_kill(folder.path(), of_frames({1, 2}), {1}, elsewhere);
  const auto age = [&](std::chrono::seconds by) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / ".runs"))
      fs::last_write_time(entry.path(), entry.last_write_time() - by);
  };
  age(50s);
  clear_ended_runs(folder.path());
  EXPECT_TRUE(fs::exists(folder / ".runs"));
  age(15s);
  EXPECT_EQ(failure_to_claim(folder.path(), of_frames({2})), "");
}

TEST(FrameFolder, ARunOnAnotherMachineIsRefusedToOnceItIsSeenToLive) {
  const test::TemporaryFolder folder;
  ProcessName elsewhere = this_process();
  elsewhere.boot = "another";
  run_and_kill(folder.path(), of_frames({1, 2}), {1}, elsewhere);
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& line) { warnings.push_back(line); };
  const auto enter = [&] {
    FrameFolder(folder.path(), of_frames({2}), keep_same_film(of_frames({2})), {.warn = warn});
  };
  const fs::path claim = file_of_run(folder.path(), ".claim");
  {
    const Lease renewing(claim, seconds_since_boot, 300ms);
    const auto began = std::chrono::steady_clock::now();
    EXPECT_TRUE(document::holds(document::failure_of(enter), "renders frames 1-2 of a film.json"));
    EXPECT_LT(std::chrono::steady_clock::now() - began, 20s);
  }
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(document::holds(warnings[0], "renders frames 1-2 of a film.json into this folder")) << warnings[0];
  EXPECT_TRUE(document::holds(warnings[0], "cannot be seen from here")) << warnings[0];
  EXPECT_EQ(failure_to_claim(folder.path(), of_frames({3})), "") << "it is in nobody's way";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / ".runs"))
    fs::last_write_time(entry.path(), fs::last_write_time(claim) - 58s);
  EXPECT_EQ(document::failure_of(enter), "") << "it grows old while it is waited for";
  EXPECT_EQ(warnings.size(), 2u);
}

// Who started its job knows that it has ended, though it cannot be seen.
TEST(FrameFolder, ARunOnAnotherMachineThatIsKnownToHaveEndedIsInNobodysWay) {
  const test::TemporaryFolder folder;
  ProcessName elsewhere = this_process();
  elsewhere.boot = "another";
  run_and_kill(folder.path(), of_frames({1, 2}), {1}, elsewhere);
  clear_ended_runs(folder.path(), "another-run");
  EXPECT_TRUE(fs::exists(folder / ".runs"));
  EXPECT_EQ(clear_ended_runs(folder.path(), file_of_run(folder.path(), ".claim").stem()), 1u);
  EXPECT_FALSE(fs::exists(folder / ".runs"));
  const FrameFolder next(folder.path(), of_frames({1, 2}));
  EXPECT_EQ(next.frames(), std::vector<std::uint32_t>{2}) << "what it had rendered is there";
}

std::string name_of_run(const fs::path& folder) { return file_of_run(folder, ".claim").stem(); }

// Nodes write them, and the run hears of them later.
TEST(FrameFolder, WholeFilesOfWhichAnEndedRunHadNotHeardAreThere) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  fill(folder / "same", of_frames({2}), 7);
  Manifest another = of_frames({5});
  another.checksum = std::string(32, 'b');
  fill(folder / "another", another, 7);
  run_and_kill(out, of_frames({1, 2, 5, 11}), {1});
  fs::copy(folder / "same/frame-0002.png", out);
  fs::copy(folder / "another/frame-0005.png", out);
  EXPECT_NE(hash_of(read_manifest(out), 2), "") << "also before anybody clears the run away";
  EXPECT_EQ(clear_ended_runs(out, name_of_run(out)), 2u);
  EXPECT_FALSE(fs::exists(out / ".runs"));
  const Verdict verdict = verify_folder(out);
  ASSERT_EQ(verdict.troubles.size(), 2u);
  EXPECT_EQ(verdict.troubles[0].frame, 5u);
  EXPECT_TRUE(document::holds(verdict.troubles[0].reason, "before it recorded the pixels")) << "it is another film's";
  EXPECT_EQ(verdict.troubles[1].reason, "missing");
  const FrameFolder next(out, of_frames({1, 2, 5, 11}));
  EXPECT_EQ(next.frames(), (std::vector<std::uint32_t>{5, 11}));
}

TEST(FrameFolder, ARunThatFailsWhileItsNodesWriteLeavesItsClaimToWhoKnowsThatTheyHaveEnded) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  fill(folder / "same", of_frames({2}), 7);
  { FrameFolder(out, of_frames({1, 2})).add_probe(); }
  fs::copy(folder / "same/frame-0002.png", out);
  EXPECT_EQ(clear_ended_runs(out), 0u) << "this process lives, and may be writing";
  EXPECT_EQ(clear_ended_runs(out, name_of_run(out)), 1u);
  EXPECT_EQ(hash_of(read_manifest(out), 2), hash_of(read_manifest(folder / "same"), 2));
}

// A run that was stopped so long that another machine took its claim away does not write over that one's frames.
TEST(FrameFolder, WhoHasLostItsClaimWritesNoMore) {
  const test::TemporaryFolder folder;
  FrameFolder frames(folder.path(), of_frames({1, 2}));
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / ".runs")) fs::remove(entry.path());
  EXPECT_TRUE(document::holds(document::failure_of([&] { frames.finish(); }), "claim to the folder is gone"));
}

TEST(FrameFolder, WaitsWhileItCannotWriteAndGoesOn) {
  const test::TemporaryFolder folder;
  as_nobody(folder.path(), [&] {
    std::atomic<int> said = 0;
    const Patience::Bounds bounds{.warn = [&](const std::string&) { ++said; }, .pause = 2ms};
    FrameFolder frames(folder / "out", of_frames({1, 2}), this_process(), bounds);
    put_frames(frames, of_frames({1}), 7);
    fs::permissions(folder / "out/.runs", fs::perms::owner_read | fs::perms::owner_exec);
    std::jthread waits([&] {
      put_frames(frames, of_frames({2}), 7);
      frames.finish();
    });
    while (said == 0) std::this_thread::sleep_for(1ms);
    fs::permissions(folder / "out/.runs", fs::perms::owner_all);
    waits.join();
    return said == 2 && verify_folder(folder / "out").troubles.empty();
  });
}

TEST(FrameFolder, WaitsNoLongerThanItMayAndSaysHowToGoOn) {
  const test::TemporaryFolder folder;
  as_nobody(folder.path(), [&] {
    FrameFolder frames(folder / "out", of_frames({1}), this_process(), {.longest = 20ms, .pause = 2ms});
    fs::permissions(folder / "out/.runs", fs::perms::owner_read | fs::perms::owner_exec);
    const std::string failure = document::failure_of([&] { put_frames(frames, of_frames({1}), 7); });
    fs::permissions(folder / "out/.runs", fs::perms::owner_all);
    return document::holds(failure, "frame-0001.png: cannot write: Permission denied, after waiting for 1 second") &&
           document::holds(failure, "; the same command then goes on where this run stopped)");
  });
}

TEST(FrameFolder, WhoseFolderIsRemovedOrRenamedSaysSoAtOnce) {
  for (const bool renamed : {false, true}) {
    const test::TemporaryFolder folder;
    FrameFolder frames(folder / "out", of_frames({1, 2}));
    put_frames(frames, of_frames({1}), 7);
    if (renamed)
      fs::rename(folder / "out", folder / "elsewhere");
    else
      fs::remove_all(folder / "out");
    const std::string says = (folder / "out").string() + ": the folder was removed or renamed while frames";
    EXPECT_TRUE(document::holds(document::failure_of([&] { put_frames(frames, of_frames({2}), 7); }), says));
    EXPECT_TRUE(document::holds(document::failure_of([&] { frames.finish(); }), says));
    EXPECT_FALSE(fs::exists(folder / "out")) << "it is not made again";
  }
}

TEST(FrameFolder, OfRunsThatStartAtOnceOneGetsAFrameTwoWant) {
  constexpr int kRuns = 12;
  for (int round = 0; round < 5; ++round) {
    const test::TemporaryFolder folder;
    std::barrier start(kRuns), tried(kRuns);
    std::atomic<int> won = 0, refused = 0;
    std::vector<std::jthread> runs;
    for (int i = 0; i < kRuns; ++i)
      runs.emplace_back([&] {
        std::unique_ptr<FrameFolder> frames;
        start.arrive_and_wait();
        const std::string failure =
            document::failure_of([&] { frames = std::make_unique<FrameFolder>(folder.path(), small_manifest()); });
        refused += document::holds(failure, "another run, process");
        tried.arrive_and_wait();
        if (!frames) return;
        ++won;
        put_frames(*frames, small_manifest(), 7);
        frames->finish();
      });
    runs.clear();
    EXPECT_EQ(won, 1);
    EXPECT_EQ(refused, kRuns - 1);
    EXPECT_TRUE(verify_folder(folder.path()).troubles.empty());
    EXPECT_EQ(folder.entries(), 6u);
  }
}

TEST(FrameFolder, OfRunsOfOtherFramesNothingIsLost) {
  constexpr std::uint32_t kRuns = 12;
  const test::TemporaryFolder folder;
  std::vector<std::jthread> runs;
  for (std::uint32_t frame = 0; frame < kRuns; ++frame)
    runs.emplace_back([&, frame] { fill(folder.path(), of_frames({frame}), 7); });
  runs.clear();
  EXPECT_EQ(read_manifest(folder.path()).frames.size(), kRuns);
  EXPECT_TRUE(verify_folder(folder.path()).troubles.empty());
  EXPECT_EQ(folder.entries(), kRuns + 1);
}

TEST(FrameFolder, NothingIsWrittenThroughLinks) {
  const test::TemporaryFolder folder;
  document::write_whole_file(folder / "precious", "old");
  fs::create_directory(folder / "out");
  for (const char* name : {"frame-0001.png", "frame-0001.png.part", "frames.json.part"})
    fs::create_symlink("../precious", folder / "out" / name);
  fill(folder / "theirs", of_frames({3}), 7);
  const std::string theirs = document::read_file(folder / "theirs/frames.json");
  fs::create_symlink("../theirs/frames.json", folder / "out/frames.json");
  fill(folder / "out", of_frames({1}), 7);
  EXPECT_EQ(document::read_file(folder / "theirs/frames.json"), theirs);
  fs::remove(folder / "out/frames.json");
  fill(folder / "out", small_manifest(), 7);
  EXPECT_EQ(fs::file_size(folder / "precious"), 3u);
  EXPECT_TRUE(verify_folder(folder / "out").troubles.empty());
}

TEST(FrameFolder, AnotherFilmsFramesDoNotPassAsThisOnes) {
  const test::TemporaryFolder folder;
  Manifest manifest = small_manifest();
  fill(folder / "f", manifest, 7);
  {
    const FrameFolder again(folder / "f", manifest);
    EXPECT_TRUE(fs::exists(again.file_of(5))) << "the same film's frames stay";
  }
  manifest.checksum = std::string(32, 'b');
  manifest.frames = {1, 5};
  const FrameFolder other(folder / "f", manifest);
  EXPECT_FALSE(fs::exists(other.file_of(5)));
  EXPECT_TRUE(fs::exists(other.file_of(2))) << "what was not asked for is left alone";
}

// Neither followed nor opened: what they lead to stays as it is.
TEST(FrameFolder, WhatHasAFramesNameAndIsNoneIsRenderedAgain) {
  const test::TemporaryFolder folder;
  fill(folder.path(), small_manifest(), 7);
  document::write_whole_file(folder / "precious", "old");
  for (const std::uint32_t frame : small_manifest().frames)
    fs::remove(folder / frame_file_name(small_manifest(), frame));
  document::write_whole_file(folder / "frame-0000.png", "");
  ASSERT_EQ(mkfifo((folder / "frame-0001.png").c_str(), 0600), 0);
  fs::create_directory(folder / "frame-0002.png");
  fs::create_symlink("nothing", folder / "frame-0005.png");
  fs::create_symlink("/dev/null", folder / "frame-0011.png");
  FrameFolder frames(folder.path(), small_manifest());
  EXPECT_EQ(frames.frames(), small_manifest().frames);
  put_frames(frames, small_manifest(), 7);
  frames.finish();
  EXPECT_TRUE(verify_folder(folder.path()).troubles.empty());
  EXPECT_FALSE(fs::exists(folder / "nothing"));
  EXPECT_EQ(folder.entries(), 7u);
}

// A link to a frame on another disk is one.
TEST(FrameFolder, AFrameMayBeMovedAwayAndLinked) {
  const test::TemporaryFolder folder;
  fill(folder / "out", of_frames({1}), 7);
  fs::rename(folder / "out/frame-0001.png", folder / "elsewhere.png");
  fs::create_symlink("../elsewhere.png", folder / "out/frame-0001.png");
  EXPECT_TRUE(FrameFolder(folder / "out", of_frames({1})).frames().empty());
}

TEST(FrameFolder, FramesOfTheSameFilmAreAdded) {
  const test::TemporaryFolder folder;
  Manifest manifest = of_frames({1, 2, 5});
  fill(folder / "f", manifest, 7);
  fill(folder / "f", of_frames({2, 3}), 7);
  EXPECT_EQ(read_manifest(folder / "f").frames, (std::vector<std::uint32_t>{1, 2, 3, 5}));
  EXPECT_TRUE(verify_folder(folder / "f").troubles.empty());
  manifest.checksum = std::string(32, 'b');
  const FrameFolder other(folder / "f", manifest);
  EXPECT_EQ(read_manifest(folder / "f").frames, manifest.frames);
}

TEST(FrameFolder, TellsWhereItCannotBe) {
  const test::TemporaryFolder folder;
  document::write_whole_file(folder / "file", "x");
  const auto failure = [&](const std::string& name) {
    return document::failure_of([&] { FrameFolder(folder / name, small_manifest()); });
  };
  EXPECT_TRUE(document::holds(failure("file"), "cannot create the folder")) << failure("file");
  EXPECT_TRUE(document::holds(failure("file/below"), "cannot create the folder")) << failure("file/below");
}

TEST(FrameFolder, WrongManifestsAreToldAndNotReplaced) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(document::holds(document::failure_of([&] { read_manifest(folder.path()); }), "it has no frames.json"));
  const auto failure_with = [&](const std::string& text) {
    document::write_whole_file(folder / "frames.json", text);
    const std::string failure = document::failure_of([&] { read_manifest(folder.path()); });
    EXPECT_TRUE(document::holds(failure, "frames.json: not a manifest of frames: ")) << text;
    EXPECT_TRUE(document::holds(failure, "(mars verify --repair ")) << text;
    EXPECT_FALSE(document::holds(failure, "exception")) << failure;
    EXPECT_EQ(failure_to_claim(folder.path(), small_manifest()), failure);
    EXPECT_EQ(document::read_file(folder / "frames.json"), text);
    return failure;
  };
  EXPECT_TRUE(document::holds(failure_with("{\n"), "byte 3 is no JSON, or the end is missing"));
  EXPECT_TRUE(document::holds(failure_with("[]"), "a list is not an object"));
  EXPECT_TRUE(document::holds(failure_with("{\"film\": 3}"), "film: 3 is not a text"));
  for (const char* text : {"", "\xff", "null"}) failure_with(text);
  const std::string head = R"({"film":"x","width":1,"height":1,"rate":24,"film_frames":4,)";
  const std::string sum = "\"checksum\":\"" + std::string(32, 'a') + "\",";
  document::write_whole_file(folder / "frames.json", head + sum + R"("frames":[[0,1]]})");
  EXPECT_EQ(document::failure_of([&] { read_manifest(folder.path()); }), "") << "else what follows is wrong anyway";
  for (const char* frames :
       {"[[0,4]]", "[[-1,2]]", "[[0]]", "[3]", "7", "[[0,1e300]]", "[[2,3],[0,1]]", "[[2,1]]",
        R"([[0,1]],"pixel_hashes":["x"])", R"([[0,0]],"pixel_hashes":[3])", R"([[0,0]],"pixel_hashes":["x"])"})
    failure_with(head + sum + "\"frames\":" + frames + "}");
  EXPECT_TRUE(document::holds(failure_with(head + sum + R"("frames":[[0,1]],"pixel\u001b_hashes":[]})"),
                              R"(the key "pixel\u001b_hashes" is unknown)"));
  EXPECT_TRUE(document::holds(failure_with(head + R"("frames":[[0,1]]})"), R"(the key "checksum" is missing)"));
  const std::string of_long =
      failure_with(head + R"("checksum":")" + std::string(100000, 'x') + R"(","frames":[[0,1]]})");
  EXPECT_TRUE(document::holds(of_long, "xxx... is not 32 hexadecimal digits")) << of_long.substr(0, 1000);
  EXPECT_LT(of_long.size(), 400u);
}

TEST(FrameFolder, AnotherFilmsFolderUnderAFramesNameIsToldWithARemedy) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "frame-0001.png/below");
  const std::string failure = failure_to_claim(folder.path(), small_manifest());
  EXPECT_TRUE(document::holds(failure, "frame-0001.png: cannot remove: Directory not empty (it is a folder with"))
      << failure;
}

TEST(FrameFolder, FramesOfAnotherFormatDoNotPassAsThisOnes) {
  const test::TemporaryFolder folder;
  fill(folder.path(), in_format(PictureFormat::png16), 7);
  {
    const FrameFolder running(folder.path(), in_format(PictureFormat::png));
    EXPECT_FALSE(fs::exists(folder / "frame-0001.png"));
    const std::string failure = failure_to_claim(folder.path(), in_format(PictureFormat::exr));
    EXPECT_TRUE(document::holds(failure, "another version, size or format of a film.json")) << failure;
  }
  EXPECT_EQ(read_manifest(folder.path()).format, PictureFormat::png);
  EXPECT_EQ(read_manifest(folder.path()).pixel_hashes, std::vector<std::string>(5));
}

}  // namespace
}  // namespace mars::sinks
