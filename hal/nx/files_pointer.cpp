#include "hal/nx/files_pointer.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace mars::nx {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

int open_pointer(const std::string& path, int flags) {
  const int fd = ::open(path.c_str(), flags | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fd < 0) fail(path);
  return fd;
}

// Of an open file, not of the process: nodes that are threads of one process exclude each other, too.
class Lock {
 public:
  explicit Lock(int fd) : fd_(fd) {
    while (set(F_WRLCK) != 0) {
      if (errno != EINTR) fail("locking a shared file pointer");
    }
  }
  ~Lock() { set(F_UNLCK); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int set(short type) {
    struct flock lock {};
    lock.l_type = type;
    lock.l_whence = SEEK_SET;
    return ::fcntl(fd_, F_OFD_SETLKW, &lock);
  }

  int fd_;
};

}  // namespace

std::string pointer_path(int fd, bool one_machine, long tag) {
  const std::string name = "nx-pointer-" + std::to_string(tag);
  if (one_machine) return (std::filesystem::temp_directory_path() / name).string();
  const auto file = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(fd));
  return (file.parent_path() / ("." + file.filename().string() + "." + name)).string();
}

FilesPointer::FilesPointer(std::string path, int users)
    : path_(std::move(path)), fd_(open_pointer(path_, O_CREAT | O_EXCL)) {
  const Lock lock(fd_);
  store({0, users});
}

FilesPointer::FilesPointer(std::string path) : path_(std::move(path)), fd_(open_pointer(path_, 0)) {}

// An error could not be reported, and would not help.
FilesPointer::~FilesPointer() {
  try {
    const Lock lock(fd_);
    Content content = load();
    --content.users;
    store(content);
    if (content.users == 0 && !path_.empty()) ::unlink(path_.c_str());
  } catch (const std::system_error&) {
  }
  ::close(fd_);
}

off_t FilesPointer::move(const std::function<off_t(off_t)>& next) {
  const Lock lock(fd_);
  Content content = load();
  const off_t was = content.pointer;
  content.pointer = next(was);
  store(content);
  return was;
}

void FilesPointer::forget_name() {
  if (!path_.empty()) ::unlink(path_.c_str());
  path_.clear();
}

FilesPointer::Content FilesPointer::load() const {
  Content content;
  if (::pread(fd_, &content, sizeof content, 0) != sizeof content) fail("reading a shared file pointer");
  return content;
}

void FilesPointer::store(const Content& content) const {
  if (::pwrite(fd_, &content, sizeof content, 0) != sizeof content) fail("writing a shared file pointer");
}

}  // namespace mars::nx
