// Open MPI's messages as it writes them, wrapped and among others.
#include "host/shell/launch/mpi_words.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/host/content/document/failure_of.h"

namespace mars::launch {
namespace {

std::string meaning(const std::string& text) {
  const auto known = meaning_of(text);
  return known ? known->what() : "";
}

TEST(MpiWords, AreUnderstoodWhereverTheirLinesBreak) {
  EXPECT_TRUE(
      document::holds(meaning("--------\nmpirun was unable to launch the specified application as it could not access\n"
                              "or execute an executable:\n\nExecutable: /opt/mars-node\nNode: n2\n"),
                      "same path on every machine"));
  EXPECT_TRUE(document::holds(meaning("A call to mkdir was unable to create the desired directory:\n\n"
                                      "  Directory: /tmp/ompi.ada.0\n  Error:     Read-only file system\n"),
                              "set TMPDIR"));
  EXPECT_TRUE(document::holds(
      meaning("Permission denied (publickey).\nORTE was unable to reliably start one or more daemons.\n"),
      "without a password"));
  EXPECT_TRUE(document::holds(meaning("[mpiexec@ada] match_arg: unrecognized argument oversubscribe\n"),
                              "MPI that MARS was built with"));
  EXPECT_TRUE(document::holds(meaning("mars-node: error while loading shared libraries: libmpi.so.40: cannot open"),
                              "module load"));
  EXPECT_TRUE(document::holds(meaning("The PMIx server's listener thread failed to start. We cannot\ncontinue.\n"),
                              "127.0.0.1"));
  EXPECT_EQ(meaning("something else went wrong\n"), "");
}

TEST(MpiWords, EachHasARemedyAndStandsInTheDocuments) {
  std::ifstream file(MARS_SOURCE_DIR "/docs/doctor.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const MpiWords& each : mpi_words()) {
    EXPECT_STRNE(each.problem, "");
    EXPECT_STRNE(each.remedy, "");
    EXPECT_TRUE(document::holds(page, std::string(each.words))) << each.words;
  }
}

}  // namespace
}  // namespace mars::launch
