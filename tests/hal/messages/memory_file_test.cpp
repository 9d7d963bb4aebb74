// Memory files between processes: what they promise beside the rules in conformance/offers.cpp.
#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "hal/messages/memory_file.h"
#include "hal/messages/pages.h"
#include "topology/memory_limit.h"

namespace mars::messages {
namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20;

std::ptrdiff_t open_descriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return std::distance(begin(all), end(all));
}

// The exit code of a child process that runs `body`.
int in_child(const std::function<int()>& body) {
  const pid_t child = fork();
  if (child == 0) _exit(body());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int descriptor_of(const MemoryName& name) { return static_cast<int>(name.words[0] & UINT32_MAX); }

class MemoryFile : public testing::Test {
 protected:
  Offer offered(std::size_t bytes) { return offer_file(3, bytes, refusal_); }
  std::shared_ptr<std::byte> attached(const MemoryName& name, std::size_t bytes) {
    return attach_file(3, name, bytes, refusal_);
  }

  std::string refusal_;
};

TEST_F(MemoryFile, IsOpenAsLongAsItIsOffered) {
  const std::ptrdiff_t before = open_descriptors();
  {
    const Offer offer = offered(1000);
    ASSERT_NE(offer.block, nullptr) << refusal_;
    EXPECT_EQ(open_descriptors(), before + 1);
    EXPECT_EQ(fcntl(descriptor_of(offer.name), F_GETFD), FD_CLOEXEC);
    const auto block = attached(offer.name, 1000);
    EXPECT_NE(block, nullptr) << refusal_;
    EXPECT_EQ(attached(offer.name, 1001), nullptr);
    EXPECT_EQ(open_descriptors(), before + 1);
  }
  EXPECT_EQ(open_descriptors(), before);
}

TEST_F(MemoryFile, NobodyCutsItShort) {
  const Offer offer = offered(kMiB);
  EXPECT_NE(ftruncate(descriptor_of(offer.name), 0), 0);
  EXPECT_NE(ftruncate(descriptor_of(offer.name), 2 * kMiB), 0);
}

// What cannot be trusted to keep its length is refused, whatever it calls itself.
TEST_F(MemoryFile, AFileWithoutSealsIsRefused) {
  const Offer offer = offered(1000);
  const std::string target =
      std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor_of(offer.name)));
  const std::string label =
      target.substr(std::string("/memfd:").size(), target.find(' ') - std::string("/memfd:").size());
  const int file = memfd_create(label.c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING);
  ASSERT_EQ(ftruncate(file, 1000), 0);
  struct stat facts = {};
  ASSERT_EQ(fstat(file, &facts), 0);
  MemoryName name = offer.name;
  name.words[0] = static_cast<std::uint64_t>(getpid()) << 32 | static_cast<std::uint32_t>(file);
  name.words[2] = facts.st_ino;
  EXPECT_EQ(attached(name, 1000), nullptr);
  ASSERT_EQ(fcntl(file, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL), 0);
  EXPECT_NE(attached(name, 1000), nullptr) << refusal_;
  close(file);
}

TEST_F(MemoryFile, IsSeenFromAnotherProcess) {
  const Offer offer = offered(kMiB);
  offer.block.get()[kMiB - 1] = std::byte{7};
  EXPECT_EQ(in_child([&] {
              const auto block = attached(offer.name, kMiB);
              if (block == nullptr) return 1;
              block.get()[0] = std::byte{9};
              return static_cast<int>(block.get()[kMiB - 1]);
            }),
            7);
  EXPECT_EQ(offer.block.get()[0], std::byte{9});
}

TEST_F(MemoryFile, IsNotSeenFromAnotherUserNamespace) {
  const Offer offer = offered(1000);
  const int code = in_child([&] {
    if (unshare(CLONE_NEWUSER) != 0) return 2;
    return attached(offer.name, 1000) == nullptr && refusal_.find("ermission denied") != std::string::npos ? 0 : 1;
  });
  if (code == 2) GTEST_SKIP() << "this machine makes no user namespaces";
  EXPECT_EQ(code, 0);
}

TEST_F(MemoryFile, MayBeLargerThanMemory) {
  constexpr std::size_t kMany = std::size_t{1} << 40;
  if (in_child([] { return map_pages(kMany) == nullptr; }) != 0) GTEST_SKIP() << "addresses are limited";
  const Offer offer = offered(kMany);
  ASSERT_NE(offer.block, nullptr) << refusal_;
  offer.block.get()[kMany - 1] = std::byte{5};
  const auto block = attached(offer.name, kMany);
  ASSERT_NE(block, nullptr) << refusal_;
  EXPECT_EQ(block.get()[kMany - 1], std::byte{5});
}

TEST_F(MemoryFile, TakesNoMoreThanHalfOfTheAddressesLeft) {
  EXPECT_EQ(in_child([&] {
              const std::uint64_t used = topology::process_memory().addresses;
              const rlimit limit{used + 300 * kMiB, used + 300 * kMiB};
              if (setrlimit(RLIMIT_AS, &limit) != 0) return 1;
              if (map_pages(200 * kMiB) != nullptr || offered(200 * kMiB).block != nullptr) return 2;
              if (map_pages(100 * kMiB) == nullptr || offered(100 * kMiB).block == nullptr) return 3;
              return map_pages(SIZE_MAX) == nullptr && offered(SIZE_MAX).block == nullptr ? 0 : 4;
            }),
            0);
}

TEST_F(MemoryFile, KeepsTheLimitOfFiles) {
  EXPECT_EQ(in_child([&] {
              const rlimit limit{kMiB, kMiB};
              if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 1;
              return offered(2 * kMiB).block == nullptr && offered(kMiB).block != nullptr ? 0 : 2;
            }),
            0);
}

}  // namespace
}  // namespace mars::messages
