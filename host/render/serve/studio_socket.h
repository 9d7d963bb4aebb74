// The serving host's end of the studio's socket: whole messages in, their sizes checked (serve_messages.h), and
// messages out as far as the studio takes them. Nothing waits but wait().
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "host/render/serve/serve_messages.h"

namespace mars::serve {

// Throws Failure: the studio sends `what`, which makes no sense.
[[noreturn]] void refuse(const std::string& what);

// From the studio. The body lies at a multiple of 16 bytes.
struct Request {
  Head head{};
  std::vector<std::byte> body;
};

class StudioSocket {
 public:
  // Connects to the socket of that name.
  explicit StudioSocket(const std::string& path);
  // Of a socket that is connected.
  explicit StudioSocket(int descriptor);
  ~StudioSocket();
  StudioSocket(const StudioSocket&) = delete;
  StudioSocket& operator=(const StudioSocket&) = delete;

  // False: the studio has closed it.
  bool is_open() const { return open_; }

  // The next one that has come whole; none: it has not, or the studio takes too little of what it was sent.
  std::optional<Request> receive();

  // An empty one, of which one that was sent before may have left memory.
  std::vector<std::byte> buffer();
  // A head with its body.
  void send(std::vector<std::byte> message);
  // As far as the studio takes what was sent.
  void flush();
  bool flushed() const { return out_.empty(); }

  // Until something comes, or the studio takes more.
  void wait(std::chrono::milliseconds longest) const;

 private:
  std::size_t read_some(std::byte* to, std::size_t most);
  bool read_head();
  bool read_body();

  int descriptor_;
  bool open_ = true;
  Request in_;
  std::size_t head_read_ = 0;  // bytes
  std::size_t body_read_ = 0;
  std::deque<std::vector<std::byte>> out_;
  std::size_t out_sent_ = 0;   // bytes of the first
  std::size_t out_bytes_ = 0;  // of all, whole
  std::vector<std::vector<std::byte>> spare_;
};

}  // namespace mars::serve
