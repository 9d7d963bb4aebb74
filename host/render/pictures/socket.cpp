#include "host/render/pictures/socket.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace mars::pictures {
namespace {

constexpr std::size_t kFirstPiece = std::size_t{4} << 20;  // of a body, before as much of it has come
constexpr std::size_t kMostOut = std::size_t{64} << 20;    // bytes; with more a host receives nothing
constexpr int kSocketBuffer = 4 << 20;                     // bytes, as far as the system gives them
constexpr std::chrono::milliseconds kLook{100};            // between two calls of drain's `give_up`

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  const std::size_t most = sizeof address.sun_path - 1;
  if (path.size() > most)
    throw Failure("the name of a socket has at most " + std::to_string(most) + " characters", path,
                  "name a socket in a folder with a shorter name");
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, most);
  return address;
}

Sender sender_of(Peer peer) {
  return peer == Peer::host ? Sender::host : peer == Peer::window ? Sender::window : Sender::studio;
}

}  // namespace

std::span<const std::byte> Socket::Outgoing::left(std::size_t sent) const {
  const std::span<const std::byte> first = bytes_of(head);
  return sent < first.size() ? first.subspan(sent) : std::span(*body).subspan(sent - first.size());
}

child::Descriptor connect_to(const std::string& path) {
  const sockaddr_un address = address_of(path);
  child::Descriptor descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!descriptor.open()) return {};
  if (connect(descriptor.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return descriptor;
  const int reason = errno;
  descriptor.close();
  errno = reason;
  return {};
}

child::Descriptor listen_at(const std::string& path) {
  const sockaddr_un address = address_of(path);
  child::Descriptor descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!descriptor.open() ||
      bind(descriptor.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      listen(descriptor.number(), 1) != 0)
    throw Failure(std::string("no socket can be made: ") + std::strerror(errno), path, "");
  return descriptor;
}

// A watcher or window that is slow gets few pictures that are old.
Socket::Socket(child::Descriptor descriptor, Peer peer) : descriptor_(std::move(descriptor)), peer_(peer) {
  if (peer_ != Peer::watcher && peer_ != Peer::window)
    setsockopt(descriptor_.number(), SOL_SOCKET, SO_SNDBUF, &kSocketBuffer, sizeof kSocketBuffer);
}

// A studio always hears its host: if neither heard the other, both would wait forever.
bool Socket::hears() const { return peer_ == Peer::host || out_bytes_ <= kMostOut; }

// 0: nothing has come.
std::size_t Socket::read_some(void* to, std::size_t most) {
  const ssize_t count = recv(descriptor_.number(), to, most, MSG_DONTWAIT);
  if (count > 0) return static_cast<std::size_t>(count);
  if (count == 0 || (errno != EAGAIN && errno != EINTR)) open_ = false;
  return 0;
}

bool Socket::read_head() {
  if (head_read_ == sizeof in_.head) return true;
  head_read_ += read_some(reinterpret_cast<std::byte*>(&in_.head) + head_read_, sizeof in_.head - head_read_);
  if (head_read_ < sizeof in_.head) return false;
  check_head(in_.head, sender_of(peer_));
  return true;
}

// Its memory grows with what has come, whatever the head promises.
bool Socket::read_body() {
  std::vector<std::byte>& body = in_.body;
  while (body_read_ < in_.head.bytes) {
    if (body_read_ == body.size())
      body.resize(std::min<std::size_t>(in_.head.bytes, std::max(kFirstPiece, 2 * body_read_)));
    const std::size_t count = read_some(&body[body_read_], body.size() - body_read_);
    if (count == 0) return false;
    body_read_ += count;
  }
  return true;
}

std::optional<Message> Socket::receive() {
  if (!open_ || !hears() || !read_head() || !read_body()) return std::nullopt;
  head_read_ = body_read_ = 0;
  return std::exchange(in_, {});
}

void Socket::look() {
  pollfd gone{descriptor_.number(), POLLRDHUP, 0};
  if (poll(&gone, 1, 0) == 1) open_ = false;
}

void Socket::send(Head head, Body body) {
  head.bytes = body ? body->size() : 0;
  out_bytes_ += out_.emplace_back(head, std::move(body)).size();
  flush();
}

void Socket::flush() {
  while (open_ && !out_.empty()) {
    const std::span<const std::byte> left = out_.front().left(out_sent_);
    const ssize_t count = ::send(descriptor_.number(), left.data(), left.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) {
      if (errno == EINTR) continue;
      if (errno != EAGAIN) open_ = false;
      return;
    }
    out_sent_ += static_cast<std::size_t>(count);
    if (out_sent_ < out_.front().size()) continue;
    out_bytes_ -= std::exchange(out_sent_, 0);
    out_.pop_front();
  }
}

void Socket::drain(const std::function<bool()>& give_up) {
  for (flush(); open_ && !flushed(); flush()) {
    pollfd waits{descriptor_.number(), POLLOUT, 0};
    poll(&waits, 1, static_cast<int>(kLook.count()));
    if (give_up()) open_ = false;
  }
}

void Socket::take_back(const std::function<bool(const Head&)>& is_old) {
  const auto first = out_.begin() + (out_sent_ > 0 ? 1 : 0);
  const auto kept = std::stable_partition(first, out_.end(), [&](const Outgoing& each) { return !is_old(each.head); });
  for (auto old = kept; old != out_.end(); ++old) out_bytes_ -= old->size();
  out_.erase(kept, out_.end());
}

void Socket::wait(std::chrono::milliseconds longest) const {
  const auto events = static_cast<short>((hears() ? POLLIN : 0) | (out_.empty() ? 0 : POLLOUT));
  pollfd waits{descriptor_.number(), events, 0};
  poll(&waits, 1, static_cast<int>(longest.count()));
}

}  // namespace mars::pictures
