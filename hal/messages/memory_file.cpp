#include "hal/messages/memory_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <utility>

#include "hal/messages/pages.h"

namespace mars::messages {
namespace {

constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }

  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

// The words of a MemoryName.
struct FileName {
  pid_t process;
  int descriptor;  // of that process
  std::uint64_t rank;
  std::uint64_t inode;
  std::uint64_t nonce;

  static FileName of(const MemoryName& name) {
    const auto& [place, rank, inode, nonce] = name.words;
    return {static_cast<pid_t>(place >> 32), static_cast<int>(place & UINT32_MAX), rank, inode, nonce};
  }
  MemoryName words() const {
    return {{static_cast<std::uint64_t>(process) << 32 | static_cast<std::uint32_t>(descriptor), rank, inode, nonce}};
  }

  // What the file itself is called. Another may have its numbers later, or in another pid namespace, but not its nonce.
  std::string label() const {
    return "mars-" + std::to_string(process) + "-" + std::to_string(rank) + "-" + std::to_string(nonce);
  }
};

std::string link_of(const std::string& process, int descriptor) {
  return "/proc/" + process + "/fd/" + std::to_string(descriptor);
}

off_t size_for(std::size_t bytes) { return static_cast<off_t>(std::max<std::size_t>(bytes, 1)); }

// Where the machine gives no more memory than it has, a page that it lacks ends the process that touches it.
bool memory_must_be_reserved() {
  int mode = 0;
  std::ifstream("/proc/sys/vm/overcommit_memory") >> mode;
  return mode == 2;
}

// A file that grows beyond the limit of ulimit -f ends its process.
bool within_file_limit(std::size_t bytes) {
  rlimit limit{};
  return getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || bytes <= limit.rlim_cur;
}

bool grow_and_seal(int file, off_t size) {
  return ftruncate(file, size) == 0 && (!memory_must_be_reserved() || fallocate(file, 0, 0, size) == 0) &&
         fcntl(file, F_ADD_SEALS, kSeals) == 0;
}

std::string link_target(int descriptor) {
  std::array<char, 256> target{};
  const ssize_t length = readlink(link_of("self", descriptor).c_str(), target.data(), target.size());
  return {target.data(), static_cast<std::size_t>(std::max<ssize_t>(length, 0))};
}

bool is_named(int descriptor, const FileName& name, std::size_t bytes) {
  struct stat file = {};
  return fstat(descriptor, &file) == 0 && S_ISREG(file.st_mode) && file.st_ino == name.inode &&
         file.st_size == size_for(bytes) && link_target(descriptor) == "/memfd:" + name.label() + " (deleted)";
}

}  // namespace

Offer offer_file(int rank, std::size_t bytes, std::string& refusal) {
  FileName name{getpid(), -1, static_cast<std::uint64_t>(rank), 0, 0};
  if (bytes > INT64_MAX || !within_file_limit(bytes)) {
    refusal = "files may not be that long";
    return {};
  }
  if (getrandom(&name.nonce, sizeof name.nonce, 0) != sizeof name.nonce) {
    refusal = std::string("getrandom: ") + std::strerror(errno);
    return {};
  }
  Descriptor file(memfd_create(name.label().c_str(), MFD_CLOEXEC | MFD_ALLOW_SEALING));
  struct stat facts = {};
  if (!file || !grow_and_seal(file.number(), size_for(bytes)) || fstat(file.number(), &facts) != 0) {
    refusal = std::string("a file in memory: ") + std::strerror(errno);
    return {};
  }
  name.descriptor = file.number();
  name.inode = facts.st_ino;
  const std::shared_ptr<std::byte> pages = map_pages(bytes, file.number());
  if (pages == nullptr) {
    refusal = "too few addresses are left";
    return {};
  }
  // The file stays open as long as others may attach it.
  struct Open {
    std::shared_ptr<std::byte> pages;
    Descriptor file;
  };
  const auto open = std::make_shared<Open>(Open{pages, std::move(file)});
  return {name.words(), {open, pages.get()}};
}

std::shared_ptr<std::byte> attach_file(int rank, const MemoryName& words, std::size_t bytes, std::string& refusal) {
  const FileName name = FileName::of(words);
  const std::string link = link_of(std::to_string(name.process), name.descriptor);
  // A false name may be of anything: O_PATH opens nothing yet.
  const Descriptor place(open(link.c_str(), O_PATH | O_CLOEXEC));
  if (!place) {
    refusal = link + ": " + std::strerror(errno);
    return nullptr;
  }
  if (name.rank != static_cast<std::uint64_t>(rank) || !is_named(place.number(), name, bytes)) {
    refusal = link + " is not that memory: the processes may have pid namespaces of their own";
    return nullptr;
  }
  const Descriptor file(open(link_of("self", place.number()).c_str(), O_RDWR | O_CLOEXEC));
  if (!file || (fcntl(file.number(), F_GET_SEALS) & kSeals) != kSeals) {
    refusal = link + " cannot be opened";
    return nullptr;
  }
  std::shared_ptr<std::byte> pages = map_pages(bytes, file.number());
  if (pages == nullptr) refusal = "too few addresses are left";
  return pages;
}

}  // namespace mars::messages
