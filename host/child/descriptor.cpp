#include "host/child/descriptor.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/failure/failure.h"

namespace mars::child {
namespace {

[[noreturn]] void fail() {
  throw Failure(std::strerror(errno), "starting a program", errno == EMFILE ? "raise ulimit -n" : "");
}

Descriptor opened(int number) {
  if (number < 0) fail();
  return Descriptor(number);
}

}  // namespace

void Descriptor::close() {
  if (number_ >= 0) ::close(std::exchange(number_, -1));
}

Pipe make_pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail();
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

SocketPair make_socket_pair() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail();
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

Descriptor null_device() { return opened(open("/dev/null", O_RDWR | O_CLOEXEC)); }

Descriptor file_in_memory(std::string_view content) {
  Descriptor file = opened(memfd_create("mars", MFD_CLOEXEC));
  if (!write_all(file, content)) fail();
  lseek(file.number(), 0, SEEK_SET);
  return file;
}

bool write_all(const Descriptor& to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(to.number(), bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string content_of(const Descriptor& file) {
  std::string bytes(static_cast<std::size_t>(lseek(file.number(), 0, SEEK_END)), '\0');
  std::size_t used = 0;
  while (used < bytes.size()) {
    const ssize_t done = pread(file.number(), bytes.data() + used, bytes.size() - used, static_cast<off_t>(used));
    if (done <= 0) break;
    used += static_cast<std::size_t>(done);
  }
  bytes.resize(used);
  return bytes;
}

}  // namespace mars::child
