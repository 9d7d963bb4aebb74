#include "host/content/document/whole_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "host/content/document/file.h"
#include "host/content/document/filled_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::document {
namespace {

std::string text_of(const std::filesystem::path& path) { return read_file(path); }

TEST(WholeFile, HoldsWhatWasWrittenLast) {
  const test::TemporaryFolder folder;
  for (const std::size_t size : {0u, 1u, 65536u, 65537u, 1000000u}) {
    const std::string text(size, 'x');
    write_whole_file(folder / "file", text);
    EXPECT_EQ(text_of(folder / "file"), text);
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WholeFile, TellsWhatCannotBeWritten) {
  const test::TemporaryFolder folder;
  write_whole_file(folder / "file", "x");
  EXPECT_TRUE(holds(failure_of([&] { write_whole_file(folder / "no/file", "x"); }), "no/file: cannot write: No"));
  EXPECT_TRUE(holds(failure_of([&] { check_can_write(folder / "no/file"); }), "no/file: cannot write: No such"));
  EXPECT_EQ(failure_of([&] { check_can_write(folder / "other"); }), "");
  EXPECT_TRUE(holds(failure_of([&] { write_whole_file(folder / "file/x", "x"); }), "Not a directory"));
  std::filesystem::create_directory(folder / "folder");
  EXPECT_TRUE(holds(failure_of([&] { write_whole_file(folder / "folder", "x"); }), "cannot write"));
  EXPECT_EQ(folder.entries(), 2u) << "no temporary file is left";
}

TEST(WholeFile, LinksAndPermissionsStay) {
  const test::TemporaryFolder folder;
  write_whole_file(folder / "file", "old");
  std::filesystem::permissions(folder / "file",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::filesystem::create_symlink("file", folder / "link");
  write_whole_file(folder / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(text_of(folder / "file"), "new");
  EXPECT_EQ(std::filesystem::status(folder / "file").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(WholeFile, LinksThatLeadNowhereAreRefused) {
  const test::TemporaryFolder folder;
  std::filesystem::create_symlink("gone", folder / "link");
  std::filesystem::create_symlink("circle", folder / "circle");
  EXPECT_TRUE(holds(failure_of([&] { write_whole_file(folder / "link", "new"); }),
                    "link: cannot write: is a link to gone, which is not there (remove the link"));
  EXPECT_TRUE(holds(failure_of([&] { write_whole_file(folder / "circle", "new"); }), "lead in a circle"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(WholeFile, NothingIsWrittenWhereOthersLead) {
  const test::TemporaryFolder folder;
  write_whole_file(folder / "file", "old");
  std::filesystem::create_symlink("file", folder / "link");
  const auto refusal = [&] { return failure_of([&] { check_can_write(folder / "link"); }); };
  EXPECT_EQ(refusal(), "");
  std::filesystem::create_symlink("/dev/null", folder / "device");
  EXPECT_TRUE(holds(failure_of([&] { write_whole_file(folder / "device", "new"); }), "is not a regular file"));
  if (geteuid() != 0) return;  // only root can give files away
  ASSERT_EQ(chown((folder / "file").c_str(), 1234, 1234), 0);
  EXPECT_TRUE(holds(refusal(), "link: cannot write: is a link to a file of another user"));
  ASSERT_EQ(lchown((folder / "link").c_str(), 1234, 1234), 0);
  EXPECT_TRUE(holds(refusal(), "link: cannot write: is a link that another user has made"));
  EXPECT_EQ(text_of(folder / "file"), "old");
}

// Whoever can foresee a temporary name can put a link there.
TEST(WholeFile, NothingIsWrittenThroughAPlantedPart) {
  const test::TemporaryFolder folder;
  write_whole_file(folder / "precious", "old");
  std::filesystem::create_symlink("precious", folder / "file.part");
  write_whole_file(folder / "file", "new");
  EXPECT_EQ(text_of(folder / "file"), "new");
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "file"));
  EXPECT_EQ(text_of(folder / "precious"), "old");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "file.part")) << "it is none of ours";
  EXPECT_TRUE(
      holds(failure_of([&] { replace_file(folder / "other", folder / "file.part", std::span<const std::byte>()); }),
            "File exists"));
  EXPECT_TRUE(holds(failure_of([&] { create_file(folder / "file.part", "new"); }), "File exists"));
  EXPECT_EQ(text_of(folder / "precious"), "old");
  EXPECT_EQ(folder.entries(), 3u);
}

TEST(WholeFile, OfTwoThatWriteOneFileEachWritesAPartOfItsOwn) {
  const test::TemporaryFolder folder;
  write_whole_file(folder / "file", [&](const Write& write) {
    write("outer");
    write_whole_file(folder / "file", std::string(1 << 16, 'x'));
  });
  EXPECT_EQ(text_of(folder / "file"), "outer");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WholeFile, PartsThatKilledProcessesLeftAreRemoved) {
  const test::TemporaryFolder folder;
  write_whole_file(folder / ".film.mars.0123456789abcdef.part", "x");
  write_whole_file(folder / "film.mars", [&](const Write& write) {
    EXPECT_EQ(folder.entries(), 1u) << "its own part";
    write("text");
  });
  EXPECT_EQ(text_of(folder / "film.mars"), "text");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(FilledFile, PartsThatNoProcessFillsAreRemoved) {
  const test::TemporaryFolder folder;
  const std::filesystem::path left = folder / ".film.mp4.0123456789abcdef.part";
  for (const char* file : {".film.mp4.0123456789abcdef.part", ".film.mp4.mine.part", ".a.mp4.0123456789abcdef.part"})
    write_whole_file(folder / file, "x");
  fill_whole_file(folder / "film.mp4", [&](const std::filesystem::path&) {
    EXPECT_FALSE(file_exists(left));
    EXPECT_EQ(folder.entries(), 3u);
    fill_whole_file(folder / "film.mp4", [&](const std::filesystem::path&) {
      EXPECT_EQ(folder.entries(), 4u) << "a part that is filled stays";
    });
  });
  EXPECT_EQ(folder.entries(), 3u);
}

TEST(WholeFile, NamesMayBeAsLongAsTheSystemLetsThemBe) {
  const test::TemporaryFolder folder;
  const std::string longest(255, 'n');
  write_whole_file(folder / longest, "text");
  EXPECT_EQ(text_of(folder / longest), "text");
}

TEST(WholeFile, InAFolderOfOursALinkIsReplaced) {
  const test::TemporaryFolder folder;
  write_whole_file(folder / "precious", "old");
  std::filesystem::create_symlink("precious", folder / "file");
  replace_file(folder / "file", folder / "file.part", std::as_bytes(std::span("new", 3)));
  EXPECT_EQ(text_of(folder / "file"), "new");
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "file"));
  EXPECT_EQ(text_of(folder / "precious"), "old");
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(WholeFile, APartThatSomebodyRemovesIsWrittenOnceMore) {
  const test::TemporaryFolder folder;
  int tries = 0, removals = 1;
  const auto produce = [&](const Write& write) {
    ++tries;
    write("new");
    if (removals-- > 0) std::filesystem::remove(folder / "file.part");
  };
  replace_file(folder / "file", folder / "file.part", produce);
  EXPECT_EQ(text_of(folder / "file"), "new");
  EXPECT_EQ(tries, 2);
  removals = 2;
  EXPECT_TRUE(holds(failure_of([&] { replace_file(folder / "file", folder / "file.part", produce); }), "No such file"));
}

TEST(WholeFile, WhatIsNoFileIsNotReplaced) {
  const test::TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(holds(failure_of([&] { write_whole_file(pipe, "x"); }), "pipe: cannot write: is not a regular file"));
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  std::filesystem::create_directory(folder / "folder");
  EXPECT_TRUE(holds(failure_of([&] { check_can_write(folder / "folder"); }), "Is a directory"));
}

TEST(WholeFile, ANewFileThatCannotBeWrittenIsRemoved) {
  const test::TemporaryFolder folder;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit two_bytes{2, before.rlim_max};
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &two_bytes);
  const std::string failure = failure_of([&] { create_file(folder / "file", "text"); });
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);
  EXPECT_TRUE(holds(failure, "file: cannot write: File too large")) << failure;
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(WholeFile, ALimitOfFilesIsTold) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(holds(failure_of([&] { fail_file("write", folder / "file", EFBIG); }), "raise ulimit -f"));
}

// A disk of 64 KiB, where the system lets us have one.
TEST(WholeFile, AFullDiskLeavesTheOldFile) {
  const test::TemporaryFolder folder;
  if (mount("none", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "only root may mount a small disk";
  write_whole_file(folder / "file", "old");
  const std::string failure = failure_of([&] { write_whole_file(folder / "file", std::string(1 << 20, 'x')); });
  EXPECT_TRUE(holds(failure, "No space left on device")) << failure;
  EXPECT_TRUE(holds(failure, "free some space")) << failure;
  EXPECT_EQ(text_of(folder / "file"), "old");
  EXPECT_EQ(folder.entries(), 1u);
  umount(folder.path().c_str());
}

}  // namespace
}  // namespace mars::document
