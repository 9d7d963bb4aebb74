// A folder of temporary files of one process. It goes with its object; where the process was killed, the next one that
// looks removes it.
#pragma once

#include <filesystem>
#include <string>

namespace mars::document {

class HeldFolder {
 public:
  // Named `beside`/`prefix`XXXXXX; only this user may enter it. Throws Failure where it cannot be made.
  HeldFolder(const std::filesystem::path& beside, const std::string& prefix);
  ~HeldFolder();
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder& operator=(const HeldFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int held_;  // a file in it, locked: the kernel gives the lock back however the process ends
};

// Removes folders of this user that processes left which are gone: those of this prefix that no process holds. Not
// those where the file system cannot lock.
void remove_abandoned_folders(const std::filesystem::path& beside, const std::string& prefix);

}  // namespace mars::document
