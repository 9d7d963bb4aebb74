#include "host/content/document/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace mars::document {

FolderLock::FolderLock(const std::filesystem::path& file, const std::function<void()>& waits)
    : folder_(open(file.has_parent_path() ? file.parent_path().c_str() : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ < 0 || flock(folder_, LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK && waits) waits();
  flock(folder_, LOCK_EX);
}

bool FolderLock::is_of(const std::filesystem::path& folder) const {
  if (folder_ < 0) return std::filesystem::exists(folder);
  struct stat held {};
  struct stat named {};
  return fstat(folder_, &held) == 0 && stat(folder.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino;
}

FolderLock::~FolderLock() {
  if (folder_ >= 0) close(folder_);
}

}  // namespace mars::document
