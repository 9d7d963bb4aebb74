// Which files were read, and what changes a file's stamp.
#include "host/content/document/recorded_reads.h"

#include <gtest/gtest.h>

#include <thread>

#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::document {
namespace {

TEST(RecordedReads, HoldWhatIsReadWhileTheyLiveAlsoInVain) {
  const test::TemporaryFolder folder;
  for (const char* name : {"before", "read", "start", "exists", "inner", "elsewhere", "pieces"})
    write_whole_file(folder / name, name);
  read_file(folder / "before");
  RecordedReads reads;
  EXPECT_EQ(read_file(folder / "read"), "read");
  EXPECT_EQ(read_start(folder / "start", 3), "sta");
  EXPECT_EQ(read_start(folder / "start", 30), "start");
  EXPECT_EQ(read_start(folder / "none", 3), "");
  std::string pieces;
  EXPECT_TRUE(read_pieces(folder / "pieces", [&](std::string_view piece) { pieces += piece; }));
  EXPECT_EQ(pieces, "pieces");
  EXPECT_FALSE(read_pieces(folder / "no pieces", [](std::string_view) {}));
  EXPECT_NE(failure_of([&] { read_pieces(folder.path(), [](std::string_view) {}); }), "");
  EXPECT_TRUE(file_exists(folder / "exists"));
  EXPECT_NE(failure_of([&] { read_file(folder / "no/file"); }), "");
  {
    RecordedReads inner;
    read_file(folder / "inner");
    EXPECT_EQ(inner.stamps(), (FileStamps{{folder / "inner", stamp_of(folder / "inner")}}));
  }
  std::thread([&] { read_file(folder / "elsewhere"); }).join();
  {
    const UnrecordedReads apart;
    read_file(folder / "elsewhere");
  }
  FileStamps expected;
  for (const char* name : {"read", "start", "none", "exists", "no/file", "pieces", "no pieces", "inner"})
    expected.emplace(folder / name, stamp_of(folder / name));
  expected.emplace(folder.path(), stamp_of(folder.path()));
  EXPECT_EQ(reads.stamps(), expected);
  EXPECT_FALSE(expected.at(folder / "none").exists);
  EXPECT_TRUE(expected.at(folder / "read").exists);
}

TEST(RecordedReads, HoldAFileAsItStoodFirst) {
  const test::TemporaryFolder folder;
  write_whole_file(folder / "file", "first");
  const FileStamp first = stamp_of(folder / "file");
  RecordedReads reads;
  read_file(folder / "file");
  write_whole_file(folder / "file", "second");
  read_file(folder / "file");
  EXPECT_EQ(reads.stamps().at(folder / "file"), first);
}

}  // namespace
}  // namespace mars::document
