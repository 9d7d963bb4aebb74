#include "host/document/file.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "hal/failure.h"
#include "host/document/recorded_reads.h"

namespace mars::host {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

// The size of a regular file that may be read.
std::uintmax_t checked_size(const fs::path& path, std::uintmax_t largest) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    throw Failure("there is no such file", path.string(), "check its name");
  if (error)
    throw Failure("cannot be read: " + error.message(), path.string(), "check its name and permissions");
  if (fs::is_directory(status))
    throw Failure("is a directory, not a file", path.string(), "name a file in it");
  if (!fs::is_regular_file(status))
    throw Failure("is not a regular file", path.string(), "name a file on a disk");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw Failure("cannot be read: " + error.message(), path.string(), "check its permissions");
  if (size > largest)
    throw Failure("has " + std::to_string(size) + " bytes, too many to read", path.string(),
                  "at most " + std::to_string(largest) + " bytes can be read");
  return size;
}

using OpenFile = std::unique_ptr<FILE, int (*)(FILE*)>;

OpenFile open_to_read(const fs::path& path) { return {std::fopen(path.c_str(), "rb"), &std::fclose}; }

}  // namespace

std::string read_file(const fs::path& path, std::uintmax_t largest) {
  RecordedReads::record(path);
  std::string content(checked_size(path, largest), '\0');
  const OpenFile file = open_to_read(path);
  if (!file) throw Failure("cannot be read: " + reason(errno), path.string(), "check its permissions");
  content.resize(std::fread(content.data(), 1, content.size(), file.get()));
  if (std::ferror(file.get()))
    throw Failure("cannot be read: " + reason(errno), path.string(), "check the disk");
  return content;
}

std::string read_start(const fs::path& path, std::size_t bytes) {
  RecordedReads::record(path);
  std::error_code error;
  const OpenFile file = fs::is_regular_file(path, error) ? open_to_read(path) : OpenFile{nullptr, &std::fclose};
  std::string start(bytes, '\0');
  start.resize(file ? std::fread(start.data(), 1, bytes, file.get()) : 0);
  return start;
}

bool file_exists(const fs::path& path) {
  RecordedReads::record(path);
  std::error_code error;
  return fs::exists(path, error);
}

}  // namespace mars::host
