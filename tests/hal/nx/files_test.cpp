// Files over threads, each node with a descriptor of its own, on one machine and as if on two.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hal/messages/call_failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_files.h"
#include "hal/nx/nx_global.h"
#include "hal/threads/run_threads.h"
#include "tests/hal/machines_backend.h"
#include "tests/temporary_folder.h"

namespace mars::nx {
namespace {

// A folder of the test's own, and in it the file that nodes share.
class FilesTest : public testing::TestWithParam<int> {
 protected:
  // `body` gets the node's own descriptor.
  void run(const std::function<void(int)>& body, int flags = O_RDWR | O_CREAT) {
    threads::run_threads(
        GetParam(), [] {}, [&] { with_file(body, flags); });
  }
  void run_on_machines(const std::function<void(int)>& body) {
    messages::Counts counts;
    messages::Machines machines(1);
    const threads::WrapBackend wrap = [&](messages::Backend& backend) {
      return std::make_unique<messages::MachinesBackend>(backend, counts, machines);
    };
    threads::run_threads(
        GetParam(), [] {}, [&] { with_file(body, O_RDWR | O_CREAT); }, wrap);
  }

  std::string content() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void put(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  std::vector<std::string> entries() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      names.push_back(entry.path().filename());
    return names;
  }

  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "shared";

