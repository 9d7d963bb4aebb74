#include "host/shell/launch/session_folders.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "host/child/environment.h"
#include "host/content/document/text.h"
#include "host/shell/launch/held_files.h"

namespace mars::launch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRandom = 6;  // letters at the name's end
constexpr int kTries = 3;           // at a new folder that another start takes for an ended job's
constexpr const char* kSharedMemory = "/dev/shm";
constexpr const char* kBase = "OMPI_MCA_orte_tmpdir_base";

std::string host_name() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return host.data();
}

// Locks may not reach from machine to machine, so each machine handles its own folders. The name is short: paths of
// sockets may not be long.
std::string name_start() { return "mars." + host_name().substr(0, 32) + "."; }

fs::path base_of_sessions(const child::Environment& environment) {
  return environment.value(kBase).value_or(child::temporary_folder(environment));
}

template <typename Take>
void for_each_entry(const fs::path& folder, Take take) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    take(entry->path());
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
  if (!ours) return;
  for_each_entry(kSharedMemory, [&](const fs::path& file) {
    const std::string name = file.filename();
    std::error_code ignored;
    if (name.starts_with("vader_segment.") && name.find(*ours) != std::string::npos) fs::remove(file, ignored);
  });
}

void remove_folder(const fs::path& path) {
  remove_segments(path);
  std::error_code ignored;  // the next start tries again
  fs::remove_all(path, ignored);
}

// Whether it is this user's and of that kind itself, not by a link.
bool is_own(const fs::path& path, mode_t kind) {
  struct stat found {};
  return lstat(path.c_str(), &found) == 0 && (found.st_mode & S_IFMT) == kind && found.st_uid == geteuid();
}

void remove_if_ended(const fs::path& path) {
  const int folder = open_folder(path, O_CLOEXEC);
  if (folder < 0) return;
  if (lock_own(folder)) remove_folder(path);
  close(folder);
}

void remove_ended_in(const fs::path& base) {
  const std::string start = name_start();
  for_each_entry(base, [&](const fs::path& folder) {
    const std::string name = folder.filename();
    if (name.starts_with(start) && name.size() == start.size() + kRandom) remove_if_ended(folder);
  });
}

// Open MPI names what it keeps of a machine so: its own name up to the first point, the user.
std::string machine_part() {
  const std::string host = host_name();
  return "." + host.substr(0, host.find('.')) + "." + std::to_string(geteuid());
}

// Files that mpirun and its helpers have open or in memory from the beginning, as long as they live.
bool has_files_of_a_helper(const fs::path& session) {
  bool found = false;
  std::error_code ignored;
  for_each_entry(session, [&](const fs::path& file) {
    const std::string name = file.filename();
    found = found || name == "hwloc.sm" || (name.starts_with("pmix_dstor") && !fs::is_empty(file, ignored));
  });
  return found;
}

// The files that mpirun, its helpers and ranks of this machine and user keep.
std::vector<fs::path> sessions_in(const fs::path& base) {
  std::vector<fs::path> sessions;
  const fs::path all = base / ("ompi" + machine_part());
  if (is_own(all, S_IFDIR))
    for_each_entry(all, [&](const fs::path& session) {
      if (is_own(session, S_IFDIR) && has_files_of_a_helper(session)) sessions.push_back(session);
    });
  return sessions;
}

std::vector<fs::path> shared_segments() {
  std::vector<fs::path> segments;
  for_each_entry(kSharedMemory, [&](const fs::path& file) {
    const bool ours = file.filename().string().starts_with("vader_segment" + machine_part() + ".");
    if (ours && is_own(file, S_IFREG)) segments.push_back(file);
  });
  return segments;
}

bool is_in(const std::string& file, const fs::path& path) {
  const std::string names = path.parent_path().filename() / path.filename() / "";
  return (file + "/").find(names) != std::string::npos;
}

// Removes what processes that were killed on this machine left. `ours`: the session of this job. If nobody seems to
// hold that one, we do not see the machine's processes, as in a container, and remove nothing.
void remove_what_nobody_holds(const std::vector<fs::path>& left, const fs::path& ours) {
  if (left.empty()) return;
  const std::vector<std::string> held = held_files({"/ompi.", "/vader_segment."});
  const auto is_held = [&](const fs::path& path) {
    return std::ranges::any_of(held, [&](const std::string& file) { return is_in(file, path); });
  };
  if (!is_held(ours)) return;
  std::error_code ignored;
  for (const fs::path& path : left)
    if (!is_held(path)) fs::remove_all(path, ignored);
}

void remove_ended_folders(const fs::path& temporary) {
  for (const fs::path& base : {temporary, fs::path(kSharedMemory)}) remove_ended_in(base);
}

}  // namespace

// Remains are listed before their holders: what begins meanwhile is not among them.
void clean_machine_as_rank() {
  const child::Environment environment = child::own_environment();
  const auto session = environment.value("OMPI_MCA_orte_jobfam_session_dir");
  if (!session || environment.value("OMPI_COMM_WORLD_LOCAL_RANK") != "0") return;
  std::vector<fs::path> left = shared_segments();
  for (const fs::path& base : {fs::path(child::temporary_folder(environment)), base_of_sessions(environment)})
    for (const fs::path& each : sessions_in(base)) left.push_back(each);
  remove_what_nobody_holds(left, *session);
  remove_ended_folders(child::temporary_folder(environment));
}

void remove_session_of(pid_t mpirun) {
  for_each_entry(base_of_sessions(child::own_environment()), [&](const fs::path& folder) {
    const fs::path session = folder / ("pid." + std::to_string(mpirun));
    if (folder.filename().string().starts_with("ompi.") && is_own(session, S_IFDIR)) remove_folder(session);
  });
}

SessionFolders::SessionFolders(child::Command& command) {
  std::error_code unknown;  // where we are: then a relative name means nothing
  const fs::path temporary = fs::absolute(child::temporary_folder(child::own_environment()), unknown);
  remove_ended_folders(temporary);
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
