#include "host/shell/options/render_options.h"

#include <gtest/gtest.h>

#include <fstream>

#include "host/cli/program.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::options {
namespace {

using Words = std::vector<std::string>;

constexpr Program kPrograms[] = {Program::mars, Program::host, Program::ranks, Program::threads};

struct Reading {
  RenderOptions options;
  std::optional<int> code;
  std::string printed;
};

Reading read(Program program, const Words& words) {
  Reading reading;
  cli::Program app("test", "a test");
  add_render_options(app, reading.options, program);
  std::vector<const char*> argv{"test"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  reading.code = app.read(static_cast<int>(argv.size()), argv.data());
  reading.printed = testing::internal::GetCapturedStderr();
  reading.printed += testing::internal::GetCapturedStdout();
  return reading;
}

// Everything different from its default.
RenderOptions unusual() {
  RenderOptions options;
  options.film = "film.json";
  options.folder = "a folder";
  options.nodes = 7;
  options.backend = Backend::threads;
  options.frames = film::FrameSet("0-9,24,30-");
  options.size = images::PictureSize{33, 44};
  options.samples = 8;
  options.mapping = wire::Mapping::optimal;
  options.intervals = Intervals::keyframes;
  options.no_coherence = true;
  options.block = 5;
  options.groups = 3;
  options.overwrite = true;
  options.force = true;
  options.kept_film = true;
  options.write = WriteWhere::host;
  options.format = images::PictureFormat::exr;
  options.compression = images::Compression::piz;
  options.alpha = true;
  options.crop = film::Crop{1, 2, 30, 40};
  options.margin = 5;
  options.name = "shot_##";
  options.first_number = 1001;
  options.report = "report.json";
  options.trace = "trace.json";
  options.window = true;
  options.quiet = true;
  return options;
}

TEST(RenderOptions, DefaultsNeedTheFilmAndAFolderAlone) {
  const Words words{"film.json", "-o", "out"};
  const Reading reading = read(Program::mars, words);
  EXPECT_EQ(reading.code, std::nullopt) << reading.printed;
  RenderOptions expected;
  expected.film = "film.json";
  expected.folder = "out";
  EXPECT_EQ(reading.options, expected);
  EXPECT_EQ(arguments_for(Program::mars, expected), words);
}

TEST(RenderOptions, GoRoundThroughACommandLine) {
  const Reading reading = read(Program::mars, arguments_for(Program::mars, unusual()));
  EXPECT_EQ(reading.code, std::nullopt) << reading.printed;
  EXPECT_EQ(reading.options, unusual());
  EXPECT_EQ(read(Program::mars, {"film.json", "--sink", "none"}).options.sink, SinkKind::none);
}

TEST(RenderOptions, TheOutputMayNameTheFiles) {
  const auto read_output = [](const Words& more) {
    Words words{"film.json"};
    words.insert(words.end(), more.begin(), more.end());
    return read(Program::mars, words);
  };
  for (const auto& [words, folder, name, format] :
       {std::tuple{Words{"-o", "a/shot_####.png"}, "a", "shot_####", images::PictureFormat::png},
        {Words{"-o", "shot_%03d.exr"}, ".", "shot_###", images::PictureFormat::exr},
        {Words{"-o", "a/b/##", "--format", "exr"}, "a/b", "##", images::PictureFormat::exr},
        {Words{"-o", "/#.png", "--format", "png16"}, "/", "#", images::PictureFormat::png16},
        {Words{"-o", "take#3"}, "take#3", "", images::PictureFormat::png},
        {Words{"-o", "a", "--name", "shot_"}, "a", "shot_####", images::PictureFormat::png},
        {Words{"-o", "a", "--name", "%d.exr"}, "a", "#", images::PictureFormat::exr}}) {
    const Reading reading = read_output(words);
    EXPECT_EQ(reading.code, std::nullopt) << reading.printed;
    EXPECT_EQ(reading.options.folder, folder);
    EXPECT_EQ(reading.options.name, name);
    EXPECT_EQ(reading.options.format, format);
  }
  EXPECT_TRUE(document::holds(read_output({"-o", "a/#.png", "--format", "exr"}).printed, "is no name of exr files"));
  EXPECT_TRUE(
      document::holds(read_output({"-o", "a/#.exr", "--format", "png16"}).printed, "is no name of png16 files"));
  EXPECT_TRUE(document::holds(read_output({"-o", "a", "--name", "#.exr", "--format", "png"}).printed,
                              "is no name of png files"));
  EXPECT_TRUE(document::holds(read_output({"-o", "a/#.png", "--name", "b"}).printed, "two names"));
  EXPECT_TRUE(document::holds(read_output({"-o", "a/##_##.png"}).printed, "more than one number"));
  EXPECT_TRUE(document::holds(read_output({"-o", "a", "--compression", "piz"}).printed, "PNG files have one"));
  EXPECT_TRUE(document::holds(read_output({"-o", "a", "--compression", "zip"}).printed, "PNG files have one"));
  EXPECT_TRUE(
      document::holds(read_output({"-o", "a", "--format", "exr", "--compression", "dwaa"}).printed, "'dwaa' is not"));
}

TEST(RenderOptions, EveryStepsThroughTheFrames) {
  for (const Program program : {Program::mars, Program::plan}) {
    Words words{"film.json", "--frames", "0-9,12-", "--every", "3"};
    if (program == Program::mars) words.insert(words.end(), {"-o", "out"});
    const Reading reading = read(program, words);
    EXPECT_EQ(reading.code, std::nullopt) << reading.printed;
    EXPECT_EQ(reading.options.frames, film::FrameSet("0-9x3,12-x3"));
  }
  EXPECT_TRUE(document::holds(read(Program::mars, {"film.json", "-o", "out", "--every", "0"}).printed, "'0' is not"));
}

TEST(RenderOptions, EveryProgramGetsWhatConcernsIt) {
  for (const Program program : kPrograms) {
    RenderOptions expected = unusual();
    const bool starts_nodes = program == Program::mars || program == Program::threads;
    if (!starts_nodes) expected.nodes = 0;
    if (!starts_nodes) expected.force = false;
    if (program != Program::mars) expected.backend = Backend::automatic;
    if (program != Program::mars) expected.quiet = expected.window = false;
    const Reading reading = read(program, arguments_for(program, unusual()));
    EXPECT_EQ(reading.code, std::nullopt) << reading.printed;
    EXPECT_EQ(reading.options, expected) << static_cast<unsigned>(program);
  }
}

TEST(RenderOptions, NamesMayBeginWithADash) {
  RenderOptions options;
  options.film = "-film.json";
  options.folder = "--frames";
  options.report = "-";
  const Reading reading = read(Program::host, arguments_for(Program::host, options));
  EXPECT_EQ(reading.code, std::nullopt) << reading.printed;
  EXPECT_EQ(reading.options.film, "./-film.json");
  EXPECT_EQ(reading.options.folder, "./--frames");
  EXPECT_EQ(reading.options.report, "./-");
}

TEST(RenderOptions, FormerNamesAreRefusedWithTheNewOne) {
  for (const Program program : {Program::mars, Program::host, Program::ranks, Program::threads}) {
    const Reading reading = read(program, {"film.json", "--cubes", "2"});
    EXPECT_EQ(reading.code, cli::kUsage);
    EXPECT_TRUE(document::holds(reading.printed, "--cubes: use --groups")) << reading.printed;
  }
  EXPECT_FALSE(document::holds(read(Program::mars, {"--help"}).printed, "cubes"));
}

TEST(RenderOptions, WrongValuesAreUsageErrorsThatNameTheOption) {
  const std::pair<Words, const char*> wrong[] = {
      {{"--nodes", "0"}, "not a number from 1"},
      {{"--nodes", "-1"}, "not a number from 1"},
      {{"--nodes", "auto"}, "not a number from 1"},
      {{"--nodes", "3x"}, "not a number from 1"},
      {{"--groups", "0"}, "or auto"},
      {{"--block", "99999"}, "from 1 to 16384"},
      {{"--backend", "pvm"}, "auto or mpi or threads"},
      {{"--mapping", ""}, "greedy or optimal or cost"},
      {{"--intervals", "x"}, "auto or keyframes"},
      {{"--sink", "gif"}, "files or none"},
      {{"--format", "gif"}, "png or png16 or exr"},
      {{"--size", "960"}, "is not a size"},
      {{"--size", "960x"}, "is not a size"},
      {{"--size", "0x5"}, "between 1x1 and 16384"},
      {{"--size", "20000x5"}, "between 1x1 and 16384"},
      {{"--size", "5x5x5"}, "is not a size"},
      {{"--frames", "9-1"}, "ends before it begins"},
      {{"--samples", "3"}, "is not 1, 2, 4, 8 or 16"},
      {{"--samples", "32"}, "is not 1, 2, 4, 8 or 16"},
      {{"--samples", "many"}, "is not 1, 2, 4, 8 or 16"},
  };
  for (const auto& [words, reason] : wrong) {
    const Reading reading = read(Program::mars, {"film.json", words[0], words[1]});
    EXPECT_EQ(reading.code, cli::kUsage) << words[0] << " " << words[1];
    EXPECT_TRUE(document::holds(reading.printed, words[0])) << reading.printed;
    EXPECT_TRUE(document::holds(reading.printed, reason)) << reading.printed;
  }
}

TEST(RenderOptions, UnknownOrMissingWordsAreUsageErrors) {
  EXPECT_TRUE(document::holds(read(Program::mars, {}).printed, "FILM is required"));
  EXPECT_TRUE(document::holds(read(Program::mars, {"film.json", "--bogus"}).printed, "--bogus"));
  EXPECT_TRUE(document::holds(read(Program::mars, {"film.json", "--nodes"}).printed, "--nodes"));
  EXPECT_EQ(read(Program::mars, {"a.json", "b.json"}).code, cli::kUsage);
  EXPECT_EQ(read(Program::host, {"film.json", "--nodes", "3"}).code, cli::kUsage) << "MPI knows the nodes";
}

// mars compile adds an output of its own.
TEST(RenderOptions, CompilingTakesWhatShapesTheFilm) {
  const Reading reading = read(Program::compile, {"film.json", "--size", "4x3", "--intervals", "keyframes"});
  EXPECT_EQ(reading.code, std::nullopt) << reading.printed;
  EXPECT_EQ(reading.options.size, (images::PictureSize{4, 3}));
  EXPECT_EQ(read(Program::compile, {"film.json", "-o", "x"}).code, cli::kUsage);
}

TEST(RenderOptions, CubesMayBeAuto) {
  EXPECT_EQ(read(Program::mars, {"film.json", "--groups", "auto"}).options.groups, 0u);
  EXPECT_EQ(read(Program::mars, {"film.json", "--groups", "1"}).options.groups, 1u);
}

// Every option's help shows how it is written.
TEST(RenderOptions, EveryOptionHasAnExample) {
  for (const Program program : kPrograms) {
    cli::Program app("test", "a test");
    RenderOptions options;
    add_render_options(app, options, program);
    for (const cli::Option& option : app.options())
      EXPECT_TRUE(document::holds(option.help(), "Example: ")) << option.name();
  }
  EXPECT_EQ(read(Program::mars, {"--help"}).code, 0);
}

TEST(RenderOptions, AStudioIsServedWithoutFilmAndFolder) {
  for (const Program program : {Program::host, Program::threads}) {
    const Reading reading = read(program, {"--serve", "-socket", "--mapping", "greedy"});
    EXPECT_FALSE(reading.code) << reading.printed;
    EXPECT_EQ(reading.options.serve, "-socket");
    EXPECT_EQ(arguments_for(program, reading.options), (Words{"--mapping", "greedy", "--serve", "./-socket"}));
    EXPECT_EQ(read(program, {"film.json", "--serve", "socket"}).code, cli::kUsage);
  }
  EXPECT_EQ(read(Program::mars, {"--serve", "socket"}).code, cli::kUsage);
}

TEST(RenderOptions, FramesNeedAFolderOrNoSink) {
  for (const Program program : {Program::mars, Program::host, Program::ranks, Program::threads}) {
    const Reading reading = read(program, {"film.json"});
    EXPECT_EQ(reading.code, cli::kUsage);
    EXPECT_TRUE(document::holds(reading.printed, "add -o DIR"));
    EXPECT_EQ(read(program, {"film.json", "--sink", "none"}).code, std::nullopt);
  }
  EXPECT_EQ(read(Program::compile, {"film.json"}).code, std::nullopt);
}

TEST(RenderOptions, VeryManyNodesOfACoreAskForForce) {
  RenderOptions options;
  const auto failure = [&] { return document::failure_of([&] { check_nodes(options, 2); }); };
  options.nodes = 128;
  EXPECT_EQ(failure(), "");
  options.nodes = 100000;
  EXPECT_EQ(failure(), "--nodes: 100000 nodes are more than 64 for each of 2 cores (use up to 128, or add --force)");
  options.force = true;
  EXPECT_EQ(failure(), "");
  options.force = false;
  options.backend = Backend::simulated;
  EXPECT_EQ(failure(), "") << "they take turns";
}

TEST(RenderOptions, OutputsAreAFolderAndVideos) {
  const Words words{"film.json", "-o", "out", "-o", "a.mp4", "-o", "b.WEBM", "--codec", "vp9", "--quality", "30"};
  const Reading reading = read(Program::mars, words);
  EXPECT_EQ(reading.code, std::nullopt) << reading.printed;
  EXPECT_EQ(reading.options.folder, "out");
  EXPECT_EQ(reading.options.videos, (Words{"a.mp4", "b.WEBM"}));
  EXPECT_EQ(arguments_for(Program::mars, reading.options), words);
  EXPECT_EQ(arguments_for(Program::host, reading.options), (Words{"film.json", "-o", "out"})) << "mars makes videos";
}

TEST(RenderOptions, FormsOfVideosNeedAVideo) {
  for (const Program program : {Program::mars, Program::submit})
    for (const Words& form : {Words{"--codec", "h264"}, {"--quality", "20"}}) {
      const Reading reading = read(program, {"film.json", "-o", "out", form[0], form[1]});
      EXPECT_EQ(reading.code, cli::kUsage);
      EXPECT_TRUE(document::holds(reading.printed, "there is no video that " + form[0])) << reading.printed;
    }
}

TEST(RenderOptions, WordsAboutFilesNeedFiles) {
  for (const Program program : {Program::mars, Program::host, Program::ranks, Program::threads})
    for (const Words& more : {Words{"--name", "shot_##"}, {"--first-number", "7"}, {"--overwrite"}}) {
      Words words{"film.json", "--sink", "none"};
      words.insert(words.end(), more.begin(), more.end());
      const Reading reading = read(program, words);
      EXPECT_EQ(reading.code, cli::kUsage);
      EXPECT_TRUE(document::holds(reading.printed, more[0] + " is about files, of which --sink none writes none"))
          << reading.printed;
    }
  const Reading reading = read(Program::mars, {"film.json", "-o", "a/shot_##.png", "--sink", "none"});
  EXPECT_TRUE(document::holds(reading.printed, "'a/shot_##.png' names files, of which --sink none writes none"));
  const Words folder{"film.json", "-o", "out", "--sink", "none"};
  EXPECT_TRUE(document::holds(read(Program::mars, folder).printed, "-o is about files, of which --sink none writes"));
  EXPECT_EQ(read(Program::host, folder).code, std::nullopt);
}

TEST(RenderOptions, WhatIsWrittenHasAFileOfItsOwn) {
  const auto refusal = [](const Words& more) {
    Words words{"film.json", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return read(Program::mars, words).printed;
  };
  for (const Words& more : {Words{"-o", "r.mp4", "--report", "r.mp4"},
                            {"-o", "r.mp4", "--trace", "x/../r.mp4"},
                            {"-o", "r.mp4", "-o", "./r.mp4"},
                            {"--report", "r.json", "--trace", "./r.json"}})
    EXPECT_TRUE(document::holds(refusal(more), "is named for two things that are written")) << more[3];
  const test::TemporaryFolder folder;
  const std::string hosts = folder / "hosts";
  std::ofstream(hosts) << "n1 slots=2\n";
  EXPECT_TRUE(document::holds(refusal({"--hostfile", hosts, "--report", hosts}), "is the file that is read"));
  EXPECT_EQ(refusal({"-o", "r.mp4", "--report", "r.json", "--trace", "t.json"}), "");
  const std::string too_long(300, 'r');
  EXPECT_EQ(refusal({"--report", too_long}), "") << "writing it fails, with a remedy";
  EXPECT_TRUE(document::holds(refusal({"--report", too_long, "--trace", "./" + too_long}), "for two things"));
}

TEST(RenderOptions, AVideoAloneHasAFolderOfItsOwn) {
  const Reading reading = read(Program::submit, {"film.json", "-o", "a/b.mp4"});
  EXPECT_EQ(reading.options.folder, "a/b.mp4.mars-work/frames");
  EXPECT_TRUE(reading.options.own_folder);
  EXPECT_EQ(arguments_for(Program::submit, reading.options), (Words{"film.json", "-o", "a/b.mp4"}));
  EXPECT_EQ(arguments_for(Program::threads, reading.options), (Words{"film.json", "-o", "a/b.mp4.mars-work/frames"}));
  EXPECT_EQ(read(Program::host, {"film.json", "-o", "b.mp4"}).code, cli::kUsage);
}

TEST(RenderOptions, AFolderThatAPersonNamesIsNotTheVideosOwn) {
  const Reading reading = read(Program::mars, {"film.json", "-o", "b.mp4.mars-work/frames", "-o", "b.mp4"});
  EXPECT_FALSE(reading.options.own_folder);
}

TEST(RenderOptions, ANumberInAVideosNameIsNoFrames) {
  for (const std::string video : {"a/b%d.mp4", "b##.mp4"}) {
    const Reading reading = read(Program::mars, {"film.json", "-o", video});
    EXPECT_EQ(reading.options.folder, video + ".mars-work/frames");
    EXPECT_EQ(reading.options.name, "");
    const Words words = arguments_for(Program::threads, reading.options);
    EXPECT_EQ(words, (Words{"film.json", "-o", video + ".mars-work/frames"}));
    EXPECT_EQ(read(Program::threads, words).options.name, "") << "no names of files either";
  }
}

TEST(RenderOptions, NamesOfFramesMayBeginWithADash) {
  const Reading reading = read(Program::mars, {"film.json", "-o", "a/-x_####.png"});
  EXPECT_EQ(reading.options.name, "-x_####");
  const Words words = arguments_for(Program::threads, reading.options);
  EXPECT_EQ(words, (Words{"film.json", "-o", "a", "--name=-x_####"}));
  EXPECT_EQ(read(Program::threads, words).options.name, "-x_####");
}

TEST(RenderOptions, FoldersHaveNoNamesOfOtherVideosAndPictures) {
  const auto refusal = [](const Words& words) {
    const Reading reading = read(Program::mars, words);
    return reading.code == cli::kUsage ? reading.printed : "";
  };
  for (const char* name : {"x.png", "x.exr", "x.jpg"})
    EXPECT_TRUE(document::holds(refusal({"film.json", "-o", name}), "frames are files of their own (give -o x"))
        << name;
  EXPECT_TRUE(document::holds(refusal({"film.json", "-o", "x.avi"}), "(videos are .mp4, .m4v, .mov"));
  const test::TemporaryFolder folder;
  const std::string there = folder / "x.mp4";
  std::filesystem::create_directory(there);
  EXPECT_EQ(read(Program::mars, {"film.json", "-o", there}).options.folder, there)
      << "a folder of this name may be gone on with";
  for (const char* name : {"x", "x.mp4/", "mp4", ".png", "x.d", "scene.1"})
    EXPECT_EQ(read(Program::mars, {"film.json", "-o", name}).options.folder, name);
}

TEST(RenderOptions, FacesShowNoMotion) {
  const auto reading = [](const char* layers) {
    return read(Program::mars, {"film.json", "-o", "out", "--format", "exr", "--faces", "--layers", layers});
  };
  EXPECT_EQ(reading("depth,ids").code, std::nullopt);
  EXPECT_TRUE(document::holds(reading("all").printed, "faces of a panorama show no motion"));
}

}  // namespace
}  // namespace mars::options
