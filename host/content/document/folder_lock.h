// Holds off others that change files of a folder by our commands, where the file system can lock. The end of the
// process, however it comes, gives the lock back.
#pragma once

#include <filesystem>
#include <functional>

namespace mars::document {

class FolderLock {
 public:
  // Of the folder that the file is in. Waits; `waits` is called before that.
  explicit FolderLock(const std::filesystem::path& file, const std::function<void()>& waits = {});
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  // Whether it is the folder of this name now, which others may have removed meanwhile.
  bool is_of(const std::filesystem::path& folder) const;

 private:
  int folder_;
};

}  // namespace mars::document
