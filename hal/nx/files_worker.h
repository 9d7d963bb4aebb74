// Moves bytes between memory and a file while the program goes on: a thread that does one transfer after the
// other, started with the first. It makes no NX call and waits for no node, so waiting for it always ends.
#pragma once

#include <sys/types.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

namespace mars::nx {

struct Transfer {
  int fd;
  bool write;
  void* buffer;  // only read from where `write`
  std::size_t length;
  std::optional<off_t> at;  // none: at the descriptor's own pointer, which moves on
};

struct Transferred {
  std::size_t bytes = 0;  // fewer than asked for: the file ended
  int error = 0;          // an errno, or 0
};

// All of it, or up to the end of the file or the first error.
Transferred transfer(const Transfer& what);

class FilesWorker {
 public:
  FilesWorker() = default;
  ~FilesWorker();  // when all transfers are done
  FilesWorker(const FilesWorker&) = delete;
  FilesWorker& operator=(const FilesWorker&) = delete;

  // An id of 31 bits, or none when all are in use.
  std::optional<long> start(const Transfer& what);
  bool known(long id);
  // The result of a known id, which is then free. `look`: none while it is under way; `wait` waits for it.
  std::optional<Transferred> look(long id);
  Transferred wait(long id);

 private:
  struct Job {
    Transfer what;
    std::optional<Transferred> came;
  };

  void work();
  long next_id();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<long, Job> jobs_;  // by id
  std::deque<long> waiting_;
  long last_id_ = -1;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace mars::nx
