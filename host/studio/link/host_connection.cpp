#include "host/studio/link/host_connection.h"

#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <optional>
#include <utility>

#include "hal/failure/failure.h"
#include "host/child/private_folder.h"
#include "host/render/pictures/socket.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
using Local = asio::local::stream_protocol;
using Error = boost::system::error_code;
using pictures::Kind;

constexpr int kMessagesATurn = 16;

}  // namespace

class HostConnection::Wire : public std::enable_shared_from_this<Wire> {
 public:
  Wire(asio::io_context& context, Listener listener)
      : listener_(std::move(listener)), acceptor_(context, Local::endpoint(path())), ready_(context) {}

  std::string path() const { return folder_.socket().string(); }

  void accept() {
    acceptor_.async_accept(ready_, [self = shared_from_this()](Error error) {
      if (self->closed_) return;
      error ? self->end_accepting(error.message()) : self->begin();
    });
  }

  void close_to_others() {
    Error ignored;
    acceptor_.close(ignored);
    folder_.remove();
  }

  void send(Kind kind, std::uint32_t view, std::uint32_t picture, pictures::Body body) {
    socket_->send({kind, view, picture}, std::move(body));
    write();
  }

  std::vector<std::uint32_t> take_back(std::uint32_t view, bool scenes) {
    std::vector<std::uint32_t> pictures;
    socket_->take_back([&](const pictures::Head& head) {
      const bool is_old = head.view == view && (head.kind == Kind::draw || (scenes && head.kind == Kind::scene));
      if (is_old) pictures.push_back(head.picture);
      return is_old;
    });
    return pictures;
  }

  void close() {
    closed_ = true;
    Error ignored;
    acceptor_.close(ignored);
    end_connection();
  }

 private:
  void begin() {
    socket_.emplace(child::Descriptor(dup(ready_.native_handle())), pictures::Peer::host);
    writing_ = false;
    read();
    hear(listener_.connected);
  }

  void end_connection() {
    Error ignored;
    ready_.close(ignored);
    socket_.reset();
    begin_.reset();
  }

  // The next host may come.
  void end_host(const std::string& reason) {
    end_connection();
    if (acceptor_.is_open()) accept();
    hear(listener_.closed, reason);
  }

  void end_accepting(const std::string& reason) {
    close_to_others();
    hear(listener_.closed, reason);
  }

  // Calls `next` when the socket has something, or takes more; not if that host is gone by then.
  template <typename Next>
  void wait(Local::socket::wait_type what, Next next) {
    ready_.async_wait(what, [self = shared_from_this(), next](Error error) {
      if (!self->closed_ && !error) next(*self);
    });
  }

  void write() {
    if (writing_ || socket_->flushed() || !socket_->is_open()) return;
    writing_ = true;
    wait(Local::socket::wait_write, [](Wire& wire) {
      wire.writing_ = false;
      wire.socket_->flush();
      wire.write();
    });
  }

  void read() {
    wait(Local::socket::wait_read, [](Wire& wire) { wire.take_messages(); });
  }

  void take_messages() try {
    for (int taken = 0; taken < kMessagesATurn; ++taken) {
      const std::optional<pictures::Message> message = socket_->receive();
      if (!message) break;
      take(*message);
      if (closed_) return;
    }
    socket_->is_open() ? read() : end_host("");
  } catch (const pictures::Malformed& failure) {
    end_host(failure.what());
  }

  void take(const pictures::Message& message) {
    switch (message.head.kind) {
      case Kind::begin: {
        pictures::BeginMessage begin = pictures::read_begin(message);
        begin_ = begin.begin;
        return hear(listener_.begin, std::move(begin));
      }
      case Kind::picture: return hear(listener_.picture, pictures::read_picture(message, begin_));
      case Kind::dropped: return hear(listener_.dropped, message.head.view, message.head.picture);
      case Kind::drawn: return hear(listener_.drawn, pictures::read_drawn(message));
      default: return;  // why it ends is known when its job has ended
    }
  }

  template <typename... Parts>
  static void hear(const std::function<void(Parts...)>& listener, auto&&... parts) {
    if (listener) listener(std::forward<decltype(parts)>(parts)...);
  }

  child::PrivateFolder folder_{"mars-studio", "host"};
  const Listener listener_;
  Local::acceptor acceptor_;
  Local::socket ready_;                     // says when socket_ has something, or takes more
  std::optional<pictures::Socket> socket_;  // none: no host is connected
  std::optional<pictures::Begin> begin_;    // the host's last
  bool closed_ = false, writing_ = false;
};

HostConnection::HostConnection(asio::io_context& context, Listener listener)
    : wire_(std::make_shared<Wire>(context, std::move(listener))) {
  wire_->accept();
}

HostConnection::~HostConnection() { wire_->close(); }

std::string HostConnection::path() const { return wire_->path(); }

void HostConnection::close_to_others() { wire_->close_to_others(); }

void HostConnection::send(Kind kind, std::uint32_t view, std::uint32_t picture, pictures::Body body) {
  wire_->send(kind, view, picture, std::move(body));
}

std::vector<std::uint32_t> HostConnection::take_back(std::uint32_t view, bool scenes) {
  return wire_->take_back(view, scenes);
}

}  // namespace mars::studio
