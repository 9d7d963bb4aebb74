// File descriptors of ours for the streams of processes: pipes, and files in memory.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace mars::child {

// Closed at its end. Programs do not inherit it.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  int number() const { return number_; }
  bool open() const { return number_ >= 0; }
  void close();

 private:
  int number_ = -1;
};

struct Pipe {
  Descriptor reading, writing;
};

// The ends of a stream in both directions.
struct SocketPair {
  Descriptor ours, theirs;
};

// Throw Failure where there are no more descriptors.
Pipe make_pipe();
SocketPair make_socket_pair();
Descriptor null_device();
Descriptor file_in_memory(std::string_view content = "");  // read from its beginning

// False where nobody reads any more.
bool write_all(const Descriptor& to, std::string_view bytes);

std::string content_of(const Descriptor& file);

}  // namespace mars::child
