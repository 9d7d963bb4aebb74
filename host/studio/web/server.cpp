#include "host/studio/web/server.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <map>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/studio/web/connection.h"
#include "host/studio/web/tls.h"
#include "host/studio/web/token.h"

namespace mars::web {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using Error = boost::system::error_code;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostPages = 16;
constexpr std::size_t kMostConnections = 64;
constexpr std::chrono::milliseconds kNoDescriptors{200};  // until accepting is tried again

std::string own_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "localhost";
}

asio::ip::address address_of(const std::string& text) {
  Error problem;
  const asio::ip::address address = asio::ip::make_address(text, problem);
  if (problem)
    throw Failure("'" + text + "' is no address", "", "give --listen an address of this machine, as 0.0.0.0");
  return address;
}

tcp::acceptor listen(asio::io_context& context, const tcp::endpoint& at) {
  tcp::acceptor acceptor(context, at.protocol());
  acceptor.set_option(asio::socket_base::reuse_address(true));
  acceptor.bind(at);
  acceptor.listen();
  return acceptor;
}

tcp::acceptor listen(asio::io_context& context, const ServerSettings& settings) {
  const asio::ip::address address = address_of(settings.address);
  try {
    return listen(context, {address, settings.port});
  } catch (const boost::system::system_error& error) {
    const bool taken = error.code() == asio::error::address_in_use;
    if (taken && settings.may_choose) return listen(context, {address, 0});
    throw Failure("the studio cannot listen: " + error.code().message(),
                  settings.address + ", port " + std::to_string(settings.port),
                  taken ? "give another --port, or leave it out" : "give another --port or --listen");
  }
}

class TcpServer final : public Server, private Site {
 public:
  TcpServer(asio::io_context& context, const ServerSettings& settings, PageListener listener)
      : folder_(settings.folder),
        patience_(settings.patience),
        listener_(std::move(listener)),
        tls_(settings.certificate.empty() ? nullptr : make_tls(settings.certificate, settings.key)),
        gate_(make_token(), tls_ != nullptr, {own_name()}),
        acceptor_(listen(context, settings)),
        pause_(context),
        room_(context) {
    accept();
  }

  std::string link() const override {
    const tcp::endpoint at = acceptor_.local_endpoint();
    std::string name = at.address().is_unspecified() ? own_name() : at.address().to_string();
    if (at.address().is_v6() && !at.address().is_unspecified()) name = "[" + name + "]";
    return std::string(gate_.scheme()) + "://" + name + ":" + std::to_string(at.port()) + "/?token=" + gate_.token();
  }

  void close() override {
    acceptor_.close();
    pause_.cancel();
    room_.cancel();
    newcomer_.reset();
    for (const auto& [number, page] : pages_) page->close();
  }

  void tell(PageNumber number, const Json& message) override {
    for (const auto& [each, page] : pages_)
      if (each == number || number == studio::Stage::kAllPages) page->tell(message);
  }

  void show(studio::ViewPicture picture) override {
    const auto page = pages_.find(picture.page);
    if (page != pages_.end()) page->second->show(std::move(picture));
  }

 private:
  const Gate& gate() const override { return gate_; }
  const std::filesystem::path& folder() const override { return folder_; }
  const Patience& patience() const override { return patience_; }
  bool has_room() const override { return pages_.size() < kMostPages; }

  // One waits at most, the newest: a person has just opened it.
  void wait_for_room(std::shared_ptr<Newcomer> newcomer) override {
    if (const auto before = std::exchange(newcomer_, std::move(newcomer))) return before->answer(false);
    for (const auto& [number, page] : pages_) page->ask();
    room_.expires_after(patience_.answer);
    room_.async_wait([this, asked_at = Clock::now()](Error error) {
      if (!error) answer_newcomer(asked_at);
    });
  }

  void answer_newcomer(Clock::time_point asked_at) {
    for (const auto& [number, page] : std::map(pages_))
      if (!page->was_heard_since(asked_at)) page->drop();
    if (const auto newcomer = std::exchange(newcomer_, nullptr)) newcomer->answer(has_room());
  }

  PageNumber enter(std::shared_ptr<PageSocket> page) override {
    const PageNumber number = ++last_page_;
    pages_.emplace(number, std::move(page));
    listener_.opened(number);
    return number;
  }

  void received(PageNumber page, const Json& message) override { listener_.received(page, message); }

  void left(PageNumber page) override {
    pages_.erase(page);
    listener_.closed(page);
  }

  std::unique_ptr<studio::Upload> begin_upload(std::string_view path, std::uint64_t bytes) override {
    const std::string numbers(path.substr(kUploads.size()));
    const std::size_t slash = std::min(numbers.find('/'), numbers.size());
    const auto import = document::number_in<std::uint32_t>(numbers.substr(0, slash));
    const auto file = document::number_in<std::uint32_t>(numbers.substr(std::min(slash + 1, numbers.size())));
    if (!import || !file || !listener_.uploaded) throw Failure("there is no import of this name", "", "");
    return listener_.uploaded({*import, *file, bytes});
  }

  void accept() {
    acceptor_.async_accept([this](Error error, tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (error) return accept_later();
      if (crowd_->size() < kMostConnections || crowd_->make_room()) {
        socket.set_option(tcp::no_delay(true), error);
        serve_connection(std::move(socket), tls_.get(), *this, crowd_->enter());
      }
      accept();
    });
  }

  // Descriptors ran out, most likely: others may end.
  void accept_later() {
    pause_.expires_after(kNoDescriptors);
    pause_.async_wait([this](Error error) {
      if (!error) accept();
    });
  }

  std::filesystem::path folder_;
  Patience patience_;
  PageListener listener_;
  std::unique_ptr<asio::ssl::context> tls_;
  Gate gate_;
  tcp::acceptor acceptor_;
  asio::steady_timer pause_, room_;
  std::map<PageNumber, std::shared_ptr<PageSocket>> pages_;
  PageNumber last_page_ = 0;
  std::shared_ptr<Crowd> crowd_ = std::make_shared<Crowd>();  // connections may end after this
  std::shared_ptr<Newcomer> newcomer_;
};

}  // namespace

std::unique_ptr<Server> make_server(asio::io_context& context, const ServerSettings& settings, PageListener listener) {
  return std::make_unique<TcpServer>(context, settings, std::move(listener));
}

}  // namespace mars::web
