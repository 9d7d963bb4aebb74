// Holds off others that change files of a folder by our commands, where the file system can lock. The end of the
// process, however it comes, gives the lock back.
#pragma once

#include <filesystem>

namespace mars::document {

class FolderLock {
 public:
  // Waits for the lock of the folder in which the file is.
  explicit FolderLock(const std::filesystem::path& file);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_;
};

}  // namespace mars::document
