#include "host/content/document/whole_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <random>
#include <string>

#include "hal/failure/failure.h"
#include "host/content/document/file_failure.h"
#include "host/content/document/filled_file.h"

namespace mars::document {

namespace {

// A file descriptor that closes itself. `path` is what failures name, `file` what is opened.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, const std::filesystem::path& file, int flags, const char* act,
             mode_t mode = 0666)
      : Descriptor(path, open(file.c_str(), flags | O_CLOEXEC, mode), act) {}
  // What open(2) has just given.
  Descriptor(const std::filesystem::path& path, int number, const char* act) : path_(path), act_(act), number_(number) {
    if (number_ < 0) fail_file(act, path, errno);
  }
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void write_all(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t done = write(number_, bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) fail_file(act_, path_, errno);
      bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
  }

  // Until it is closed, where the file system can lock. False where another process has the lock, or has removed the
  // file.
  bool lock() {
    if (flock(number_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
    struct stat found {};
    return fstat(number_, &found) != 0 || found.st_nlink > 0;
  }

  // What a machine that loses its power then finds under the file's name is whole. Some file systems have no such call.
  void sync() {
    while (fsync(number_) != 0) {
      if (errno == EINTR) continue;
      if (errno == EINVAL || errno == ENOTSUP) return;
      fail_file(act_, path_, errno);
    }
  }

  // Network file systems may report only here that the disk is full.
  void close_checked() {
    const int closed = close(number_);
    number_ = -1;
    if (closed != 0) fail_file(act_, path_, errno);
  }

 private:
  const std::filesystem::path& path_;
  const char* act_;
  int number_;
};

const char* remedy_for_writing(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT: return "free some space or choose a folder on another disk";
    case EFBIG: return "raise ulimit -f, which says how large files may grow";
    case EACCES:
    case EPERM:
    case EROFS: return "choose a folder you may write to, or change its permissions";
    case ENOENT: return "check the name";
    case ENOTDIR:
    case EISDIR:
    case EEXIST: return "something of another kind has this name: choose another";
    case ENOTEMPTY: return "it is a folder with something in it: move that away, or choose another name";
    case ELOOP: return "its links lead in a circle: replace them, or choose another name";
    case EMFILE:
    case ENFILE: return "let more files be open at once (ulimit -n)";
    case EIO:
    case ESTALE: return "see whether its disk can still be used, and start again";
    default: return "";
  }
}

// `path` is what failures name.
void refuse_all_but_files(const struct stat& thing, const std::filesystem::path& path) {
  if (S_ISDIR(thing.st_mode)) fail_file("write", path, EISDIR);
  if (!S_ISREG(thing.st_mode))
    throw Failure("cannot write: is not a regular file", path.string(), remedy_for_writing(EEXIST));
}

// A new file under a temporary name, which becomes the file `path` when it is renamed; removed unless it was. The file
// that it replaces leaves it its permissions; what is no file is not replaced.
class Part {
 public:
  // `path` is what failures name, `replaced` what is replaced.
  Part(const std::filesystem::path& path, std::filesystem::path replaced, std::filesystem::path part)
      : target_(path),
        replaced_(std::move(replaced)),
        path_(std::move(part)),
        mode_(mode_of_replaced()),
        file_(target_, path_, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, "write",
              mode_.value_or(0666) | S_IRUSR | S_IWUSR) {}
  ~Part() {
    if (!renamed_) unlink(path_.c_str());
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  const std::filesystem::path& path() const { return path_; }

  bool lock() { return file_.lock(); }

  void write(std::string_view text) { file_.write_all(std::as_bytes(std::span(text.data(), text.size()))); }

  void rename_to_target() {
    file_.sync();
    file_.close_checked();
    if (mode_) chmod(path_.c_str(), *mode_);
    if (rename(path_.c_str(), replaced_.c_str()) != 0) fail_file("write", target_, errno);
    renamed_ = true;
  }

 private:
  std::optional<mode_t> mode_of_replaced() const {
    struct stat old {};
    if (lstat(replaced_.c_str(), &old) != 0 || S_ISLNK(old.st_mode)) return std::nullopt;
    refuse_all_but_files(old, target_);
    return old.st_mode & 0777;
  }

  const std::filesystem::path& target_;
  std::filesystem::path replaced_, path_;
  std::optional<mode_t> mode_;
  Descriptor file_;
  bool renamed_ = false;
};

bool is_anothers(const struct stat& thing) { return thing.st_uid != geteuid() && thing.st_uid != 0; }

// The file that a person means by `path`, found through links. Whoever can write to the folder can have put a link
// there: it is followed to a file only that its owner, who is the person or root, could have named as well.
std::filesystem::path file_meant_by(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& problem) {
    throw Failure("cannot write: " + problem, path.string(), "remove the link, or name the file itself");
  };
  struct stat link {};
  struct stat file {};
  if (lstat(path.c_str(), &link) != 0 || !S_ISLNK(link.st_mode)) return path;
  if (is_anothers(link)) refuse("is a link that another user has made");
  if (stat(path.c_str(), &file) != 0) {
    if (errno != ENOENT) fail_file("write", path, errno);
    refuse("is a link to " + std::filesystem::read_symlink(path).string() + ", which is not there");
  }
  refuse_all_but_files(file, path);
  if (file.st_uid != geteuid()) refuse("is a link to a file of another user");
  return std::filesystem::canonical(path);
}

constexpr std::size_t kLongestName = 200;  // bytes, of the 255 that a name may have

// A name beside `path` that no other process uses, and nobody can foresee.
std::filesystem::path part_beside(const std::filesystem::path& path) {
  std::string name = ".";
  name += path.filename().string().substr(0, kLongestName);
  return path.parent_path() / (name + "." + unique_word()).append(kPartSuffix);
}

Part part_of(const std::filesystem::path& path) {
  std::filesystem::path meant = file_meant_by(path);
  std::filesystem::path part = part_beside(meant);
  return Part(path, std::move(meant), std::move(part));
}

constexpr std::size_t kWordDigits = 16;

// ".NAME.<16 digits>.part" of `path`.
bool is_part_of(const std::filesystem::path& path, const std::string& name) {
  const std::string begin = "." + path.filename().string().substr(0, kLongestName) + ".";
  if (name.size() != begin.size() + kWordDigits + kPartSuffix.size()) return false;
  const std::string word = name.substr(begin.size(), kWordDigits);
  return name.starts_with(begin) && name.ends_with(kPartSuffix) &&
         word.find_first_not_of("0123456789abcdef") == std::string::npos;
}

// Where it cannot be known whether somebody fills it, it stays.
void remove_if_left(const std::filesystem::path& part) {
  const int file = open(part.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  if (flock(file, LOCK_EX | LOCK_NB) == 0) unlink(part.c_str());
  close(file);
}

void remove_left_parts(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code none;
  std::vector<std::filesystem::path> parts;
  for (std::filesystem::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none))
    if (is_part_of(path, entry->path().filename().string())) parts.push_back(entry->path());
  for (const std::filesystem::path& part : parts) remove_if_left(part);
}

constexpr int kMostParts = 100;  // one after the other: some file systems count no links of files that are there

// Another process that removes what is left may see the new part before it is locked: then this one makes another.
void write_locked_part(const std::filesystem::path& path, const std::function<void(Part&)>& fill) {
  remove_left_parts(file_meant_by(path));
  std::optional<Part> part;
  int parts = 0;
  do {
    const std::filesystem::path meant = file_meant_by(path);
    part.emplace(path, meant, part_beside(meant));
  } while (!part->lock() && ++parts < kMostParts);
  fill(*part);
  part->rename_to_target();
}

void write_and_rename(const std::filesystem::path& path, const std::filesystem::path& part,
                      const std::function<void(const Write&)>& produce) {
  Part file(path, path, part);
  produce([&file](std::string_view piece) { file.write(piece); });
  file.rename_to_target();
}

}  // namespace

