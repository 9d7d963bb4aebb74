#include "hal/nx/cfs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "hal/collectives/group_sum.h"
#include "hal/nx/nx_errno.h"

namespace mars::nx {
namespace {

const char* remedy(int code) {
  switch (code) {
    case EBADF: return "open the file first, for reading or writing as the call needs";
    case EINVAL: return "see nx_files.h for what a call may be given";
    case ENOSPC: return "free space on the disk";
    case ESPIPE: return "use it with cread and cwrite in mode 0, or take a file";
    default: return "";
  }
}

// An errno, or 0.
int error_of_transfer(const Transfer& what, long length) {
  const int flags = ::fcntl(what.fd, F_GETFL);
  if (flags < 0) return errno;
  if ((flags & O_ACCMODE) == (what.write ? O_RDONLY : O_WRONLY)) return EBADF;
  if (length < 0) return EQLEN;
  return length > 0 && what.buffer == nullptr ? EQPBUF : 0;
}

int error_of_mode(int fd, int mode) {
  const int flags = ::fcntl(fd, F_GETFL);
  if (flags < 0) return errno;
  if (mode < 0 || mode > 3) return EINVAL;
  if (mode == 0) return 0;
  if ((flags & O_APPEND) != 0) return EINVAL;
  return ::lseek(fd, 0, SEEK_CUR) < 0 ? errno : 0;
}

// Other than regular files have no end. -1 and errno where there is no file.
off_t size_of(int fd) {
  struct stat facts {};
  if (::fstat(fd, &facts) != 0) return -1;
  return S_ISREG(facts.st_mode) ? facts.st_size : std::numeric_limits<off_t>::max();
}

// Where a pointer at `at` goes when `length` bytes are claimed: where one reads, not beyond the file's end.
off_t beyond(const Transfer& what, off_t at, off_t length) {
  const off_t rest = what.write ? length : std::max<off_t>(0, size_of(what.fd) - at);
  return at + std::min(length, rest);
}

// For a name that no other process of this machine takes.
long unused_number() {
  static std::atomic<long> last{0};
  return static_cast<long>(::getpid()) << 16 | (++last & 0xffff);
}

// The owner for signals, which nothing else sets on a file, marks a file that is known: one newly opened under the same
// number has no mark.
void mark(int fd) { ::fcntl(fd, F_SETOWN, ::getpid()); }
bool marked(int fd) { return ::fcntl(fd, F_GETOWN) == ::getpid(); }

}  // namespace

void Files::fail(const char* call, int code) const {
  const char* what = code == EQLEN    ? "the length is negative"
                     : code == EQPBUF ? "the buffer is NULL"
                                      : std::strerror(code);
  process_.fail(call, code, what, remedy(code));
}

Files::Shared* Files::find(int fd) {
  const auto at = shared_.find(fd);
  if (at == shared_.end()) return nullptr;
  // A closed file stays in its mode, so that its next call fails on all nodes.
  if (marked(fd) || ::fcntl(fd, F_GETFL) < 0) return &at->second;
  shared_.erase(at);
  return nullptr;
}

off_t Files::place(const char* call, const Shared* file, int fd) const {
  if (file != nullptr && file->pointer) return move(call, *file->pointer, [](off_t at) { return at; });
  const off_t at = ::lseek(fd, 0, SEEK_CUR);
  if (at < 0) fail(call, errno);
  return at;
}

off_t Files::move(const char* call, FilesPointer& pointer, const std::function<off_t(off_t)>& next) const {
  try {
    return pointer.move(next);
  } catch (const std::system_error& failure) {
    process_.fail(call, failure.code().value(), failure.what(), "have the file on a file system that has locks");
  }
}

std::vector<Files::Word> Files::agree(const char* call, const Word& mine) const {
  const messages::Backend& backend = process_.backend();
  if (backend.rank() == backend.host()) process_.fail(call, EQNODE, "the host takes no part", "call it on nodes only");
  const auto nodes = static_cast<std::size_t>(backend.nodes());
  const auto me = static_cast<std::size_t>(backend.rank());
  constexpr std::size_t kParts = sizeof(Word) / sizeof(std::uint64_t);
  std::vector<Word> words(nodes);
  std::vector<std::uint64_t> work(nodes * kParts);
  words[me] = mine;
  collectives::group_sum({0, backend.nodes()}, {&words[0].error, work.size()}, work);
  if (mine.error != 0) fail(call, static_cast<int>(mine.error));
  for (std::size_t node = 0; node < nodes; ++node) {
    const std::string name = "node " + std::to_string(node);
    if (const int code = static_cast<int>(words[node].error)) {
      process_.fail(call, code, name + " could not: " + std::strerror(code), remedy(code));
    }
    if (words[node].place != words[0].place) {
      process_.fail(call, EINVAL,
                    name + " is at byte " + std::to_string(static_cast<off_t>(words[node].place)) + ", node 0 at " +
                        std::to_string(static_cast<off_t>(words[0].place)),
                    "eseek to the same place on all nodes");
    }
  }
  return words;
}

Transfer Files::claim(const char* call, int fd, bool write, void* buffer, long length, bool now) {
  Transfer what{fd, write, buffer, static_cast<std::size_t>(std::max(0L, length)), std::nullopt};
  const int error = error_of_transfer(what, length);
  Shared* file = find(fd);
  if (file != nullptr && file->mode >= 2) {
    what.at = claim_in_order(call, *file, what, error);
    return what;
  }
  if (error != 0) fail(call, error);
  if (file == nullptr && now) return what;
  off_t end = 0;
  const auto next = [&](off_t at) { return end = beyond(what, at, length); };
  if (file != nullptr) {
    what.at = move(call, *file->pointer, next);
  } else {
    what.at = place(call, nullptr, fd);
    ::lseek(fd, next(*what.at), SEEK_SET);
  }
  what.length = static_cast<std::size_t>(end - *what.at);
  return what;
}

off_t Files::claim_in_order(const char* call, Shared& file, const Transfer& what, int error) {
  const auto length = static_cast<long>(what.length);
  const off_t at = ::lseek(what.fd, 0, SEEK_CUR);
  const Word mine{static_cast<std::uint64_t>(error), static_cast<std::uint64_t>(at),
                  static_cast<std::uint64_t>(length)};
  const Ranges ranges =
      file.record ? recorded_ranges(call, *file.record, length, error) : agreed_ranges(call, file, mine);
  if (file.mode == 3) file.record = length;
  ::lseek(what.fd, beyond(what, at, ranges.all), SEEK_SET);
  return at + ranges.before;
}

// Without messages: all nodes know what was agreed on before.
Files::Ranges Files::recorded_ranges(const char* call, long record, long length, int error) const {
  if (error != 0) fail(call, error);
  if (record != length)
    process_.fail(call, EINVAL,
                  std::to_string(length) + " bytes where each is to move " + std::to_string(record) + " (mode 3)",
                  "setiomode again for another length, or take mode 2");
  return {process_.backend().rank() * length, process_.backend().nodes() * length};
}

Files::Ranges Files::agreed_ranges(const char* call, const Shared& file, const Word& mine) const {
  const std::vector<Word> words = agree(call, mine);
  const auto me = static_cast<std::size_t>(process_.backend().rank());
  Ranges ranges;
  for (std::size_t node = 0; node < words.size(); ++node) {
    const auto theirs = static_cast<off_t>(words[node].number);
    if (node < me) ranges.before += theirs;
    ranges.all += theirs;
    if (file.mode == 3 && words[node].number != words[0].number)
      process_.fail(call, EINVAL,
                    "node " + std::to_string(node) + " moves " + std::to_string(theirs) + " bytes, node 0 " +
                        std::to_string(static_cast<long>(words[0].number)) + " (mode 3)",
                    "give all nodes the same length, or take mode 2");
  }
  return ranges;
}

long Files::moved(const char* call, const Transferred& came) const {
  if (came.error != 0) fail(call, came.error);
  return static_cast<long>(came.bytes);
}

long Files::read(const char* call, int fd, void* buffer, long length) {
  return moved(call, transfer(claim(call, fd, false, buffer, length, true)));
}

long Files::write(const char* call, int fd, const void* buffer, long length) {
  return moved(call, transfer(claim(call, fd, true, const_cast<void*>(buffer), length, true)));
}

long Files::start(const char* call, const Transfer& what) {
  const std::optional<long> id = worker_.start(what);
  if (!id) process_.fail(call, EQNOMID, "all ids are in use", "free them by iowait, or iodone until it is 1");
  return *id;
}

long Files::start_read(const char* call, int fd, void* buffer, long length) {
  return start(call, claim(call, fd, false, buffer, length, false));
}

long Files::start_write(const char* call, int fd, const void* buffer, long length) {
  return start(call, claim(call, fd, true, const_cast<void*>(buffer), length, false));
}

long Files::wait(const char* call, long id) {
  check_id(call, id);
  return moved(call, worker_.wait(id));
}

bool Files::done(const char* call, long id) {
  check_id(call, id);
  const std::optional<Transferred> came = worker_.look(id);
  if (came) moved(call, *came);
  return came.has_value();
}

void Files::check_id(const char* call, long id) {
  if (worker_.known(id)) return;
  process_.fail(call, EQMID, "there is no id " + std::to_string(id),
                "an id is free after its iowait, or its iodone that was 1");
}

bool Files::at_end(const char* call, int fd) {
  const off_t size = size_of(fd);
  if (size < 0) fail(call, errno);
  return place(call, find(fd), fd) >= size;
}

off_t Files::seek(const char* call, int fd, off_t offset, int whence) {
  Shared* file = find(fd);
  if (file == nullptr) {
    const off_t at = ::lseek(fd, offset, whence);
    if (at < 0) fail(call, errno);
    return at;
  }
  const bool known = whence == SEEK_SET || whence == SEEK_CUR || whence == SEEK_END;
  const off_t size = size_of(fd);
  int error = size < 0 ? errno : known ? 0 : EINVAL;
  off_t to = 0;
  const auto next = [&](off_t at) {
    to = offset + (whence == SEEK_CUR ? at : whence == SEEK_END ? size : 0);
    if (error == 0 && to < 0) error = EINVAL;
    return error == 0 ? to : at;
  };
  if (file->pointer) {
    move(call, *file->pointer, next);
    if (error != 0) fail(call, error);
  } else {
    next(::lseek(fd, 0, SEEK_CUR));
    agree(call, {static_cast<std::uint64_t>(error), static_cast<std::uint64_t>(to), 0});
    ::lseek(fd, to, SEEK_SET);
  }
  return to;
}

off_t Files::enlarge(const char* call, int fd, off_t offset, int whence) {
  const off_t size = size_of(fd);
  if (size < 0) fail(call, errno);
  if (whence < 0 || whence > 2) fail(call, EINVAL);
  const off_t wanted = offset + (whence == 1 ? place(call, find(fd), fd) : whence == 2 ? size : 0);
  if (wanted <= size) return size;
  if (const int code = ::posix_fallocate(fd, size, wanted - size)) fail(call, code);
  return wanted;
}

int Files::mode(const char* call, int fd) {
  if (::fcntl(fd, F_GETFL) < 0) fail(call, errno);
  const Shared* file = find(fd);
  return file == nullptr ? 0 : file->mode;
}

void Files::set_mode(const char* call, int fd, int mode) {
  const int error = error_of_mode(fd, mode);
  Shared* before = find(fd);
  const bool common = before != nullptr && before->pointer;
  const off_t own = common || mode == 0 || error != 0 ? 0 : std::max<off_t>(0, ::lseek(fd, 0, SEEK_CUR));
  const std::vector<Word> words = agree(
      call, {static_cast<std::uint64_t>(error), static_cast<std::uint64_t>(own), static_cast<std::uint64_t>(mode)});
  for (std::size_t node = 0; node < words.size(); ++node) {
    if (words[node].number == words[0].number) continue;
    process_.fail(call, EINVAL,
                  "node " + std::to_string(node) + " sets mode " +
                      std::to_string(static_cast<int>(words[node].number)) + ", node 0 mode " +
                      std::to_string(static_cast<int>(words[0].number)),
                  "set the same mode on all nodes");
  }
  // No node moves the common pointer any more: all are in this call.
  if (common) ::lseek(fd, place(call, before, fd), SEEK_SET);
  shared_.erase(fd);
  if (mode == 0) return;
  Shared file{mode, nullptr, std::nullopt};
  if (mode == 1) file.pointer = share_pointer(call, fd);
  mark(fd);
  shared_.emplace(fd, std::move(file));
}

// Node 0 makes it and says by which number; when all share in it, it needs no name on one machine.
std::unique_ptr<FilesPointer> Files::share_pointer(const char* call, int fd) {
  messages::Backend& backend = process_.backend();
  const bool one_machine = backend.neighbourhood().count == backend.nodes();
  std::unique_ptr<FilesPointer> pointer;
  Word word;
  const auto attempt = [&word](const auto& step) {
    try {
      step();
    } catch (const std::system_error& failure) {
      word.error = static_cast<std::uint64_t>(failure.code().value());
    }
  };
  if (backend.rank() == 0) {
    word.number = static_cast<std::uint64_t>(unused_number());
    attempt([&] {
      pointer = std::make_unique<FilesPointer>(pointer_path(fd, one_machine, static_cast<long>(word.number)),
                                               backend.nodes());
      pointer->move([at = ::lseek(fd, 0, SEEK_CUR)](off_t) { return at; });
    });
  }
  const auto number = static_cast<long>(agree(call, word)[0].number);
  if (backend.rank() != 0) {
    attempt([&] { pointer = std::make_unique<FilesPointer>(pointer_path(fd, one_machine, number)); });
  }
  agree(call, word);
  if (one_machine) pointer->forget_name();
  return pointer;
}

// The only extension of a process.
Files& files_of(messages::Process& process) {
  if (process.extension() == nullptr) process.extend(std::make_unique<Files>(process));
  return static_cast<Files&>(*process.extension());
}

void end_files(messages::Process& process) { process.extend(nullptr); }

}  // namespace mars::nx
