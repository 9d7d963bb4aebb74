#include "host/render/sinks/runs_folder.h"

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/file_failure.h"
#include "host/content/document/whole_file.h"
#include "host/render/sinks/record.h"

namespace mars::sinks {

namespace fs = std::filesystem;

namespace {

// Letters, digits and dashes only: a run's name ends at the first dot.
std::string run_name(const ProcessName& self) {
  std::string host = self.host;
  std::ranges::replace_if(
      host, [](unsigned char c) { return !std::isalnum(c); }, '-');
  return host + "-" + std::to_string(self.number) + "-" + document::unique_word();
}

std::string run_of(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.substr(0, name.find('.'));
}

// Runs make regular files only; to open anything else could wait for ever.
void refuse_other_kinds(const fs::directory_entry& entry) {
  std::error_code gone;
  const fs::file_type type = entry.symlink_status(gone).type();
  if (!gone && type != fs::file_type::regular && type != fs::file_type::not_found)
    throw Failure("is not a regular file, but runs write only regular files there", entry.path().string(), "remove it");
}

}  // namespace

RunsFolder::RunsFolder(const fs::path& frames, ProcessName self)
    : frames_(frames), path_(frames / kRunsName), self_(std::move(self)), name_(run_name(self_)) {}

fs::path RunsFolder::own_file(std::string_view ending) const { return path_ / std::string(name_).append(ending); }

bool RunsFolder::exists() const {
  std::error_code none;
  return fs::symlink_status(path_, none).type() == fs::file_type::directory;
}

void RunsFolder::make() const {
  if (mkdir(path_.c_str(), 0777) == 0) {
    struct stat frames {};
    if (stat(frames_.c_str(), &frames) == 0) chmod(path_.c_str(), frames.st_mode & 07777);
    return;
  }
  if (errno != EEXIST) document::fail_file("create the folder", path_, errno);
  std::error_code none;
  const fs::file_type type = fs::symlink_status(path_, none).type();
  if (type != fs::file_type::directory && type != fs::file_type::not_found)
    throw Failure("is not a folder, but runs write their claims to a folder of this name", path_.string(), "remove it");
}

fs::path RunsFolder::add_own_file(std::string_view ending, std::string_view text) const {
  const fs::path file = own_file(ending);
  do make();  // again where another run removes it, empty, before our file is there
  while (!document::create_file(file, text));
  return file;
}

void RunsFolder::remove_own_files() const {
  std::error_code ignored;  // what stays, the next run removes
  for (fs::directory_iterator entry(path_, ignored), end; entry != end; entry.increment(ignored))
    if (run_of(entry->path()) == name_) fs::remove(entry->path(), ignored);
}

std::vector<RunFiles> RunsFolder::runs() const {
  std::map<std::string, RunFiles> found;
  if (!exists()) return {};
  std::error_code error;
  for (fs::directory_iterator entry(path_, error), end; entry != end; entry.increment(error)) {
    refuse_other_kinds(*entry);
    found[run_of(entry->path())].files.push_back(entry->path());
  }
  if (error && error != std::errc::no_such_file_or_directory)  // the last run has removed it
    throw document::FileFailure("cannot be listed, so other runs in this folder are unknown: " + error.message(),
                                path_.string(), "change its permissions, or give another folder", error.value());
  std::vector<RunFiles> runs;
  for (auto& [name, run] : found) runs.push_back({name, std::move(run.files)});
  return runs;
}

void RunsFolder::remove_if_empty() const {
  std::error_code ignored;
  if (exists()) fs::remove(path_, ignored);
}

ProcessName process_of(const RunFiles& run) {
  for (const fs::path& file : run.files) {
    if (file.extension() == document::kPartSuffix || file.extension() == kHashesEnding) continue;
    try {
      return process_name_of(parse_record(document::read_file(file, kLargestRecord)));
    } catch (const std::exception&) {  // it is gone meanwhile, or not whole yet
    }
  }
  return {};
}

}  // namespace mars::sinks