 private:
  void with_file(const std::function<void(int)>& body, int flags) const {
    const int fd = ::open(path_.c_str(), flags, 0600);
    ASSERT_GE(fd, 0);
    body(fd);
    gsync();
    ::close(fd);
  }
};

esize_t esize(long slow) { return {slow, 0}; }

long write_text(int fd, const std::string& text) { return cwrite(fd, text.data(), static_cast<long>(text.size())); }

std::string read_text(int fd, long length) {
  std::string text(static_cast<std::size_t>(length), '?');
  text.resize(static_cast<std::size_t>(cread(fd, text.data(), length)));
  return text;
}

std::string letters(long node, long length) {
  return std::string(static_cast<std::size_t>(length), static_cast<char>('a' + node));
}

// What the plain call says, and the twin's errno.
std::string failure_of(const std::function<void()>& call, int code) {
  try {
    call();
  } catch (const messages::CallFailure& failure) {
    EXPECT_EQ(failure.code, code) << failure.what();
    return failure.what();
  }
  return "no failure";
}

// One node cannot disagree with itself.
class FilesOfSeveralTest : public FilesTest {};

TEST_P(FilesTest, APrivatePointerIsTheSystemsOwn) {
  put("0123456789");
  run([](int fd) {
    EXPECT_EQ(iomode(fd), 0);
    EXPECT_EQ(read_text(fd, 4), "0123");
    EXPECT_EQ(::lseek(fd, 0, SEEK_CUR), 4);
    EXPECT_EQ(eseek(fd, esize(2), SEEK_CUR).slow, 6);
    EXPECT_EQ(iseof(fd), 0);
    EXPECT_EQ(read_text(fd, 100), "6789");  // ends early, where the file ends
    EXPECT_EQ(iseof(fd), 1);
    EXPECT_EQ(read_text(fd, 1), "");
  });
}

TEST_P(FilesTest, InMode1EveryStretchIsOneNodes) {
  constexpr long kEach = 50;
  const auto body = [](int fd) {
    setiomode(fd, 1);
    EXPECT_EQ(iomode(fd), 1);
    for (long i = 0; i < kEach; ++i) EXPECT_EQ(write_text(fd, letters(mynode(), 7)), 7);
    setiomode(fd, 0);
    EXPECT_EQ(eseek(fd, esize(0), SEEK_CUR).slow, numnodes() * kEach * 7);
  };
  const auto check = [&] {
    const std::string text = content();
    ASSERT_EQ(text.size(), static_cast<std::size_t>(GetParam() * kEach * 7));
    for (std::size_t at = 0; at < text.size(); at += 7) EXPECT_EQ(text.substr(at, 7), std::string(7, text[at]));
    for (long node = 0; node < GetParam(); ++node)
      EXPECT_EQ(std::count(text.begin(), text.end(), 'a' + node), kEach * 7);
    EXPECT_EQ(entries(), std::vector<std::string>{"shared"});
  };
  run(body);
  check();
  std::filesystem::remove(path_);
  run_on_machines(body);
  check();
}

TEST_P(FilesTest, InMode1ReadersShareTheWorkAndMeetTheEnd) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += std::to_string(10000 + i);
  put(text + "end");
  std::mutex mutex;
  std::multiset<std::string> read;
  run([&](int fd) {
    setiomode(fd, 1);
    while (true) {
      const std::string piece = read_text(fd, 5);
      const std::lock_guard lock(mutex);
      if (!piece.empty()) read.insert(piece);
      if (piece.size() < 5) break;
    }
    EXPECT_EQ(iseof(fd), 1);
    gsync();
    if (mynode() == 0) eseek(fd, esize(10), SEEK_SET);
    gsync();
    EXPECT_EQ(iseof(fd), 0);
  });
  EXPECT_EQ(read.size(), 1001u);
  EXPECT_EQ(std::set<std::string>(read.begin(), read.end()).size(), 1001u);
}

TEST_P(FilesTest, InMode2StretchesOfAnyLengthLieInOrderOfNodes) {
  run([](int fd) {
    setiomode(fd, 2);
    write_text(fd, letters(mynode(), mynode() * 3));  // node 0: nothing
    write_text(fd, letters(mynode(), 1));
    if (mynode() == 0) {
      EXPECT_EQ(iseof(fd), 1);
    }
    gsync();
    eseek(fd, esize(0), SEEK_SET);
    EXPECT_EQ(read_text(fd, mynode() * 3), letters(mynode(), mynode() * 3));
    EXPECT_EQ(read_text(fd, 100).size(), mynode() == 0 ? static_cast<std::size_t>(numnodes()) : 0u);
    EXPECT_EQ(iseof(fd), 1);
  });
  std::string expected;
  for (long node = 0; node < GetParam(); ++node) expected += letters(node, node * 3);
  for (long node = 0; node < GetParam(); ++node) expected += letters(node, 1);
  EXPECT_EQ(content(), expected);
}

TEST_P(FilesTest, InMode3EqualStretchesLieInOrderOfNodesWithoutMessages) {
  run([](int fd) {
    setiomode(fd, 3);
    write_text(fd, letters(mynode(), 4));
    const std::uint64_t sent = messages::traffic().to_nodes.messages;
    for (int i = 0; i < 9; ++i) write_text(fd, letters(mynode(), 4));
    EXPECT_EQ(messages::traffic().to_nodes.messages, sent);
    gsync();
    eseek(fd, esize(numnodes() * 4), SEEK_SET);
    EXPECT_EQ(read_text(fd, 4), letters(mynode(), 4));
    EXPECT_EQ(eseek(fd, esize(0), SEEK_CUR).slow, numnodes() * 8);
  });
  std::string expected;
  for (int i = 0; i < 10; ++i)
    for (long node = 0; node < GetParam(); ++node) expected += letters(node, 4);
  EXPECT_EQ(content(), expected);
}

TEST_P(FilesOfSeveralTest, UnequalLengthsInMode3FailOnAll) {
  run([](int fd) {
    setiomode(fd, 3);
    const std::string said = failure_of([&] { write_text(fd, letters(0, mynode() == 1 ? 5 : 4)); }, EINVAL);
    EXPECT_NE(said.find("node 1 moves 5 bytes, node 0 4"), std::string::npos) << said;
    EXPECT_EQ(write_text(fd, letters(mynode(), 4)), 4);  // and nothing had moved
    gsync();
    if (mynode() == 1) {
      EXPECT_EQ(_cwrite(fd, "abc", 3), -1);
      EXPECT_EQ(errno, EINVAL);
    }
  });
  EXPECT_EQ(content().size(), static_cast<std::size_t>(GetParam()) * 4);
}

TEST_P(FilesTest, AsynchronousTransfersKeepTheOrderAndThePointer) {
  for (int mode = 0; mode < 4; ++mode) {
    std::filesystem::remove(path_);
    run([mode](int fd) {
      setiomode(fd, mode);
      if (mode == 0) eseek(fd, esize(mynode() * 4000), SEEK_SET);
      const std::string piece = letters(mynode(), 1000);
      std::vector<long> ids;
      for (int i = 0; i < 4; ++i) ids.push_back(iwrite(fd, piece.data(), 1000));
      for (const long id : ids) EXPECT_EQ(iowait(id), 1000);
      EXPECT_EQ(_iowait(ids[0]), -1);
      EXPECT_EQ(errno, EQMID);
      gsync();
      setiomode(fd, 0);
      eseek(fd, esize(mynode() * 1000), SEEK_SET);
      std::string back(1500, '?');
      const long first = iread(fd, back.data(), 1000);
      const long second = iread(fd, back.data() + 1000, 500);
      while (iodone(first) == 0) flick();
      EXPECT_EQ(iowait(second), 500);
      EXPECT_EQ(eseek(fd, esize(0), SEEK_CUR).slow, mynode() * 1000 + 1500);
    });
    EXPECT_EQ(content().size(), static_cast<std::size_t>(GetParam()) * 4000);
    for (long node = 0; node < GetParam(); ++node) {
      const std::string text = content();
      EXPECT_EQ(std::count(text.begin(), text.end(), 'a' + node), 4000);
    }
  }
}

TEST_P(FilesTest, AProcessEndsWhenWhatItStartedIsDone) {
  const std::string piece(1'000'000, 'a');
  std::mutex mutex;
  std::vector<int> open;  // until then
  run([&](int fd) {
    const int own = ::dup(fd);
    setiomode(own, 3);
    for (int i = 0; i < 5; ++i) iwrite(own, piece.data(), static_cast<long>(piece.size()));
    const std::lock_guard lock(mutex);
    open.push_back(own);
  });
  EXPECT_EQ(content().size(), static_cast<std::size_t>(GetParam()) * 5'000'000);
  EXPECT_EQ(content().find_first_not_of('a'), std::string::npos);
  for (const int own : open) ::close(own);
}

TEST_P(FilesTest, AReadThatIsUnderWayEndsWhereTheFileEnds) {
  put("0123456789");
  run([](int fd) {
    std::string text(20, '?');
    EXPECT_EQ(iowait(iread(fd, text.data(), 20)), 10);
    EXPECT_EQ(text, "0123456789??????????");
    EXPECT_EQ(iowait(iread(fd, text.data(), 20)), 0);
    EXPECT_EQ(iseof(fd), 1);
  });
}

TEST_P(FilesTest, AFileOpenedAgainIsInMode0) {
  put("0123456789");
  run([&](int fd) {
    setiomode(fd, 2);
    const int moved = ::fcntl(fd, F_DUPFD, fd);  // so that the other nodes do not get the number
    const int reopened = ::open(path_.c_str(), O_RDONLY);
    ::dup2(reopened, fd);
    EXPECT_EQ(iomode(fd), 0);
    if (mynode() == 0) {
      EXPECT_EQ(read_text(fd, 3), "012");
    }
    ::close(reopened);
    ::close(moved);
  });
}

TEST_P(FilesOfSeveralTest, DisagreementFailsOnAll) {
  put("0123456789");
  run([](int fd) {
    std::string said = failure_of([&] { setiomode(fd, mynode() == 1 ? 2 : 3); }, EINVAL);
    EXPECT_NE(said.find("node 1 sets mode 2, node 0 mode 3"), std::string::npos) << said;
    if (mynode() == 1) ::lseek(fd, 5, SEEK_SET);
    said = failure_of([&] { setiomode(fd, 2); }, EINVAL);
    EXPECT_NE(said.find("node 1 is at byte 5, node 0 at 0"), std::string::npos) << said;
    if (mynode() == 1) ::lseek(fd, 0, SEEK_SET);
    setiomode(fd, 2);
    said = failure_of([&] { eseek(fd, esize(mynode()), SEEK_SET); }, EINVAL);
    EXPECT_NE(said.find("node 1 is at byte 1"), std::string::npos) << said;
    // One node's failure is all nodes'.
    char byte = 0;
    said = failure_of([&] { cread(fd, &byte, mynode() == 1 ? -1 : 1); }, EQLEN);
    EXPECT_NE(said.find(mynode() == 1 ? "negative" : "node 1 could not"), std::string::npos) << said;
    EXPECT_EQ(_setiomode(fd, 4), -1);
    EXPECT_EQ(errno, EINVAL);
  });
}

TEST_P(FilesTest, FailuresCarryTheSystemsErrno) {
  run(
      [&](int fd) {
        char byte = 0;
        EXPECT_EQ(_cread(-1, &byte, 1), -1);
        EXPECT_EQ(errno, EBADF);
        EXPECT_EQ(_cread(fd, &byte, 1), -1);  // open for writing only
        EXPECT_EQ(errno, EBADF);
        EXPECT_EQ(_cwrite(fd, nullptr, 1), -1);
        EXPECT_EQ(errno, EQPBUF);
        EXPECT_EQ(_eseek(fd, esize(0), 77).slow, -1);
        EXPECT_EQ(errno, EINVAL);
        EXPECT_EQ(_eseek(fd, esize(1L << 40), SEEK_SET).slow, -1);
        EXPECT_EQ(errno, EINVAL);
        EXPECT_EQ(_iseof(-1), -1);
        EXPECT_EQ(errno, EBADF);
        const int full = ::open("/dev/full", O_WRONLY);
        const std::string said = failure_of([&] { cwrite(full, &byte, 1); }, ENOSPC);
        EXPECT_NE(said.find("No space left"), std::string::npos) << said;
        const long id = iwrite(full, &byte, 1);
        EXPECT_EQ(_iowait(id), -1);
        EXPECT_EQ(errno, ENOSPC);
        ::close(full);
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        EXPECT_EQ(cwrite(ends[1], "x", 1), 1);
        EXPECT_EQ(cread(ends[0], &byte, 1), 1);
        EXPECT_EQ(byte, 'x');
        EXPECT_EQ(_iwrite(ends[1], "x", 1), -1);
        EXPECT_EQ(errno, ESPIPE);
        EXPECT_EQ(_setiomode(ends[1], 2), -1);
        EXPECT_EQ(errno, ESPIPE);
        ::close(ends[0]);
        ::close(ends[1]);
      },
      O_WRONLY | O_CREAT);
}

TEST_P(FilesTest, AFileThatAppendsIsNotShared) {
  run(
      [](int fd) {
        EXPECT_EQ(_setiomode(fd, 1), -1);
        EXPECT_EQ(errno, EINVAL);
        EXPECT_EQ(iomode(fd), 0);
      },
      O_WRONLY | O_CREAT | O_APPEND);
}

TEST_P(FilesTest, AFileGrowsAndNeverShrinks) {
  put("0123456789");
  run([](int fd) {
    EXPECT_EQ(lsize(fd, 5, SIZE_SET), 10);
    gsync();
    const long sizes[] = {0, 4096 + mynode()};
    lsize(fd, sizes[1], SIZE_SET);
    gsync();
    EXPECT_EQ(lsize(fd, 0, SIZE_END), 4096 + numnodes() - 1);
    gsync();
    EXPECT_EQ(eseek(fd, esize(0), SEEK_CUR).slow, 0);
    EXPECT_EQ(_lsize(fd, 1, 9), -1);
    EXPECT_EQ(errno, EINVAL);
  });
  EXPECT_EQ(content().substr(0, 10), "0123456789");
}

TEST_P(FilesTest, PlacesBeyond32Bits) {
  run([](int fd) {
    EXPECT_EQ(eseek(fd, {0, 3}, SEEK_SET).shigh, 3);
    const esize_t back = eseek(fd, {-16, -1}, SEEK_CUR);  // 64 bits in halves, as the old machines wrote -16
    EXPECT_EQ(back.shigh, 2);
    EXPECT_EQ(back.slow, 0xfffffff0);
  });
}

INSTANTIATE_TEST_SUITE_P(Nodes, FilesTest, testing::Values(1, 2, 3, 5, 8));
INSTANTIATE_TEST_SUITE_P(Nodes, FilesOfSeveralTest, testing::Values(2, 3, 5, 8));

}  // namespace
}  // namespace mars::nx
