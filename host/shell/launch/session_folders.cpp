#include "host/shell/launch/session_folders.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "host/child/environment.h"
#include "host/content/document/text.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRandom = 6;  // letters at the name's end
constexpr int kTries = 3;           // at a new folder that another start takes for an ended job's
constexpr const char* kSharedMemory = "/dev/shm";
constexpr const char* kBase = "OMPI_MCA_orte_tmpdir_base";

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

// The names of files that ranks of the folder's job share end so: "." user "." job ".".
std::optional<std::string> segment_name(const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename() != "contact.txt") continue;
    std::ifstream contact(entry->path());  // begins with mpirun's own number; that of the job is the next
    std::uint32_t number = 0;
    if (contact >> number) return document::formatted(".%u.%x.", geteuid(), number + 1);
  }
  return std::nullopt;
}

// The job has ended. Ranks that end well have removed their segments.
void remove_segments(const fs::path& folder) {
  const std::optional<std::string> ours = segment_name(folder);
  std::error_code error;
  for (fs::directory_iterator entry(kSharedMemory, error), end; ours && !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (name.starts_with("vader_segment.") && name.find(*ours) != std::string::npos) fs::remove(entry->path(), ignored);
  }
}

void remove_folder(const fs::path& path) {
  remove_segments(path);
  std::error_code ignored;  // the next start tries again
  fs::remove_all(path, ignored);
}

// Where it is ours, and no link.
void remove_own_folder(const fs::path& path) {
  struct stat found {};
  if (lstat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == geteuid()) remove_folder(path);
}

void remove_if_ended(const fs::path& path) {
  const int folder = open_folder(path, O_CLOEXEC);
  if (folder < 0) return;
  if (lock_own(folder)) remove_folder(path);
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

void remove_session_of(pid_t mpirun) {
  const child::Environment environment = child::own_environment();
  const fs::path base = environment.value(kBase).value_or(child::temporary_folder(environment));
  const std::string name = "pid." + std::to_string(mpirun);
  std::error_code error;
  for (fs::directory_iterator entry(base, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().filename().string().starts_with("ompi.")) remove_own_folder(entry->path() / name);
}

SessionFolders::SessionFolders(child::Command& command) {
  std::error_code unknown;  // where we are: then a relative name means nothing
  const fs::path temporary = fs::absolute(child::temporary_folder(child::own_environment()), unknown);
  for (const fs::path& base : {temporary, fs::path(kSharedMemory)}) remove_ended_in(base);
  if (command.open_mpi != child::OpenMpi::on_this_machine) return;
  if (!unknown) add(temporary, {kBase}, command);
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
  remove_folder(path_);
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

}  // namespace mars::launch
