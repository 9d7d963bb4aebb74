// Which folder may know what: scans the includes of every source file. MAP.md says the same in words.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <regex>
#include <set>
#include <string>
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

void expect_within(const Files& files, const std::string& folder) {
  EXPECT_FALSE(files.empty()) << "nothing to scan: the test is broken";
  for (const std::string& file : files) EXPECT_TRUE(begins(file, folder)) << file;
}

// Every include that begins with a folder of ours, from files below `from`, must satisfy `allowed`.
void expect_includes(const std::string& from, const std::function<bool(const std::string&)>& allowed) {
  int seen = 0;
  for (const Source& source : sources()) {
    if (!begins(source.path, from)) continue;
    ++seen;
    for (const std::string& include : source.includes) {
      const bool ours = begins(include, "hal/") || begins(include, "host/") || begins(include, "node/") ||
                        begins(include, "topology/") || begins(include, "tests/");
      EXPECT_TRUE(!ours || allowed(include)) << source.path << " includes " << include;
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

TEST(Boundaries, AssimpInItsHostFolder) { expect_within(files_including(std::regex("^assimp/")), "host/content/importer/"); }

TEST(Boundaries, GetenvInOneSettingsFile) {
  Files files;
  for (const Source& source : sources())
    if (std::regex_search(source.text, std::regex("\\b(secure_)?getenv\\s*\\("))) files.insert(source.path);
  EXPECT_EQ(files, Files{"hal/messages/settings.cpp"});
}

TEST(Boundaries, TopologyDependsOnNothing) {
  expect_includes("topology/", [](const std::string& i) { return begins(i, "topology/"); });
}

TEST(Boundaries, FailureDependsOnNothing) {
  expect_includes("hal/failure/failure.", [](const std::string& i) { return i == "hal/failure/failure.h"; });
}

TEST(Boundaries, HalDependsOnTopologyAlone) {
  expect_includes("hal/", [](const std::string& i) { return begins(i, "hal/") || begins(i, "topology/"); });
}

TEST(Boundaries, NodeDependsOnHalAlone) {
  expect_includes("node/", [](const std::string& i) {
    const bool backend = begins(i, "hal/mpi/") || begins(i, "hal/threads/") || i == "hal/messages/settings.h";
    return begins(i, "node/") || (begins(i, "hal/") && !backend);
  });
}

TEST(Boundaries, NodeOpensNoFileAndPrintsNothing) {
  const std::regex world(R"(^(fstream|iostream|ostream|cstdio|stdio\.h|filesystem|fcntl\.h|unistd\.h)$)");
  for (const std::string& file : files_including(world)) EXPECT_FALSE(begins(file, "node/")) << file;
}

// Of the node, the host knows the protocol, the film and pure shape; only programs link both sides.
TEST(Boundaries, HostAndNodeShareTheProtocol) {
  const Files shared = {"node/wire/protocol.h", "node/wire/stamp.h", "node/wire/film.h", "node/shape/bezier.h", "node/shape/dice.h"};
  for (const Source& source : sources()) {
    if (!begins(source.path, "host/") || begins(source.path, "host/programs/")) continue;
    for (const std::string& include : source.includes) {
      EXPECT_TRUE(!begins(include, "node/") || shared.count(include)) << source.path << " includes " << include;
      EXPECT_FALSE(begins(include, "hal/mpi/") || begins(include, "hal/threads/")) << source.path;
    }
  }
}

// What makes frames of a film runs one way, and knows nothing of a person's command line.
TEST(Boundaries, RenderingRunsOneWay) {
  std::vector<std::string> before = {"host/images/", "host/content/"};
  for (const char* part : {"compositor/", "sinks/", "events/", "trace/", "farm/", "report/", "session/"}) {
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
      if (!begins(include, "host/")) return true;
      return std::any_of(known.begin(), known.end(), [&](const auto& folder) { return begins(include, folder); });
    });
  };
  const std::string document = "host/content/document/", modeler = "host/content/modeler/", animator = "host/content/animator/";
  const std::string film = "host/content/film/", preview = "host/preview/", sinks = "host/render/sinks/", options = "host/shell/options/";
  below(document, {document});
  below(modeler, {document, modeler});
  below("host/content/importer/", {document, modeler, "host/content/importer/"});
  below(animator, {document, modeler, animator});
  below(film, {document, modeler, animator, film, sinks});
  below(preview, {document, modeler, animator, film, preview, sinks, options});
  for (const Source& source : sources())
    for (const std::string& include : source.includes) {
      EXPECT_TRUE(!begins(include, "host/programs/") || begins(source.path, "host/programs/")) << source.path;
      EXPECT_TRUE(!begins(include, animator + "motion/") || begins(source.path, animator + "motion/") ||
                  begins(source.path, "host/programs/"))
          << source.path;
    }
}

// Kernels are compiled for several CPUs: what they share with others must be plain, or the linker might take a wide
// CPU's copy of an inline function for all.
TEST(Boundaries, KernelsIncludeLittle) {
  const Files allowed = {"bit", "cstddef", "cstring", "hwy/highway.h", "node/simd/kernels.h", "node/simd/simd.h"};
  int seen = 0;
  for (const Source& source : sources()) {
    if (!begins(source.path, "node/simd/kernels/")) continue;
    ++seen;
    for (const std::string& include : source.includes)
      EXPECT_TRUE(allowed.count(include)) << source.path << " includes " << include;
  }
  EXPECT_GT(seen, 5) << "nothing to scan: the test is broken";
  expect_within(files_including(std::regex("^hwy/")), "node/simd/kernels/");
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
