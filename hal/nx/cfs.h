// The files of one process: the work of the calls of nx_files.h, on descriptors of the system. The place of a transfer
// is settled first, inside the call and between the nodes as the file's mode says; then the bytes move, at once or in
// the worker's thread, and no node waits for another's bytes. Failures are the process's (Process::fail), with the
// system's errno.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "hal/messages/process.h"
#include "hal/nx/files_pointer.h"
#include "hal/nx/files_worker.h"

namespace mars::nx {

class Files : public messages::Process::Extension {
 public:
  explicit Files(messages::Process& process) : process_(process) {}

  long read(const char* call, int fd, void* buffer, long length);
  long write(const char* call, int fd, const void* buffer, long length);
  long start_read(const char* call, int fd, void* buffer, long length);
  long start_write(const char* call, int fd, const void* buffer, long length);
  long wait(const char* call, long id);
  bool done(const char* call, long id);

  bool at_end(const char* call, int fd);
  off_t seek(const char* call, int fd, off_t offset, int whence);
  off_t enlarge(const char* call, int fd, off_t offset, int whence);

  void set_mode(const char* call, int fd, int mode);
  int mode(const char* call, int fd);

 private:
  // Of a descriptor whose mode is not 0. In modes 2 and 3 every node's own pointer stands where the shared
  // one does.
  struct Shared {
    int mode = 0;
    std::unique_ptr<FilesPointer> pointer;  // mode 1
    std::optional<long> record;             // mode 3: how long all transfers are, once it is settled
  };
  // One node's part of a call that all make together.
  struct Word {
    std::uint64_t error = 0;   // an errno
    std::uint64_t place = 0;   // of the pointer; the same on all nodes
    std::uint64_t number = 0;  // a length, a mode ...
  };
  // Of a transfer of all nodes in modes 2 and 3: bytes before this node's range, and of all ranges.
  struct Ranges {
    off_t before = 0;
    off_t all = 0;
  };

  // The transfer of a call: the file's pointer is beyond it already. `now`: before the call returns.
  Transfer claim(const char* call, int fd, bool write, void* buffer, long length, bool now);
  off_t claim_in_order(const char* call, Shared& file, const Transfer& what, int error);
  Ranges recorded_ranges(const char* call, long record, long length, int error) const;
  Ranges agreed_ranges(const char* call, const Shared& file, const Word& mine) const;
  long start(const char* call, const Transfer& what);
  long moved(const char* call, const Transferred& came) const;

  std::unique_ptr<FilesPointer> share_pointer(const char* call, int fd);
  // Each node's word, in their order; fails on all nodes where one has an error, or is at another place.
  std::vector<Word> agree(const char* call, const Word& mine) const;

  Shared* find(int fd);  // nullptr: mode 0
  off_t move(const char* call, FilesPointer& pointer, const std::function<off_t(off_t)>& next) const;
  void check_id(const char* call, long id);
  off_t place(const char* call, const Shared* file, int fd) const;
  [[noreturn]] void fail(const char* call, int code) const;

  messages::Process& process_;
  FilesWorker worker_;
  std::map<int, Shared> shared_;  // by descriptor
};

// The files of `process`, made with the first call for them; they end with the process, or by end_files,
// which waits for all transfers.
Files& files_of(messages::Process& process);
void end_files(messages::Process& process);

}  // namespace mars::nx
