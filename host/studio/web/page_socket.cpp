#include "host/studio/web/page_socket.h"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <optional>
#include <string>

#include "hal/failure/explain.h"
#include "host/studio/web/message_rate.h"
#include "host/studio/web/page_message.h"
#include "host/studio/web/page_outbox.h"

namespace mars::web {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Clock = std::chrono::steady_clock;

class Socket final : public PageSocket, public std::enable_shared_from_this<Socket> {
 public:
  Socket(Stream stream, Site& site, std::unique_ptr<Crowd::Place> place)
      : socket_(std::move(stream)),
        timer_(socket_.get_executor()),
        pause_(socket_.get_executor()),
        site_(site),
        place_(std::move(place)) {}

  void accept(const HttpRequest& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has its own
    socket_.set_option(websocket::stream_base::timeout{site_.patience().request, site_.patience().silence, true});
    socket_.control_callback([this](websocket::frame_type, beast::string_view) { heard_at_ = Clock::now(); });
    socket_.read_message_max(kMostMessage);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = shared_from_this()](Error error) {
      if (!error) self->begin();
    });
  }

  void tell(const Json& message) override {
    outbox_.tell(message);
    write();
  }

  void show(studio::ViewPicture picture) override {
    outbox_.show(std::move(picture), Clock::now());
    write();
  }

  void close() override { close(websocket::close_code::going_away); }

  void ask() override {
    if (closing_ || std::exchange(asking_, true)) return;
    socket_.async_ping({}, [self = shared_from_this()](Error) { self->asking_ = false; });
  }

  bool was_heard_since(Clock::time_point then) const override { return heard_at_ >= then; }
  void drop() override { end(); }

 private:
  void begin() {
    if (!site_.has_room()) return close(websocket::close_code::try_again_later);
    number_ = site_.enter(shared_from_this());
    read();
  }

  void close(websocket::close_code code) {
    if (std::exchange(closing_, true)) return;
    timer_.cancel();
    socket_.async_close(code, [self = shared_from_this()](Error) {});
  }

  // Whoever tells pages something may be going through them now.
  void end_later() {
    closing_ = true;
    asio::post(socket_.get_executor(), [self = shared_from_this()] { self->end(); });
  }

  // The page is gone, or does not deserve to be kept.
  void end() {
    closing_ = true;
    timer_.cancel();
    pause_.cancel();
    beast::get_lowest_layer(socket_).close();
    if (const auto number = std::exchange(number_, std::nullopt)) site_.left(*number);
  }

  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
      if (error) return self->end();
      self->heard_at_ = Clock::now();
      self->take();
    });
  }

  void take() {
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (!closing_ && !socket_.got_text()) close(websocket::close_code::unknown_data);
    if (closing_) return read();  // until the page's close frame
    hear(text);
    pause_.expires_after(rate_.take(Clock::now()));
    pause_.async_wait([self = shared_from_this()](Error error) {
      if (!error) self->read();
    });
  }

  void hear(const std::string& text) {
    try {
      const Json message = read_page_message(text);
      if (outbox_.hear(message, Clock::now())) site_.received(*number_, message);
    } catch (const std::exception& failure) {  // what the studio makes of a message, it answers itself
      outbox_.tell({{"is", "refused"}, {"text", reason_of(failure)}});
    }
    write();
  }

  void write() {
    if (closing_) return;
    if (outbox_.overflows()) return end_later();
    if (writing_) return;
    auto outgoing = next();
    if (closing_) return;
    if (!outgoing) return write_when_due();
    writing_ = true;
    outgoing_ = std::move(outgoing->bytes);
    socket_.text(outgoing->is_text);
    socket_.binary(!outgoing->is_text);
    socket_.async_write(asio::buffer(outgoing_), [self = shared_from_this()](Error error, std::size_t) {
      self->writing_ = false;
      if (error) return self->end();
      self->write();
    });
  }

  // A picture that cannot be encoded ends this page alone, which comes again.
  std::optional<PageOutbox::Outgoing> next() {
    try {
      return outbox_.next(Clock::now());
    } catch (const std::exception&) {
      end_later();
      return std::nullopt;
    }
  }

  void write_when_due() {
    const auto due = outbox_.due();
    if (!due) return;
    timer_.expires_at(*due);
    timer_.async_wait([self = shared_from_this()](Error error) {
      if (!error) self->write();
    });
  }

  websocket::stream<Stream, false> socket_;
  asio::steady_timer timer_, pause_;
  Site& site_;
  std::unique_ptr<Crowd::Place> place_;
  std::optional<PageNumber> number_;
  beast::flat_buffer buffer_;
  PageOutbox outbox_;
  MessageRate rate_;
  std::string outgoing_;
  Clock::time_point heard_at_ = Clock::now();
  bool writing_ = false, closing_ = false, asking_ = false;
};

}  // namespace

void serve_page(Stream stream, const HttpRequest& request, Site& site, std::unique_ptr<Crowd::Place> place) {
  std::make_shared<Socket>(std::move(stream), site, std::move(place))->accept(request);
}

}  // namespace mars::web
