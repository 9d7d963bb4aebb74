#include "host/studio/importing/upload_folder.h"

#include <fcntl.h>

#include <cerrno>
#include <utility>

#include "host/content/document/whole_file.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = ".mars-import-";

void make_folders(const fs::path& path) {
  std::error_code problem;
  fs::create_directories(path, problem);
  if (problem) document::fail_file("make the folder", path, problem.value());
}

}  // namespace

UploadFolder::UploadFolder(const fs::path& beside) : folder_(beside, kPrefix) {}

void remove_abandoned_uploads(const fs::path& beside) { document::remove_abandoned_folders(beside, kPrefix); }

fs::path UploadFolder::folder_of(std::size_t run) const { return folder_.path() / "made" / std::to_string(run); }

fs::path UploadFolder::make_folder(std::size_t run) const {
  make_folders(folder_of(run));
  return folder_of(run);
}

WrittenFile::WrittenFile(fs::path path) : path_(std::move(path)) {
  make_folders(path_.parent_path());
  file_ = child::Descriptor(open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (!file_.open()) document::fail_file("write", path_, errno);
}

void WrittenFile::write(std::string_view piece) {
  if (!child::write_all(file_, piece)) document::fail_file("write", path_, errno);
}

}  // namespace mars::studio
