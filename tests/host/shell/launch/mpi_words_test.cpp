// Open MPI's messages as it writes them, wrapped and among others.
#include "host/shell/launch/mpi_words.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tests/host/content/document/failure_of.h"

namespace mars::launch {
namespace {

const std::string kThere =
    " (install it there, or name its folder in LD_LIBRARY_PATH (module load ...) where you start: MARS hands it on; or "
    "install MARS by cmake --install, whose programs know the folders of their libraries)";

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
  EXPECT_TRUE(document::holds(meaning("The PMIx server's listener thread failed to start. We cannot\ncontinue.\n"),
                              "127.0.0.1"));
  EXPECT_EQ(meaning("something else went wrong\n"), "");
}

TEST(MpiWords, NameTheMachineThatHasNoProgram) {
  const std::string program = "there is no program /opt/mars-node that can be run (put them under the same path";
  EXPECT_TRUE(document::holds(
      meaning(
          "mpirun was unable to launch the specified application as it could not access\nor execute an executable:\n"
          "\nExecutable: /opt/mars-node\nNode: n3\n\nwhile attempting to start process rank 4.\n"),
      "machine n3: " + program));
  EXPECT_TRUE(document::holds(
      meaning("mpirun was unable to find the specified executable file, and therefore\ndid not launch the "
              "job.\nNode:       n2\nExecutable: /opt/mars-node\n"),
      "machine n2: " + program));
}

// As printed where the library is missing on n2 of n1 to n4, of two slots each.
TEST(MpiWords, NameTheLibraryAndTheMachineThatLacksIt) {
  const std::string words =
      "/opt/mars-node: error while loading shared libraries: libpng16.so.16: cannot open shared object file: No such "
      "file or directory\n-----\nmpirun detected that one or more processes exited with non-zero status, thus causing\n"
      "the job to be terminated. The first process to do so was:\n\n  Process name: [[6930,1],2]\n  Exit code:    "
      "127\n";
  const std::string missing = "/opt/mars-node cannot load the library libpng16.so.16";
  EXPECT_EQ(meaning_of(words, {{"n1", 2}, {"n2", 2}, {"n3", 2}, {"n4", 2}})->what(), "machine n2: " + missing + kThere);
  EXPECT_EQ(meaning_of(words, {{"n1", 1}, {"n2", 1}})->what(), missing + kThere) << "more ranks than slots";
  EXPECT_EQ(meaning(words), missing + kThere);
  EXPECT_EQ(meaning("orted: error while loading shared libraries: libopen-rte.so.40: cannot open shared object file\n"
                    "ORTE was unable to reliably start one or more daemons.\n"),
            "orted cannot load the library libopen-rte.so.40" + kThere);
  for (const char* cut : {"error while loading shared libraries:", ": error while loading shared libraries: x",
                          "a: error while loading shared libraries:  "})
    EXPECT_EQ(meaning(cut), "a machine lacks a library that MARS was built with" + kThere);
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
