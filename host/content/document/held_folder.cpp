#include "host/content/document/held_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <vector>

#include "host/content/document/whole_file.h"

namespace mars::document {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHeld = ".held";
constexpr const char* kNotYetHeld = ".held.new";

bool is_own_folder(const fs::path& path) {
  struct stat found {};
  return lstat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == geteuid();
}

// A folder without the file is one that a process makes at this moment.
bool is_abandoned(const fs::path& folder) {
  const int held = open((folder / kHeld).c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  const bool is_free = held >= 0 && flock(held, LOCK_EX | LOCK_NB) == 0;
  if (held >= 0) close(held);
  return is_free;
}

}  // namespace

HeldFolder::HeldFolder(const fs::path& beside, const std::string& prefix) {
  std::string name = (beside / (prefix + "XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr) fail_file("make a folder in", beside, errno);
  path_ = name;
  held_ = open((path_ / kNotYetHeld).c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (held_ < 0) return;
  flock(held_, LOCK_EX | LOCK_NB);
  std::error_code ignored;
  fs::rename(path_ / kNotYetHeld, path_ / kHeld, ignored);  // free under this name, it would be removed
}

HeldFolder::~HeldFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (held_ >= 0) close(held_);
}

void remove_abandoned_folders(const fs::path& beside, const std::string& prefix) {
  std::error_code ignored;
  std::vector<fs::path> abandoned;
  for (fs::directory_iterator entry(beside, ignored), end; !ignored && entry != end; entry.increment(ignored))
    if (entry->path().filename().string().starts_with(prefix) && is_own_folder(entry->path()) &&
        is_abandoned(entry->path()))
      abandoned.push_back(entry->path());
  for (const fs::path& folder : abandoned) fs::remove_all(folder, ignored);
}

}  // namespace mars::document