void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  write_whole_file(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  write_whole_file(path, [text](const Write& write) { write(text); });
}

void write_whole_file(const std::filesystem::path& path, const std::function<void(const Write&)>& produce) {
  write_locked_part(path, [&produce](Part& part) { produce([&part](std::string_view piece) { part.write(piece); }); });
}

void fill_whole_file(const std::filesystem::path& path,
                     const std::function<void(const std::filesystem::path& part)>& fill) {
  write_locked_part(path, [&fill](const Part& part) { fill(part.path()); });
}

void replace_file(const std::filesystem::path& path, const std::filesystem::path& part,
                  std::span<const std::byte> bytes) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  replace_file(path, part, [all](const Write& write) { write(all); });
}

void replace_file(const std::filesystem::path& path, const std::filesystem::path& part,
                  const std::function<void(const Write&)>& produce) {
  try {
    write_and_rename(path, part, produce);
  } catch (const FileFailure& failure) {
    std::error_code none;
    if (failure.error != ENOENT || !std::filesystem::is_directory(part.parent_path(), none)) throw;
    write_and_rename(path, part, produce);  // somebody who tidied up has removed the part
  }
}

void replace_file(const std::filesystem::path& path, const std::filesystem::path& part, const Pieces& pieces) {
  replace_file(path, part, [&pieces](const Write& write) {
    for (const std::span<const std::byte> piece : pieces)
      write({reinterpret_cast<const char*>(piece.data()), piece.size()});
  });
}

bool create_file(const std::filesystem::path& path, std::string_view text) {
  const int opened = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (opened < 0 && errno == ENOENT) return false;
  Descriptor file(path, opened, "write");
  try {
    file.write_all(std::as_bytes(std::span(text.data(), text.size())));
    file.close_checked();
  } catch (const Failure&) {
    unlink(path.c_str());
    throw;
  }
  return true;
}

void check_can_write(const std::filesystem::path& path) { part_of(path); }

std::string unique_word() {
  std::random_device random;  // the system's own
  std::string word(17, ' ');
  std::snprintf(word.data(), word.size(), "%08x%08x", random(), random());
  word.pop_back();
  return word;
}

void refuse_same_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code none;
  if (std::filesystem::equivalent(from, to, none))
    throw Failure("is the file that is read", to.string(), "write to another");
}

void fail_file(const char* act, const std::filesystem::path& path, int error) {
  throw FileFailure(std::string("cannot ") + act + ": " + std::strerror(error), path.string(),
                    remedy_for_writing(error), error);
}

}  // namespace mars::document
