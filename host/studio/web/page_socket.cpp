#include "host/studio/web/streams.h"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
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

constexpr std::chrono::seconds kSilence{20};  // without a sign of life, after a ping

template <typename Stream>
class Socket final : public PageSocket, public std::enable_shared_from_this<Socket<Stream>> {
 public:
  Socket(Stream stream, Site& site, std::shared_ptr<void> counted)
      : socket_(std::move(stream)),
        timer_(socket_.get_executor()),
        pause_(socket_.get_executor()),
        site_(site),
        counted_(std::move(counted)) {}

  void accept(const HttpRequest& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has its own
    socket_.set_option(websocket::stream_base::timeout{kPatience, kSilence, true});
    socket_.read_message_max(kMostMessage);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = this->shared_from_this()](Error error) {
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

 private:
  void begin() {
    if (!site_.has_room()) return close(websocket::close_code::try_again_later);
    number_ = site_.enter(this->shared_from_this());
    read();
  }

  void close(websocket::close_code code) {
    if (std::exchange(closing_, true)) return;
    timer_.cancel();
    socket_.async_close(code, [self = this->shared_from_this()](Error) {});
  }

  // Whoever tells pages something may be going through them now.
  void end_later() {
    closing_ = true;
    asio::post(socket_.get_executor(), [self = this->shared_from_this()] { self->end(); });
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
    socket_.async_read(buffer_, [self = this->shared_from_this()](Error error, std::size_t) {
      if (error) return self->end();
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
    pause_.async_wait([self = this->shared_from_this()](Error error) {
      if (!error) self->read();
    });
  }

  void hear(const std::string& text) {
    try {
      const Json message = read_page_message(text);
      if (outbox_.hear(message, Clock::now())) site_.said(*number_, message);
    } catch (const Failure& failure) {
      outbox_.tell({{"is", "refused"}, {"text", reason_of(failure)}});
    }
    write();
  }

  void write() {
    if (closing_) return;
    if (outbox_.overflows()) return end_later();
    if (writing_) return;
    auto outgoing = outbox_.next(Clock::now());
    if (!outgoing) return write_when_due();
    writing_ = true;
    outgoing_ = std::move(outgoing->bytes);
    socket_.text(outgoing->is_text);
    socket_.binary(!outgoing->is_text);
    socket_.async_write(asio::buffer(outgoing_), [self = this->shared_from_this()](Error error, std::size_t) {
      self->writing_ = false;
      if (error) return self->end();
      self->write();
    });
  }

  void write_when_due() {
    const auto due = outbox_.due();
    if (!due) return;
    timer_.expires_at(*due);
    timer_.async_wait([self = this->shared_from_this()](Error error) {
      if (!error) self->write();
    });
  }

  websocket::stream<Stream> socket_;
  asio::steady_timer timer_, pause_;
  Site& site_;
  std::shared_ptr<void> counted_;
  std::optional<PageNumber> number_;
  beast::flat_buffer buffer_;
  PageOutbox outbox_;
  MessageRate rate_;
  std::string outgoing_;
  bool writing_ = false, closing_ = false;
};

}  // namespace

template <typename Stream>
void serve_page(Stream stream, const HttpRequest& request, Site& site, std::shared_ptr<void> counted) {
  std::make_shared<Socket<Stream>>(std::move(stream), site, std::move(counted))->accept(request);
}

template void serve_page(Plain, const HttpRequest&, Site&, std::shared_ptr<void>);
template void serve_page(Tls, const HttpRequest&, Site&, std::shared_ptr<void>);

}  // namespace mars::web
