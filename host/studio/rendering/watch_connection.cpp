#include "host/studio/rendering/watch_connection.h"

#include <stdlib.h>

#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/read.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "hal/failure/failure.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
using Local = asio::local::stream_protocol;
using Error = boost::system::error_code;

constexpr std::uint64_t kMostBytes = std::uint64_t{2} << 30;  // of a body: a picture is at most half of it

// Of names that fit a socket's address; only this user may enter it.
class PrivateFolder {
 public:
  PrivateFolder() {
    std::string name = "/tmp/mars-watch-XXXXXX";
    if (mkdtemp(name.data()) == nullptr)
      throw Failure(std::string("no folder can be made: ") + std::strerror(errno), name, "");
    path_ = name;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// Takes structs from the front of a message; false: it is too short.
class Reader {
 public:
  explicit Reader(const std::vector<std::byte>& message) : rest_(message) {}

  template <typename T>
  bool read(T& item) {
    return copy(&item, sizeof item);
  }
  template <typename T>
  bool read(std::vector<T>& items, std::size_t count) {
    if (count > rest_.size() / sizeof(T)) return false;
    items.resize(count);
    return copy(items.data(), count * sizeof(T));
  }
  bool at_end() const { return rest_.empty(); }

 private:
  bool copy(void* to, std::size_t bytes) {
    if (rest_.size() < bytes) return false;
    if (bytes > 0) std::memcpy(to, rest_.data(), bytes);
    rest_ = rest_.subspan(bytes);
    return true;
  }

  std::span<const std::byte> rest_;
};

bool is_side(std::uint32_t pixels) { return pixels >= 1 && pixels <= wire::kMaxSide; }

bool lies_within(const watch::Rect& rect, const watch::Begin& begin) {
  return rect.width > 0 && rect.height > 0 && std::uint32_t{rect.x} + rect.width <= begin.width &&
         std::uint32_t{rect.y} + rect.height <= begin.height;
}

}  // namespace

class WatchConnection::Wire : public std::enable_shared_from_this<Wire> {
 public:
  Wire(asio::io_context& context, Listener listener)
      : listener_(std::move(listener)), acceptor_(context, Local::endpoint(path())), socket_(context) {}

  std::string path() const { return (folder_.path() / "watcher").string(); }

  void accept() {
    acceptor_.async_accept(socket_, [self = shared_from_this()](Error error) {
      if (!self->closed_ && !error) self->read_head();
    });
  }

  void close() {
    closed_ = true;
    Error ignored;
    acceptor_.close(ignored);
    socket_.close(ignored);
  }

 private:
  // The next host may come.
  void end_host() {
    Error ignored;
    socket_.close(ignored);
    begin_ = {};
    accept();
  }

  template <typename Next>
  void read(asio::mutable_buffer to, Next next) {
    asio::async_read(socket_, to, [self = shared_from_this(), next](Error error, std::size_t) {
      if (self->closed_) return;
      if (error || !next(*self)) self->end_host();
    });
  }

  void read_head() {
    read(asio::buffer(&head_, sizeof head_), [](Wire& wire) {
      if (wire.head_.bytes > kMostBytes) return false;
      wire.body_.resize(wire.head_.bytes);
      wire.read(asio::buffer(wire.body_), [](Wire& same) {
        if (!same.take_body()) return false;
        if (!same.closed_) same.read_head();
        return true;
      });
      return true;
    });
  }

  bool take_body() {
    switch (head_.kind) {
      case watch::Kind::begin: return take_begin();
      case watch::Kind::picture: return take_picture();
      case watch::Kind::drawn: return take_drawn();
    }
    return false;
  }

  bool take_begin() {
    Reader reader(body_);
    std::vector<watch::Node> nodes;
    if (!reader.read(begin_) || !reader.read(nodes, begin_.nodes) || !reader.at_end()) return false;
    for (watch::Node& node : nodes) node.host.back() = 0;
    if (!is_side(begin_.width) || !is_side(begin_.height) || !is_side(begin_.block)) return false;
    listener_.begin(begin_, std::move(nodes));
    return true;
  }

  bool take_picture() {
    Reader reader(body_);
    WatchedUpdate update;
    if (begin_.width == 0 || !reader.read(update.head) || !reader.read(update.rects, update.head.rects) ||
        !reader.read(update.lines, begin_.height))
      return false;
    std::size_t pixels = 0;
    for (const watch::Rect& rect : update.rects) {
      if (!lies_within(rect, begin_)) return false;
      pixels += std::size_t{rect.width} * rect.height;
    }
    if (!reader.read(update.pixels, pixels) || !reader.at_end()) return false;
    listener_.picture(update);
    return true;
  }

  bool take_drawn() {
    Reader reader(body_);
    watch::DrawnHead head;
    std::vector<watch::Part> parts;
    if (!reader.read(head) || !reader.read(parts, head.parts) || !reader.at_end()) return false;
    listener_.drawn(head, std::move(parts));
    return true;
  }

  PrivateFolder folder_;
  const Listener listener_;
  Local::acceptor acceptor_;
  Local::socket socket_;
  bool closed_ = false;
  watch::Begin begin_{};  // of the host; width 0: it has not said it
  watch::Head head_{};
  std::vector<std::byte> body_;
};

WatchConnection::WatchConnection(asio::io_context& context, Listener listener)
    : wire_(std::make_shared<Wire>(context, std::move(listener))) {
  wire_->accept();
}

WatchConnection::~WatchConnection() { wire_->close(); }

std::string WatchConnection::path() const { return wire_->path(); }

}  // namespace mars::studio
