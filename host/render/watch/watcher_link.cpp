#include "host/render/watch/watcher_link.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>

#include "hal/failure/failure.h"

namespace mars::watch {
namespace {

constexpr int kLookMilliseconds = 100;

}  // namespace

WatcherLink::WatcherLink(const std::string& socket) : name_(socket) {
  const std::size_t most = sizeof sockaddr_un::sun_path - 1;
  if (name_.size() > most)
    throw Failure("the name of a socket has at most " + std::to_string(most) + " characters", name_,
                  "--watch names a socket in a folder with a shorter name");
}

std::string WatcherLink::connect() {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  name_.copy(address.sun_path, sizeof address.sun_path - 1);
  child::Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket.open() || ::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return std::strerror(errno);
  socket_ = std::move(socket);
  return "";
}

void WatcherLink::send(std::span<const std::byte> bytes, const std::function<bool()>& give_up) {
  while (!bytes.empty() && connected()) {
    const ssize_t sent = ::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
      continue;
    }
    if (errno == EAGAIN) {
      pollfd ready{socket_.number(), POLLOUT, 0};
      poll(&ready, 1, kLookMilliseconds);
      if (give_up()) socket_.close();
    } else if (errno != EINTR) {
      socket_.close();
    }
  }
}

void WatcherLink::look() {
  pollfd gone{socket_.number(), POLLRDHUP, 0};
  if (connected() && poll(&gone, 1, 0) == 1) socket_.close();
}

}  // namespace mars::watch
