#include "host/shell/launch/session_folders.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <string>
#include <system_error>
#include <utility>

#include "host/child/environment.h"
#include "host/child/process.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRandom = 6;  // letters at the name's end
constexpr int kTries = 3;           // at a new folder that another start takes for an ended job's
constexpr const char* kSharedMemory = "/dev/shm";

// Locks may not reach from machine to machine, so each machine handles its own folders. The name is short: paths of
// sockets may not be long.
std::string name_start() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return "mars." + std::string(host.data()).substr(0, 32) + ".";
}

// Ours alone, not through a link. The lock of a job that lives is not to be had.
bool lock_own(int folder) {
  struct stat found {};
  return fstat(folder, &found) == 0 && found.st_uid == geteuid() && flock(folder, LOCK_EX | LOCK_NB) == 0 &&
         fstat(folder, &found) == 0 && found.st_nlink > 0;
}

int open_folder(const fs::path& path, int more) {
  return open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | more);
}

void remove_if_ended(const fs::path& path) {
  const int folder = open_folder(path, O_CLOEXEC);
  if (folder < 0) return;
  std::error_code ignored;  // the next start tries again
  if (lock_own(folder)) fs::remove_all(path, ignored);
  close(folder);
}

void remove_ended_in(const fs::path& base) {
  const std::string start = name_start();
  std::error_code error;
  for (fs::directory_iterator entry(base, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(start) && name.size() == start.size() + kRandom) remove_if_ended(entry->path());
  }
}

}  // namespace

SessionFolders::SessionFolders(child::Command& command) {
  std::error_code unknown;  // where we are: then a relative name means nothing
  const fs::path temporary = fs::absolute(child::temporary_folder(child::own_environment()), unknown);
  for (const fs::path& base : {temporary, fs::path(kSharedMemory)}) remove_ended_in(base);
  if (!command.session_folders) return;
  if (!unknown) add(temporary, {"OMPI_MCA_orte_tmpdir_base"}, command);
  add(kSharedMemory, {"OMPI_MCA_btl_vader_backing_directory", "OMPI_MCA_osc_sm_backing_directory"}, command);
}

void SessionFolders::add(const fs::path& base, std::initializer_list<const char*> settings, child::Command& command) {
  const child::Environment environment = child::own_environment();
  std::vector<const char*> wanted;
  for (const char* setting : settings)
    if (!environment.value(setting)) wanted.push_back(setting);
  if (wanted.empty()) return;
  std::optional<Folder> folder = make_in(base);
  if (!folder) return;
  for (const char* setting : wanted) command.environment.emplace_back(setting, folder->path().string());
  folders_.push_back(std::move(*folder));
}

SessionFolders::Folder::~Folder() {
  if (lock_ < 0) return;
  std::error_code ignored;  // the next start tries again
  fs::remove_all(path_, ignored);
  close(lock_);
}

std::optional<SessionFolders::Folder> SessionFolders::make_in(const fs::path& base) {
  for (int tries = 0; tries < kTries; ++tries) {
    std::string path = (base / name_start()).string() + std::string(kRandom, 'X');
    if (mkdtemp(path.data()) == nullptr) return std::nullopt;
    const int lock = open_folder(path, 0);
    if (lock >= 0 && lock_own(lock)) return Folder(path, lock);
    if (lock >= 0) close(lock);
    rmdir(path.c_str());
  }
  return std::nullopt;
}

// Its locks are closed with all it had open, or it would wait for itself.
void SessionFolders::leave_to_another() const {
  if (folders_.empty()) return;
  child::run_detached([this] {
    for (const Folder& folder : folders_) {
      const int ended = open_folder(folder.path(), 0);
      if (ended < 0 || flock(ended, LOCK_EX) != 0) continue;
      std::error_code ignored;
      fs::remove_all(folder.path(), ignored);
    }
  });
}

}  // namespace mars::launch
