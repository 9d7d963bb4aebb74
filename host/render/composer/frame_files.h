// Writes frames' files on a thread of its own, so that whoever composes them never waits in a file call.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/render/sinks/patience.h"
#include "node/wire/protocol.h"

namespace mars::composer {

// A file that is composed, whole.
struct FrameFile {
  std::uint32_t frame = 0;
  std::string pixel_hash;
  std::vector<std::byte> bytes;
};

class FrameFiles {
 public:
  // `put` writes a file, and throws FileFailure where it cannot; it waits as `bounds` say. `node`: who writes.
  using Put = std::function<void(const FrameFile& file)>;
  using NameOf = std::function<std::filesystem::path(std::uint32_t frame)>;
  FrameFiles(std::int32_t node, NameOf name_of, Put put, sinks::Patience::Bounds bounds = {});
  // What is being written ends, what waits is dropped.
  ~FrameFiles();
  FrameFiles(const FrameFiles&) = delete;
  FrameFiles& operator=(const FrameFiles&) = delete;

  // One is written while another waits.
  bool is_full();
  void write(FrameFile file);
  bool is_busy();
  // As wire::FrameWriter's.
  std::optional<wire::Written> take_written();
  bool has_written();
  std::optional<std::string> take_warning();
  // Of a file that was written; empty, with memory.
  std::vector<std::byte> buffer();

 private:
  void work();
  void write_next(std::unique_lock<std::mutex>& lock);

  const std::int32_t node_;
  const NameOf name_of_;
  const Put put_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable change_;
  std::deque<FrameFile> waiting_;
  std::size_t under_way_ = 0;  // files that wait or are being written
  std::deque<wire::Written> written_;
  std::deque<std::string> warnings_;
  std::vector<std::vector<std::byte>> spare_;
  std::exception_ptr failure_;
  bool stop_ = false;
  sinks::Patience patience_;
  std::thread thread_;
};

}  // namespace mars::composer
