// The bytes of one connection: over TCP, or over TLS over TCP. Beast's HTTP and WebSocket are compiled for this one
// type, as an AsyncStream whose operations take a handler, and asio's operations for the one type of handler that is
// here. Everything runs on the stream's executor.
#pragma once

#include <utility>  // Beast 1.74 needs it and does not say so

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/beast/core/buffers_range.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <cstddef>
#include <memory>

namespace boost::asio::ssl {
class context;
}

namespace mars::web {

using Error = boost::beast::error_code;

// What happens once an operation has ended: a function of an error and a number of bytes, which is called once at most
// and destroyed with this.
class Done {
 public:
  template <typename Function>
  explicit Done(Function function) : held_(std::make_unique<Held<Function>>(std::move(function))) {}

  void operator()(Error error, std::size_t bytes = 0) { held_->call(error, bytes); }

 private:
  struct Callable {
    virtual ~Callable() = default;
    virtual void call(Error error, std::size_t bytes) = 0;
  };
  template <typename Function>
  struct Held final : Callable {
    explicit Held(Function&& held) : function(std::move(held)) {}
    void call(Error error, std::size_t bytes) override { function(error, bytes); }
    Function function;
  };

  std::unique_ptr<Callable> held_;
};

// The first buffers of a sequence that are not empty. An operation on some bytes need not take more of them.
template <typename Buffer>
class SomeBuffers {
 public:
  using value_type = Buffer;
  using const_iterator = const Buffer*;

  template <typename Sequence>
  explicit SomeBuffers(const Sequence& sequence) {
    for (const Buffer each : boost::beast::buffers_range_ref(sequence)) {
      if (size_ == buffers_.size()) break;
      if (each.size() != 0) buffers_[size_++] = each;
    }
  }

  const_iterator begin() const { return buffers_.data(); }
  const_iterator end() const { return buffers_.data() + size_; }

 private:
  std::array<Buffer, 32> buffers_;  // an answer's header has a buffer for each field
  std::size_t size_ = 0;
};

class Stream {
 public:
  using executor_type = boost::beast::tcp_stream::executor_type;

  // `tls`, which outlives this: none where there is no TLS.
  Stream(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context* tls);
  Stream(Stream&& other) noexcept;
  ~Stream();

  executor_type get_executor() { return next_layer().get_executor(); }

  // TCP's, which has the limits of time, and ends at once when it is closed. Beast's get_lowest_layer finds this.
  boost::beast::tcp_stream& next_layer();

  // TLS's; over TCP alone `done` is called at once.
  void shake_hands(Done done);

  template <typename Buffers, typename Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    read_some(SomeBuffers<boost::asio::mutable_buffer>(buffers), Done(std::forward<Handler>(handler)));
  }
  template <typename Buffers, typename Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    write_some(SomeBuffers<boost::asio::const_buffer>(buffers), Done(std::forward<Handler>(handler)));
  }

  // Beast's WebSocket calls this after its close frames: TLS is shut down, TCP is read until its end and closed.
  template <typename Handler>
  friend void async_teardown(boost::beast::role_type role, Stream& stream, Handler&& handler) {
    stream.tear_down(
        role, Done([handler = std::forward<Handler>(handler)](Error error, std::size_t) mutable { handler(error); }));
  }

 private:
  void read_some(const SomeBuffers<boost::asio::mutable_buffer>& buffers, Done done);
  void write_some(const SomeBuffers<boost::asio::const_buffer>& buffers, Done done);
  void tear_down(boost::beast::role_type role, Done done);

  struct Layers;
  std::unique_ptr<Layers> layers_;
};

}  // namespace mars::web
