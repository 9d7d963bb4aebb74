// Holds off others that change files of a folder by our commands, where the file system can lock. The end of the
// process, however it comes, gives the lock back.
#pragma once

#include <filesystem>

namespace mars::document {

class FolderLock {
 public:
  // Of the folder that the file is in. Waits.
  explicit FolderLock(const std::filesystem::path& file);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_;
};

}  // namespace mars::document
