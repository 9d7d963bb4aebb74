// An end of the socket on which pictures leave a host (messages.h): whole messages in, their sizes checked, and
// messages out as far as the peer takes them. Nothing waits but wait() and drain().
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/child/descriptor.h"
#include "host/render/pictures/reading.h"

namespace mars::pictures {

// Connects at once; if it is not open, errno says why. Throws Failure if no socket can have the name.
child::Descriptor connect_to(const std::string& path);
// Where nothing has the path yet. Throws Failure if no socket can be there.
child::Descriptor listen_at(const std::string& path);

enum class Peer { studio, host, watcher, window };  // a watcher sends nothing

class Socket {
 public:
  // Is connected.
  Socket(child::Descriptor descriptor, Peer peer);

  // False: the peer has closed it.
  bool is_open() const { return open_; }

  // The next message that has come whole; none: it has not, or it is of a studio that takes too little of what it was
  // sent.
  std::optional<Message> receive();
  // Notices a peer that is gone, although nothing is received.
  void look();

  void send(Head head, Body body = nullptr);
  // As far as the peer takes what was sent.
  void flush();
  bool flushed() const { return out_.empty(); }
  // Until the peer has taken all, or is gone, or `give_up` says so, which is called some times a second.
  void drain(const std::function<bool()>& give_up);
  // Forgets those of which nothing was sent yet, and whose heads `is_old` names.
  void take_back(const std::function<bool(const Head&)>& is_old);

  // Until something comes, or the peer takes more.
  void wait(std::chrono::milliseconds longest) const;
  int descriptor() const { return descriptor_.number(); }

 private:
  struct Outgoing {
    Head head;
    Body body;

    std::size_t size() const { return sizeof head + head.bytes; }
    // What follows when `sent` bytes were sent, or a part of it.
    std::span<const std::byte> left(std::size_t sent) const;
  };

  bool hears() const;
  std::size_t read_some(void* to, std::size_t most);
  bool read_head();
  bool read_body();

  child::Descriptor descriptor_;
  Peer peer_;
  bool open_ = true;
  Message in_;
  std::size_t head_read_ = 0;  // bytes
  std::size_t body_read_ = 0;
  std::deque<Outgoing> out_;
  std::size_t out_sent_ = 0;   // bytes of the first
  std::size_t out_bytes_ = 0;  // of all, whole
};

}  // namespace mars::pictures
