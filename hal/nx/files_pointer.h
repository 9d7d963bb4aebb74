// The pointer into a file that all nodes share (I/O mode 1), first come, first served. It lies in a small
// file of its own, and a node that moves it holds a lock of the system on that file meanwhile. So it cannot
// deadlock: no node waits for another to come into an NX call (a node that computes for long delays none, the purpose
// of this mode), and the system releases the lock of a process that dies. For nodes of one machine the file is a
// temporary file without a name; else it lies beside the shared file, hidden, until the last node has closed it.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace mars::nx {

// Where the pointer of the file open as `fd` lies; throws std::system_error. All nodes get the same from the
// same `tag`.
std::string pointer_path(int fd, bool one_machine, long tag);

// All members throw std::system_error.
class FilesPointer {
 public:
  // Makes it, at 0 and for `users` nodes; the file must not be there.
  FilesPointer(std::string path, int users);
  // Shares in one that is there.
  explicit FilesPointer(std::string path);
  ~FilesPointer();  // lets go of it
  FilesPointer(const FilesPointer&) = delete;
  FilesPointer& operator=(const FilesPointer&) = delete;

  // Moves it to next(where it is) and returns where it was.
  off_t move(const std::function<off_t(off_t)>& next);
  // When all share in it already: from now on it needs no name.
  void forget_name();

 private:
  struct Content {
    off_t pointer;
    long users;
  };

  Content load() const;
  void store(const Content& content) const;

  std::string path_;  // "": without a name
  int fd_;
};

}  // namespace mars::nx
