#include "host/studio/web/stream.h"

#include <boost/asio/ssl/context.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <variant>

namespace mars::web {

namespace asio = boost::asio;
namespace beast = boost::beast;
using Tcp = beast::tcp_stream;
using Tls = beast::ssl_stream<beast::tcp_stream>;

struct Stream::Layers : std::variant<Tcp, Tls> {
  using variant::variant;
};

Stream::Stream(asio::ip::tcp::socket socket, asio::ssl::context* tls)
    : layers_(tls == nullptr ? std::make_unique<Layers>(std::in_place_type<Tcp>, std::move(socket))
                             : std::make_unique<Layers>(std::in_place_type<Tls>, std::move(socket), *tls)) {}

Stream::Stream(Stream&& other) noexcept = default;
Stream::~Stream() = default;

Tcp& Stream::next_layer() {
  Tls* const tls = std::get_if<Tls>(layers_.get());
  return tls != nullptr ? tls->next_layer() : std::get<Tcp>(*layers_);
}

void Stream::shake_hands(Done done) {
  if (Tls* const tls = std::get_if<Tls>(layers_.get()); tls != nullptr)
    return tls->async_handshake(asio::ssl::stream_base::server, std::move(done));
  done({});
}

void Stream::read_some(const SomeBuffers<asio::mutable_buffer>& buffers, Done done) {
  std::visit([&](auto& layer) { layer.async_read_some(buffers, std::move(done)); }, *layers_);
}

void Stream::write_some(const SomeBuffers<asio::const_buffer>& buffers, Done done) {
  std::visit([&](auto& layer) { layer.async_write_some(buffers, std::move(done)); }, *layers_);
}

void Stream::tear_down(beast::role_type role, Done done) {
  using beast::websocket::async_teardown;
  std::visit([&](auto& layer) { async_teardown(role, layer, std::move(done)); }, *layers_);
}

}  // namespace mars::web
