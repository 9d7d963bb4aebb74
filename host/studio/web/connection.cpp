#include "host/studio/web/connection.h"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/explain.h"
#include "host/studio/web/page_files.h"
#include "host/studio/web/page_socket.h"
#include "host/studio/web/stream.h"

namespace mars::web {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

constexpr std::uint32_t kMostHeader = 8192;  // bytes
constexpr std::size_t kPiece = 64 * 1024;    // bytes of an upload that are taken at a time

std::string_view view_of(boost::beast::string_view text) { return {text.data(), text.size()}; }

Request request_of(const HttpRequest& request) {
  return {view_of(request.method_string()), view_of(request.target()), view_of(request[http::field::host]),
          view_of(request[http::field::origin]), view_of(request[http::field::if_none_match])};
}

// Requests one after another, until one asks for a WebSocket.
class Visit final : public Newcomer, public std::enable_shared_from_this<Visit> {
 public:
  Visit(Stream stream, Site& site, std::unique_ptr<Crowd::Place> place)
      : stream_(std::move(stream)), site_(site), place_(std::move(place)) {}

  void begin() {
    place_->may_give_way([this] { beast::get_lowest_layer(stream_).close(); });
    beast::get_lowest_layer(stream_).expires_after(site_.patience().request);
    stream_.shake_hands(Done([self = shared_from_this()](Error error, std::size_t) {
      if (!error) self->read();
    }));
  }

  void answer(bool has_room) override {
    if (!has_room) return refuse({503, "The studio has no room for another page.\n"});
    place_->becomes_page();
    serve_page(std::move(stream_), parser_->get(), site_, std::move(place_));
  }

