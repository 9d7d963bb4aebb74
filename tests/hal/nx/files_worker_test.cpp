#include "hal/nx/files_worker.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

namespace mars::nx {
namespace {

struct Pipe {
  Pipe() { EXPECT_EQ(::pipe(ends), 0); }
  ~Pipe() {
    ::close(ends[0]);
    ::close(ends[1]);
  }
  int ends[2];
};

TEST(FilesWorker, TheProgramGoesOnMeanwhile) {
  Pipe pipe;
  FilesWorker worker;
  std::string text(3, '?');
  const auto id = worker.start({pipe.ends[0], false, text.data(), 3, {}});
  ASSERT_TRUE(id);
  EXPECT_FALSE(worker.look(*id));  // nothing to read yet
  EXPECT_EQ(::write(pipe.ends[1], "abc", 3), 3);
  const Transferred came = worker.wait(*id);
  EXPECT_EQ(came.bytes, 3u);
  EXPECT_EQ(came.error, 0);
  EXPECT_EQ(text, "abc");
  EXPECT_FALSE(worker.known(*id));
}

TEST(FilesWorker, IdsAreScarceAndUsedAgain) {
  Pipe pipe;
  FilesWorker worker;
  char byte = 'x';
  std::vector<long> ids;
  while (const auto id = worker.start({pipe.ends[1], true, &byte, 1, {}})) ids.push_back(*id);
  EXPECT_EQ(ids.size(), 4096u);
  EXPECT_EQ(worker.wait(ids[7]).bytes, 1u);
  EXPECT_TRUE(worker.start({pipe.ends[1], true, &byte, 1, {}}));
}

TEST(FilesWorker, ItsEndIsTheEndOfAllTransfers) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "file";
  const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
  ASSERT_GE(fd, 0);
  std::string piece(100'000, 'a');
  {
    FilesWorker worker;
    for (off_t i = 0; i < 50; ++i) {
      EXPECT_TRUE(worker.start({fd, true, piece.data(), piece.size(), i * 100'000}));
    }
  }
  EXPECT_EQ(std::filesystem::file_size(path), 5'000'000u);
  ::close(fd);
}

TEST(FilesWorker, AnErrorIsWhatCameOfIt) {
  FilesWorker worker;
  char byte = 'x';
  EXPECT_EQ(worker.wait(*worker.start({-1, true, &byte, 1, {}})).error, EBADF);
}

}  // namespace
}  // namespace mars::nx
