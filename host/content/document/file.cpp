#include "host/content/document/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <system_error>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/file_failure.h"
#include "host/content/document/recorded_reads.h"
#include "host/content/document/text.h"

namespace mars::document {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

const char* remedy_for_reading(int error) {
  switch (error) {
    case ELOOP: return "its links lead in a circle: replace it";
    case EMFILE:
    case ENFILE: return "let more files be open at once (ulimit -n)";
    case EACCES:
    case EPERM: return "check its permissions";
    default: return "check the disk";
  }
}

[[noreturn]] void fail_to_read(const fs::path& path, int error) {
  throw FileFailure("cannot be read: " + reason(error), path.string(), remedy_for_reading(error), error);
}

// Opened so that neither opening nor reading waits: a pipe has perhaps nobody at its other end.
class RegularFile {
 public:
  explicit RegularFile(const fs::path& path)
      : path_(path), number_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)), error_(errno) {}
  ~RegularFile() {
    if (number_ >= 0) close(number_);
  }
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  bool is_missing() const { return number_ < 0 && (error_ == ENOENT || error_ == ENOTDIR); }

  // Refuses what is no regular file, or larger than `largest` bytes.
  std::uintmax_t size(std::uintmax_t largest = std::numeric_limits<std::uintmax_t>::max()) const {
    struct stat status {};
    if (number_ < 0 && error_ != ENXIO) fail_to_read(path_, error_);
    if (number_ >= 0 && fstat(number_, &status) != 0) fail_to_read(path_, errno);
    if (S_ISDIR(status.st_mode)) throw Failure("is a directory, not a file", path_.string(), "name a file in it");
    if (!S_ISREG(status.st_mode)) throw Failure("is not a regular file", path_.string(), "name a file on a disk");
    const auto size = static_cast<std::uintmax_t>(status.st_size);
    if (size > largest)
      throw Failure("has " + std::to_string(size) + " bytes, too many to read", path_.string(),
                    "at most " + std::to_string(largest) + " bytes can be read");
    return size;
  }

  // The next bytes; fewer at its end.
  std::string read_next(std::size_t bytes) const {
    std::string content(bytes, '\0');
    std::size_t used = 0;
    while (used < bytes) {
      const ssize_t done = read(number_, content.data() + used, bytes - used);
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) fail_to_read(path_, errno);
      if (done == 0) break;
      used += static_cast<std::size_t>(done);
    }
    content.resize(used);
    return content;
  }

 private:
  const fs::path& path_;
  int number_;
  int error_;  // why it could not be opened; ENXIO: it is a socket
};

}  // namespace

std::optional<std::string> read_file_if_there(const fs::path& path, std::uintmax_t largest) {
  RecordedReads::record(path);
  const RegularFile file(path);
  if (file.is_missing()) return std::nullopt;
  return file.read_next(file.size(largest));
}

std::string read_file(const fs::path& path, std::uintmax_t largest) {
  std::optional<std::string> content = read_file_if_there(path, largest);
  if (!content) throw Failure("there is no such file", path.string(), "check its name");
  return std::move(*content);
}

bool read_pieces(const fs::path& path, const std::function<void(std::string_view piece)>& take,
                 std::uintmax_t largest) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  RecordedReads::record(path);
  const RegularFile file(path);
  if (file.is_missing()) return false;
  file.size(largest);  // refuses what is no regular file
  for (std::string piece = file.read_next(kPiece); !piece.empty(); piece = file.read_next(kPiece)) take(piece);
  return true;
}

std::string read_start(const fs::path& path, std::size_t bytes) try {
  RecordedReads::record(path);
  const RegularFile file(path);
  return file.read_next(std::min<std::uintmax_t>(file.size(), bytes));
} catch (const Failure&) {
  return "";
}

fs::path path_below(const fs::path& folder, const std::string& name) {
  const fs::path top = fs::weakly_canonical(folder), path = fs::weakly_canonical(top / name);
  const auto [end, in_path] = std::ranges::mismatch(top, path);
  if (name.empty() || end != top.end())
    throw Failure(in_quotes(name) + " is not below the studio's folder", "", "name one in " + top.string());
  return path;
}

fs::path place_of_file(const fs::path& file) {
  const fs::path path = fs::absolute(file);
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  return error ? path.lexically_normal() : real;  // writing it will fail, and say why
}

bool file_exists(const fs::path& path) {
  RecordedReads::record(path);
  std::error_code error;
  return fs::exists(path, error);
}

}  // namespace mars::document
