// Which folder may know what: scans the includes of every source file. MAP.md says the same in words.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/architecture/sources.h"

namespace {

namespace fs = std::filesystem;

using mars::test::read;
using mars::test::Source;
using mars::test::sources;

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

using Files = std::set<std::string>;

Files files_including(const std::regex& header) {
  Files files;
  for (const Source& source : sources())
    for (const std::string& include : source.includes)
      if (std::regex_search(include, header)) files.insert(source.path);
  return files;
}

// `part` is in every match, and quicker to find.
Files files_matching(const std::string& part, const std::regex& pattern) {
  Files files;
  for (const Source& source : sources())
    if (source.text.find(part) != std::string::npos && std::regex_search(source.text, pattern))
      files.insert(source.path);
  return files;
}

void expect_within(const Files& files, const std::string& folder) {
  EXPECT_FALSE(files.empty()) << "nothing to scan: the test is broken";
  for (const std::string& file : files) EXPECT_TRUE(begins(file, folder)) << file;
}

bool is_ours(const std::string& include) {
  return begins(include, "hal/") || begins(include, "host/") || begins(include, "node/") ||
         begins(include, "topology/") || begins(include, "tests/");
}

// Every include that begins with a folder of ours, from files below `from`, must satisfy `allowed`.
void expect_includes(const std::string& from, const std::function<bool(const std::string&)>& allowed) {
  int seen = 0;
  for (const Source& source : sources()) {
    if (!begins(source.path, from)) continue;
    ++seen;
    for (const std::string& include : source.includes) {
      EXPECT_TRUE(!is_ours(include) || allowed(include)) << source.path << " includes " << include;
    }
  }
  EXPECT_GT(seen, 0) << "no files below " << from;
}

TEST(Boundaries, MpiOnlyInItsBackend) { expect_within(files_including(std::regex("(^|/)mpi\\.h$")), "hal/mpi/"); }

TEST(Boundaries, HwlocOnlyInTopology) { expect_within(files_including(std::regex("hwloc")), "topology/"); }

TEST(Boundaries, PngInOneHostFile) {
  const Files files = files_including(std::regex("(^|/)png\\.h$"));
  ASSERT_EQ(files.size(), 1u);
  EXPECT_TRUE(begins(*files.begin(), "host/"));
}

TEST(Boundaries, OpenExrInOneHostFile) {
  EXPECT_EQ(files_including(std::regex("(^OpenEXR/|(^|/)Imf)")), Files{"host/images/exr_file.cpp"});
}

TEST(Boundaries, OpenColorIoInOneHostFile) {
  EXPECT_EQ(files_including(std::regex("OpenColorIO")), Files{"host/images/ocio_view.cpp"});
}

TEST(Boundaries, CliInItsHostFolder) {
  EXPECT_EQ(files_including(std::regex("^CLI/")), (Files{"host/cli/command.cpp", "host/cli/program.cpp"}));
}

TEST(Boundaries, MeshoptimizerInItsHostFolder) {
  expect_within(files_including(std::regex("^meshoptimizer.h")), "host/content/importer/gltf/");
}

TEST(Boundaries, AssimpInItsHostFolder) {
  expect_within(files_including(std::regex("^assimp/")), "host/content/importer/");
}

TEST(Boundaries, SdlInOneHostFile) {
  EXPECT_EQ(files_including(std::regex("(^|/)SDL[_a-z]*\\.h$")), Files{"host/window/screen/window.cpp"});
}

TEST(Boundaries, GetenvInOneSettingsFile) {
  EXPECT_EQ(files_matching("getenv", std::regex("\\b(secure_)?getenv\\s*\\(")), Files{"hal/messages/settings.cpp"});
}

// Whether the text calls a function of the C library's, also through GLM, not one of the same name in a namespace or
// class.
bool calls(const std::string& text, const std::string& function) {
  for (std::size_t at = text.find(function + "("); at != std::string::npos; at = text.find(function + "(", at + 1)) {
    const std::string before = text.substr(text.rfind('\n', at) + 1, at - text.rfind('\n', at) - 1);
    const bool libraries = before.ends_with("std::") || before.ends_with("glm::") || before == "::";
    const bool qualified = before.ends_with("::") && !libraries;
    const bool other = !before.empty() && (std::isalnum(before.back()) ||
                                           std::string_view("_.>").find(before.back()) != std::string_view::npos);
    if (!qualified && !other && before.find("//") == std::string::npos) return true;
  }
  return false;
}

// Their results depend on the C library's version and on the processor (host/content/elementary/elementary.h).
TEST(Boundaries, ElementaryFunctionsAreOurOwn) {
  Files files;
  for (const Source& source : sources())
    for (const char* function :
         {"sin", "cos",  "tan",   "sincos", "asin", "acos",  "atan",  "atan2", "sinh", "cosh", "tanh",
          "exp", "exp2", "expm1", "log",    "log2", "log10", "log1p", "pow",   "cbrt", "hypot"})
      for (const char* kind : {"", "f", "l"})
        if (!begins(source.path, "host/content/elementary/") && calls(source.text, std::string(function) + kind))
          files.insert(source.path);
  // Figures of experiments, forecasts and simulated machines, which are no part of a film.
  EXPECT_EQ(files, (Files{"hal/simulated/pace.cpp", "host/experiments/spread.cpp", "host/render/events/course.cpp"}));
}

// whole_file.h writes files; these would leave half of one, and follow links.
TEST(Boundaries, NoFileIsWrittenByStreams) {
  EXPECT_EQ(files_matching("ofstream", std::regex("\\bofstream\\b")), Files{});
  EXPECT_EQ(files_matching("fopen", std::regex("\\bfopen\\b")), Files{});
}

// Standard output with nothing made plain is for what moves a cursor.
TEST(Boundaries, FewWriteToTerminalsAsTheyLike) {
  EXPECT_EQ(files_matching("raw_", std::regex("\\braw_(output|error)\\(\\)")),
            (Files{"host/child/standard_streams.cpp", "host/child/standard_streams.h", "host/shell/batch/follow.cpp",
                   "host/shell/commands/shown_progress.h", "host/shell/launch/launch.cpp", "host/shell/nx/mpi_help.cpp",
                   "host/studio/link/host_job.cpp"}));
}

// In hal/ and topology/ each folder knows only itself and these.
TEST(Boundaries, HalRunsOneWay) {
  const std::vector<std::string> messages = {"hal/failure/", "topology/", "hal/messages/"};
  const std::map<std::string, std::vector<std::string>> known = {
      {"hal/failure/", {}},
      {"topology/", {"hal/failure/"}},
      {"hal/messages/", {"hal/failure/", "topology/"}},
      {"hal/collectives/", messages},
      {"hal/nx/", {"hal/failure/", "topology/", "hal/messages/", "hal/collectives/"}},
      // Transports know messages, not what is made of them.
      {"hal/mpi/", messages},
      {"hal/processes/", messages},
      {"hal/threads/", messages},
      {"hal/simulated/", messages},
      {"hal/template/", messages},
      // What makes other people's programs ranks stands above the transports.
      {"hal/program/", {"hal/failure/", "hal/messages/", "hal/nx/", "hal/mpi/", "hal/processes/"}},
      {"hal/fortran/", {"hal/nx/nx_"}},
  };
  for (const auto& [folder, others] : known)
    expect_includes(folder, [&](const std::string& include) {
      const auto within = [&](const std::string& other) { return begins(include, other); };
      return within(folder) || std::any_of(others.begin(), others.end(), within);
    });
  for (const auto& entry : fs::directory_iterator(fs::path(MARS_SOURCE_DIR) / "hal")) {
    const bool has_rule = known.count("hal/" + entry.path().filename().string() + "/") != 0;
    EXPECT_TRUE(has_rule || !entry.is_directory()) << entry.path() << " has no rule here";
  }
}

// The transports and what chooses between them.
bool is_transport(const std::string& include) {
  static const std::regex folders("^hal/(mpi|processes|threads|simulated|template|program)/");
  return std::regex_search(include, folders);
}

TEST(Boundaries, NodeDependsOnHalAlone) {
  expect_includes("node/", [](const std::string& i) {
    return begins(i, "node/") || (begins(i, "hal/") && !is_transport(i) && i != "hal/messages/settings.h");
  });
}

TEST(Boundaries, NodeOpensNoFileAndPrintsNothing) {
  const std::regex world(R"(^(fstream|iostream|ostream|cstdio|stdio\.h|filesystem|fcntl\.h|unistd\.h)$)");
  for (const std::string& file : files_including(world)) EXPECT_FALSE(begins(file, "node/")) << file;
}

// Of the node, the host knows the wire, pure shape, what a pixel is, how lines are divided and what memory shadows
// take; only programs link both
// sides, and choose a transport. What simulated machines are like, their processors, the ways between them and who uses
// their storage, forecasts read too.
TEST(Boundaries, HostAndNodeShareTheWire) {
  for (const Source& source : sources()) {
    if (!begins(source.path, "host/") || begins(source.path, "host/programs/")) continue;
    for (const std::string& include : source.includes) {
      EXPECT_TRUE(!begins(include, "node/") || begins(include, "node/wire/") || begins(include, "node/shape/") ||
                  include == "node/color/encoding.h" || include == "node/group/mapping.h" ||
                  include == "node/shadow/shadow_plan.h")
          << source.path << " includes " << include;
      const bool is_model = include == "hal/simulated/computers.h" || include == "hal/simulated/machine.h" ||
                            include == "hal/simulated/routes.h" || include == "hal/simulated/storage_use.h";
      EXPECT_FALSE(is_transport(include) && !is_model) << source.path << " includes " << include;
    }
  }
}

// What makes frames of a film runs one way, and knows nothing of a person's command line.
TEST(Boundaries, RenderingRunsOneWay) {
  std::vector<std::string> before = {"host/child/", "host/images/", "host/content/"};
  for (const char* part : {"compositor/", "pictures/", "sinks/", "resume/", "panorama/", "events/", "trace/", "watch/",
                           "walls/", "farm/", "report/", "session/", "serve/"}) {
    before.push_back(std::string("host/render/") + part);
    expect_includes(before.back(), [&](const std::string& include) {
      return !begins(include, "host/") ||
             std::any_of(before.begin(), before.end(), [&](const auto& folder) { return begins(include, folder); });
    });
  }
}

// From a model to what is seen of it, each tool knows only those before it; none knows the programs.
TEST(Boundaries, HostsToolsStandOnOneAnother) {
  const auto below = [](const std::string& from, const std::vector<std::string>& known) {
    expect_includes(from, [&](const std::string& include) {
      if (!begins(include, "host/") || begins(include, "host/content/elementary/")) return true;
      return std::any_of(known.begin(), known.end(), [&](const auto& folder) { return begins(include, folder); });
    });
  };
  const std::string keys = "host/content/keys/", document = "host/content/document/", modeler = "host/content/modeler/",
                    animator = "host/content/animator/";
  const std::string film = "host/content/film/", preview = "host/preview/", images = "host/images/",
                    child = "host/child/", cli = "host/cli/", window = "host/window/",
                    pictures = "host/render/pictures/", compositor = "host/render/compositor/", videos = "host/videos/";
  below("host/content/elementary/", {});
  below(child, {child});
  below(cli, {keys, document, cli});
  below(keys, {keys});
  below(document, {keys, document});
  below(modeler, {keys, document, modeler});
  below("host/content/importer/", {child, images, keys, document, modeler, animator, "host/content/importer/"});
  below(animator, {child, keys, document, modeler, animator});
  below(film, {keys, document, modeler, animator, film});
  below(images, {keys, document, images});
  below(window, {child, document, images, compositor, pictures, window});
  below(videos, {child, keys, document, modeler, animator, film, images, videos, "host/render/sinks/"});
  below(preview, {child, keys, document, modeler, animator, film, images, videos, preview, "host/render/sinks/",
                  compositor, pictures, "host/window/window_process.h"});
  below("host/editing/", {keys, document, modeler, animator, film, cli, "host/editing/"});
  below("host/studio/project/",
        {keys, document, modeler, animator, film, preview, images, "host/editing/", "host/studio/project/"});
  for (const Source& source : sources())
    for (const std::string& include : source.includes) {
      EXPECT_TRUE(!begins(include, "host/programs/") || begins(source.path, "host/programs/")) << source.path;
      EXPECT_TRUE(!begins(include, animator + "motion/") || begins(source.path, animator + "motion/") ||
                  begins(source.path, "host/editing/") || begins(source.path, "host/studio/project/animation.") ||
                  begins(source.path, "host/studio/stage/reach_") ||
                  begins(source.path, "host/studio/project/animation"))
          << source.path;
    }
}

// Each folder of `folders` in `parent` includes, of `parent`, only itself and those before it.
void expect_one_way(const std::string& parent, const std::vector<std::string>& folders) {
  std::vector<std::string> known;
  for (const std::string& folder : folders) {
    known.push_back(parent + folder + "/");
    expect_includes(known.back(), [&](const std::string& include) {
      return !begins(include, parent) ||
             std::any_of(known.begin(), known.end(), [&](const auto& before) { return begins(include, before); });
    });
  }
}

// firmware, renderer and tessellator know all folders of the list.
TEST(Boundaries, NodesFoldersStandOnOneAnother) {
  expect_one_way("node/", {"wire", "simd", "color", "shape", "geometry", "shading", "raster", "group"});
}

TEST(Boundaries, TheAnimatorsRoomsStandOnOneAnother) {
  const std::string animator = "host/content/animator/";
  expect_one_way(animator, {"pose", "reading", "keys", "settings", "listing"});
  expect_one_way(animator + "motion/", {"body", "scene", "gaits", "laws", "goals", "script"});
}

// What a file of ours includes, and what that includes, and so on.
Files reached_from(const Source& file) {
  Files reached;
  std::vector<std::string> left = file.includes;
  while (!left.empty()) {
    const std::string next = left.back();
    left.pop_back();
    if (!reached.insert(next).second) continue;
    for (const Source& source : sources())
      if (source.path == next) left.insert(left.end(), source.includes.begin(), source.includes.end());
  }
  return reached;
}

// What a film is needs no messages: of hal only failures, of node/ only what both sides share.
TEST(Boundaries, ContentKnowsNoMessages) {
  for (const char* folder : {"host/child/", "host/content/", "host/images/"})
    expect_includes(folder, [](const std::string& i) {
      return begins(i, "host/") || begins(i, "hal/failure/") || begins(i, "topology/") || begins(i, "node/wire/") ||
             begins(i, "node/shape/") || i == "node/color/encoding.h";
    });
}

// Processes are started in one place, for the programs' own jobs in hal/.
TEST(Boundaries, OnePlaceStartsProcesses) {
  const std::regex starting(R"(\b(fork|vfork|posix_spawnp?|execvp?e?|popen)\s*\()");
  Files files;
  for (const Source& source : sources())
    if (begins(source.path, "host/") && std::regex_search(source.text, starting)) files.insert(source.path);
  EXPECT_EQ(files, (Files{"host/child/exec.cpp", "host/child/process.cpp"}));
}

// Kernels are compiled for several CPUs: what they share with others must be plain, or the linker might take a wide
// CPU's copy of an inline function for all.
TEST(Boundaries, KernelsIncludeLittle) {
  const Files plain = {"node/geometry/eye_light.h",  "node/geometry/triangle.h", "node/raster/classified.h",
                       "node/raster/edge_box.h",     "node/raster/kernels.h",    "node/raster/line_load.h",
                       "node/shading/environment.h", "node/shading/kernels.h",   "node/shading/shading.h",
                       "node/shape/kernels.h",       "node/shadow/kernels.h",    "node/shadow/light_view.h",
                       "node/shadow/point_vector.h", "node/color/agx_tables.h",  "node/color/encoding.h",
                       "node/color/kernels.h",       "node/color/srgb_tables.h", "node/shape/sample_pattern.h",
                       "node/shape/vertices.h",      "node/simd/vector_slack.h", "node/simd/vectors.h",
                       "node/wire/film_parts.h",     "node/wire/pixel_format.h", "node/wire/run.h"};
  const Files standard = {"array", "bit", "cstddef", "cstdint", "cstring"};
  const std::regex kernels("^node/(\\w+/)+kernels/"), headers("^node/\\w+/kernels/\\w+\\.h$");
  int seen = 0;
  for (const Source& source : sources()) {
    if (!std::regex_search(source.path, kernels)) continue;
    ++seen;
    for (const std::string& include : reached_from(source))
      EXPECT_TRUE(plain.count(include) || standard.count(include) || include == "hwy/highway.h" ||
                  std::regex_search(include, headers))
          << source.path << " needs " << include;
  }
  EXPECT_GT(seen, 10) << "nothing to scan: the test is broken";
  expect_within(files_including(std::regex("^hwy/")), "node/simd/vectors.h");
  for (const std::string& file : files_including(std::regex("^node/simd/vectors\\.h$")))
    EXPECT_TRUE(std::regex_search(file, headers)) << file << " includes vectors";
}

// Frames are exact: only the peers of a benchmark, other people's renderers in our harness, may be built otherwise.
TEST(Boundaries, FastMathOnlyForPeers) {
  int scanned = 0;
  for (const char* folder : {"hal", "host", "node", "topology", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(MARS_SOURCE_DIR) / folder)) {
      if (entry.path().filename() != "CMakeLists.txt") continue;
      ++scanned;
      const std::string path = fs::relative(entry.path(), MARS_SOURCE_DIR).generic_string();
      const bool fast = std::regex_search(read(entry.path()), std::regex("fast-math|fp-contract=fast|Ofast"));
      EXPECT_TRUE(!fast || path == "tests/bench/peers/CMakeLists.txt") << path;
    }
  EXPECT_GT(scanned, 10) << "nothing to scan: the test is broken";
  const std::string root = read(fs::path(MARS_SOURCE_DIR) / "CMakeLists.txt");
  EXPECT_FALSE(std::regex_search(root, std::regex("fast-math|fp-contract=fast|Ofast")));
  EXPECT_NE(root.find("-ffp-contract=off"), std::string::npos);
}

}  // namespace
