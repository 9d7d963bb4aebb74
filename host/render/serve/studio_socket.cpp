#include "host/render/serve/studio_socket.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "hal/failure/failure.h"
#include "node/wire/protocol.h"

namespace mars::serve {
namespace {

constexpr std::size_t kFirstPiece = std::size_t{1} << 20;  // of a body, before as much of it has come
constexpr std::size_t kMostOut = std::size_t{64} << 20;    // bytes; with more nothing is received
constexpr std::size_t kSpare = 4;                          // buffers
constexpr int kSocketBuffer = 4 << 20;                     // bytes, as far as the system gives them

int connect_to(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    throw Failure("the name of a socket is too long", path, "name one in a folder nearer to /");
  std::copy(path.begin(), path.end(), address.sun_path);
  const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) throw Failure(std::strerror(errno), "opening a socket", "");
  if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return descriptor;
  const int reason = errno;
  close(descriptor);
  throw Failure(std::string("no studio answers: ") + std::strerror(reason), path,
                "the host of a studio runs on its machine");
}

std::uint64_t least_bytes(Kind kind) {
  switch (kind) {
    case Kind::film:
    case Kind::view: return 1;
    case Kind::draw: return sizeof(DrawHead);
    default: return 0;
  }
}

void check_head(const Head& head) {
  const bool pictured = head.kind == Kind::view || head.kind == Kind::draw;
  if (head.kind < Kind::film || head.kind > Kind::close) refuse("a message of no known kind");
  if (head.bytes > kMostBytes || head.bytes < least_bytes(head.kind) || (head.kind == Kind::close && head.bytes > 0))
    refuse("a message of an impossible size");
  if (head.view >= wire::kMostViews) refuse("a view whose number is too large");
  if (pictured != (head.picture > 0)) refuse("a picture's number that makes no sense");
}

}  // namespace

void refuse(const std::string& what) {
  throw Failure("the studio sends " + what, "", "run studio and host of the same version");
}

StudioSocket::StudioSocket(const std::string& path) : StudioSocket(connect_to(path)) {}

StudioSocket::StudioSocket(int descriptor) : descriptor_(descriptor) {
  fcntl(descriptor_, F_SETFL, fcntl(descriptor_, F_GETFL) | O_NONBLOCK);
  setsockopt(descriptor_, SOL_SOCKET, SO_SNDBUF, &kSocketBuffer, sizeof kSocketBuffer);
}

StudioSocket::~StudioSocket() { close(descriptor_); }

// 0: nothing has come.
std::size_t StudioSocket::read_some(std::byte* to, std::size_t most) {
  const ssize_t count = recv(descriptor_, to, most, 0);
  if (count > 0) return static_cast<std::size_t>(count);
  if (count == 0 || (errno != EAGAIN && errno != EINTR)) open_ = false;
  return 0;
}

bool StudioSocket::read_head() {
  if (head_read_ == sizeof in_.head) return true;
  head_read_ += read_some(reinterpret_cast<std::byte*>(&in_.head) + head_read_, sizeof in_.head - head_read_);
  if (head_read_ < sizeof in_.head) return false;
  check_head(in_.head);
  return true;
}

// Its memory grows with what has come, whatever the head promises.
bool StudioSocket::read_body() {
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

std::optional<Request> StudioSocket::receive() {
  if (!open_ || out_bytes_ > kMostOut || !read_head() || !read_body()) return std::nullopt;
  head_read_ = body_read_ = 0;
  return std::exchange(in_, {});
}

std::vector<std::byte> StudioSocket::buffer() {
  if (spare_.empty()) return {};
  std::vector<std::byte> buffer = std::move(spare_.back());
  spare_.pop_back();
  return buffer;
}

void StudioSocket::send(std::vector<std::byte> message) {
  out_bytes_ += message.size();
  out_.push_back(std::move(message));
  flush();
}

void StudioSocket::flush() {
  while (open_ && !out_.empty()) {
    const std::vector<std::byte>& message = out_.front();
    const ssize_t count =
        ::send(descriptor_, message.data() + out_sent_, message.size() - out_sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) {
      if (errno == EINTR) continue;
      if (errno != EAGAIN) open_ = false;
      return;
    }
    out_sent_ += static_cast<std::size_t>(count);
    if (out_sent_ < message.size()) continue;
    out_bytes_ -= message.size();
    out_sent_ = 0;
    if (spare_.size() < kSpare) spare_.push_back(std::move(out_.front()));
    out_.pop_front();
  }
}

void StudioSocket::wait(std::chrono::milliseconds longest) const {
  const auto events = static_cast<short>((out_bytes_ > kMostOut ? 0 : POLLIN) | (out_.empty() ? 0 : POLLOUT));
  pollfd waits{descriptor_, events, 0};
  poll(&waits, 1, static_cast<int>(longest.count()));
}

}  // namespace mars::serve