 private:
  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeader);
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());  // bodies are taken of uploads alone, in pieces
    beast::get_lowest_layer(stream_).expires_after(site_.patience().request);
    http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
      if (error == http::error::end_of_stream) return self->end();
      if (error == http::error::header_limit) return self->refuse({431, "The request's header is too long.\n"});
      if (error.category() == make_error_code(http::error::bad_method).category())
        return self->refuse({400, "This is no request.\n"});
      if (!error) self->take();
    });
  }

  void take() {
    place_->request_came();
    const HttpRequest& request = parser_->get();
    const Request asked = request_of(request);
    host_ = asked.host;
    is_head_ = request.method() == http::verb::head;
    if (asked.method == "POST" && path_of(asked.target).starts_with(kUploads)) return take_upload(asked);
    if (const Refusal refusal = site_.gate().check(asked); refusal.status != 0) return refuse(refusal);
    if (!parser_->is_done()) return refuse({413, "A request has no body here.\n"});
    if (path_of(asked.target) != "/ws")
      return write(answer_file(site_.folder(), path_of(asked.target), asked.known), request.keep_alive());
    if (!beast::websocket::is_upgrade(request)) return refuse(for_no_socket(asked));
    if (const Refusal refusal = site_.gate().check_socket(asked); refusal.status != 0) return refuse(refusal);
    if (!site_.has_room()) return site_.wait_for_room(shared_from_this());
    answer(true);
  }

  // The file's bytes go on as they come, so that the studio has no more of it in memory than a piece.
  void take_upload(const Request& asked) {
    if (const Refusal refusal = site_.gate().check_upload(asked); refusal.status != 0) return refuse(refusal);
    const auto length = parser_->content_length();
    if (!length) return refuse({411, "An upload says how long it is.\n"});
    keep_alive_ = parser_->get().keep_alive();
    passing_on([&] {
      upload_ = site_.begin_upload(path_of(asked.target), *length);
      body_.emplace(std::move(*parser_));
      piece_.resize(kPiece);
      go_on_with_upload();
    });
  }

  // What the studio cannot take ends the upload, with the reason as its answer.
  void passing_on(const std::function<void()>& work) {
    try {
      work();
    } catch (const std::exception& failure) {
      upload_.reset();
      refuse({409, reason_of(failure) + "\n"});
    }
  }

  void go_on_with_upload() {
    if (!body_->is_done()) return read_piece();
    upload_->end();
    upload_.reset();
    write({}, keep_alive_);
  }

  void read_piece() {
    body_->get().body().data = piece_.data();
    body_->get().body().size = piece_.size();
    beast::get_lowest_layer(stream_).expires_after(site_.patience().request);
    http::async_read_some(stream_, buffer_, *body_, [self = shared_from_this()](Error error, std::size_t) {
      if (error && error != http::error::need_buffer) return self->upload_.reset();
      self->place_->request_came();
      self->passing_on([&] {
        self->upload_->take({self->piece_.data(), self->piece_.size() - self->body_->get().body().size});
        self->go_on_with_upload();
      });
    });
  }

  // A page asks so why its WebSocket is refused.
  Refusal for_no_socket(const Request& asked) const {
    const Refusal refusal = site_.gate().check_token(asked);
    return refusal.status != 0 ? refusal : Refusal{426, "This is for the page's WebSocket.\n"};
  }

  void refuse(const Refusal& refusal) {
    Answer answer;
    answer.status = refusal.status;
    answer.body = refusal.text;
    write(std::move(answer), false);
  }

  void write(Answer answer, bool keep_alive) {
    answer_ = {};
    answer_.result(answer.status);
    set_headers(answer);
    answer_.keep_alive(keep_alive);
    answer_.body() = std::move(answer.body);
    answer_.prepare_payload();
    if (is_head_) answer_.body().clear();  // its length is in the head
    beast::get_lowest_layer(stream_).expires_after(site_.patience().request);
    http::async_write(stream_, answer_, [self = shared_from_this(), keep_alive](Error error, std::size_t) {
      if (error || !keep_alive) return self->end();
      self->read();
    });
  }

  // The page loads nothing from elsewhere, runs no text as a program, and is in no other site's frame.
  void set_headers(const Answer& answer) {
    answer_.set(http::field::content_type, answer.type);
    answer_.set(http::field::cache_control, "no-cache");
    if (!answer.tag.empty()) answer_.set(http::field::etag, answer.tag);
    if (answer.status == 405) answer_.set(http::field::allow, "GET, HEAD");
    if (answer.status == 426) answer_.set(http::field::upgrade, "websocket");
    std::string sources =
        "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
        "object-src 'none'";
    if (answer.status < 400)  // then the host is ours
      sources += std::string("; connect-src 'self' ") + site_.gate().socket_scheme() + "://" + host_;
    answer_.set("Content-Security-Policy", sources);
    answer_.set("Cross-Origin-Opener-Policy", "same-origin");
    answer_.set("Cross-Origin-Resource-Policy", "same-origin");
    answer_.set("Referrer-Policy", "no-referrer");
    answer_.set("X-Content-Type-Options", "nosniff");
    answer_.set("X-Frame-Options", "DENY");
  }

  void end() {
    Error ignored;
    beast::get_lowest_layer(stream_).socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  }

  Stream stream_;
  Site& site_;
  std::unique_ptr<Crowd::Place> place_;
  beast::flat_buffer buffer_{2 * kMostHeader};
  std::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::string_body> answer_;
  std::string host_;                                             // of the request
  bool is_head_ = false;                                         // so its answer has no body
  std::optional<http::request_parser<http::buffer_body>> body_;  // of an upload
  std::vector<char> piece_;
  std::unique_ptr<studio::Upload> upload_;
  bool keep_alive_ = false;
};

}  // namespace

void serve_connection(asio::ip::tcp::socket socket, asio::ssl::context* tls, Site& site,
                      std::unique_ptr<Crowd::Place> place) {
  std::make_shared<Visit>(Stream(std::move(socket), tls), site, std::move(place))->begin();
}

}  // namespace mars::web
