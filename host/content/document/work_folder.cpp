#include "host/content/document/work_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/whole_file.h"

namespace mars::document {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".mars-work";
constexpr const char* kMark = "made-by-mars";

bool is_marked(const fs::path& folder) {
  struct stat found {};
  struct stat mark {};
  return lstat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && lstat((folder / kMark).c_str(), &mark) == 0 &&
         S_ISREG(mark.st_mode);
}

[[noreturn]] void refuse(const fs::path& folder) {
  throw Failure(
      "is in the way: commands keep their files in a folder of this name while they work, and MARS has not "
      "made this one",
      folder.string(), "give it another name, or choose another name for what is made");
}

bool has_only_mark(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().filename() != kMark) return false;
  return !error;
}

}  // namespace

fs::path work_folder_of(const fs::path& made) {
  fs::path path = made.lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (!path.has_filename() || path.filename() == "." || path.filename() == "..") return path / kEnding;
  return path.concat(kEnding);
}

bool has_work_folder(const fs::path& made) { return is_marked(work_folder_of(made)); }

WorkFolder::WorkFolder(const fs::path& made, Use use, const std::function<void()>& waits)
    : path_(work_folder_of(made)) {
  try {
    while (!enter(use, waits)) {
      close(folder_);
      folder_ = -1;
    }
    mark();
  } catch (...) {
    close(folder_);
    throw;
  }
}

// False where the folder has gone meanwhile: another process has removed it.
bool WorkFolder::enter(Use use, const std::function<void()>& waits) {
  if (mkdir(path_.c_str(), 0777) != 0 && errno != EEXIST) fail_file("create the folder", path_, errno);
  folder_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder_ < 0 && errno == ENOENT) return false;
  if (folder_ < 0 && (errno == ENOTDIR || errno == ELOOP)) refuse(path_);
  if (folder_ < 0) fail_file("open the folder", path_, errno);
  lock(use, waits);
  return is_named();
}

void WorkFolder::lock(Use use, const std::function<void()>& waits) {
  const int wish = use == Use::alone ? LOCK_EX : LOCK_SH;
  if (flock(folder_, wish | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  if (!waited_ && waits) waits();
  waited_ = true;
  while (flock(folder_, wish) != 0 && errno == EINTR) {
  }
}

// Whether the folder of this name is the one that is locked.
bool WorkFolder::is_named() const {
  struct stat held {};
  struct stat named {};
  return fstat(folder_, &held) == 0 && lstat(path_.c_str(), &named) == 0 && held.st_dev == named.st_dev &&
         held.st_ino == named.st_ino;
}

// A folder with nothing in it is one whose process was killed before it was marked.
void WorkFolder::mark() const {
  if (is_marked(path_)) return;
  std::error_code error;
  if (!fs::is_empty(path_, error) && !error && !is_marked(path_)) refuse(path_);
  const int made = openat(folder_, kMark, O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (made < 0) fail_file("write", path_ / kMark, errno);
  close(made);
}

// Only where no other process uses it, so that none finds its mark gone.
WorkFolder::~WorkFolder() {
  const bool is_alone = flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  if (is_alone && is_named() && has_only_mark(path_)) {
    unlinkat(folder_, kMark, 0);
    rmdir(path_.c_str());
  }
  close(folder_);
}

}  // namespace mars::document
