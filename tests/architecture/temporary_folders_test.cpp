// Tests write into folders of their own: in C++ those of tests/temporary_folder.h, in Python those of
// tempfile.TemporaryDirectory. No two processes have the same folder, and nothing is left. So nothing else makes
// temporary files, and no test names a place in /tmp.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "tests/architecture/sources.h"

namespace {

namespace fs = std::filesystem;

// What makes a temporary file or folder that nobody removes, or the name of one.
const std::set<std::string> kMakers = {
    "temp_directory_path", "mkdtemp", "mkstemp", "mktemp", "mkostemp", "tmpnam", "tempnam", "tmpfile", "TempDir",
    "gettempdir",          "\"/tmp"};

const std::map<std::string, std::string> kMayUseThem = {
    {"tests/temporary_folder.h", "removes what it makes"},
    {"tests/architecture/temporary_folders_test.cpp", "only names them"},
    {"tests/bench/peers/peers.py", "makes folders within one that is removed"},
    {"tests/bare/bare_debian.sh", "removes what it makes"},
    {"tests/programs/display.py", "removes what a killed X server leaves where all of them have their sockets"},
    {"tests/programs/storage_test.py", "makes its temporary folders there, for mounts"},
    {"tests/cluster/virtual_cluster.py", "each host of a virtual cluster has a /tmp of its own"},
    {"tests/programs/local_jobs_test.py", "an epilog cleans it, and the test removes what stays"},
    {"tests/cluster/losses_test.py", "each host of a virtual cluster has a /tmp of its own"},
    {"tests/cluster/rendering_test.py", "each host of a virtual cluster has a /tmp of its own"},
    {"tests/bench/faults/cluster.py", "each host of a virtual cluster has a /tmp of its own"},
    {"tests/bench/soak/soak_test.py", "only names a file"},
    {"tests/host/shell/doctor/checks_test.cpp", "only names the folder"},
    {"tests/host/shell/doctor/show_test.cpp", "only names a folder"},
    {"tests/host/studio/rendering/rendering_test.cpp", "the studio refuses the folder"},
};

TEST(TemporaryFolders, AreMadeInOnePlace) {
  int seen = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(MARS_SOURCE_DIR) / "tests")) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".h" && ending != ".cpp" && ending != ".py" && ending != ".sh") continue;
    ++seen;
    const std::string path = fs::relative(entry.path(), MARS_SOURCE_DIR).generic_string();
    const std::string text = mars::test::read(entry.path());
    for (const std::string& maker : kMakers)
      EXPECT_TRUE(text.find(maker) == std::string::npos || kMayUseThem.count(path) == 1) << path << " uses " << maker;
  }
  EXPECT_GT(seen, 400) << "nothing to scan: the test is broken";
}

}  // namespace
