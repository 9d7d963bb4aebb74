#include "host/studio/serve_studio.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <csignal>
#include <iostream>
#include <memory>

#include "host/studio/opening.h"
#include "host/studio/web/server.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
using namespace std::chrono_literals;
using Error = boost::system::error_code;

constexpr auto kLook = 200ms;      // between looks at files
constexpr auto kFarewell = 300ms;  // for pages to answer a close frame

void warn(const std::string& text) { std::cerr << "mars: warning: " << text << '\n'; }

// Not where nohup started this.
bool signal_is_heard(int number) {
  struct sigaction action {};
  return sigaction(number, nullptr, &action) == 0 && action.sa_handler != SIG_IGN;
}

class Serving {
 public:
  Serving(const StudioSettings& settings, const MakeParts& make_parts)
      : signals_(context_, SIGINT, SIGTERM), look_(context_), farewell_(context_) {
    const std::filesystem::path file = file_to_open(settings.file);
    server_ = web::make_server(context_, server_settings(settings), page_listener());
    studio_ = std::make_unique<Studio>(make_parts(file, context_), *server_);
    if (settings.insecure && settings.certificate.empty())
      warn("without TLS, whoever reads this network's traffic gets the token and may work in the studio");
    if (signal_is_heard(SIGHUP)) signals_.add(SIGHUP);
    if (!std::filesystem::exists(file)) std::cout << file.string() << " is new: your first step writes it\n";
    std::cout << "Open " << server_->link() << '\n' << "Ctrl-C ends the studio\n" << std::flush;
    if (settings.browser) browser_.emplace(server_->link());
  }

  void run() {
    wait_for_signal();
    look();
    context_.run();
  }

 private:
  web::PageListener page_listener() {
    return {.opened = [this](PageNumber page) { studio_->page_opened(page); },
            .received = [this](PageNumber page, const Json& message) { studio_->handle_message(page, message); },
            .closed = [this](PageNumber page) { studio_->page_closed(page); }};
  }

  // The second one waits for nobody.
  void wait_for_signal() {
    signals_.async_wait([this](Error error, int) {
      if (error) return;
      if (ending_) return context_.stop();
      ending_ = true;
      server_->close();
      wait_for_signal();
      wait_for_farewell();
    });
  }

  void wait_for_farewell() {
    farewell_.expires_after(kFarewell);
    farewell_.async_wait([this](Error) { context_.stop(); });
  }

  void look() {
    look_.expires_after(kLook);
    look_.async_wait([this](Error error) {
      if (error) return;
      studio_->look_at_files();
      look();
    });
  }

  asio::io_context context_{1};
  asio::signal_set signals_;
  asio::steady_timer look_, farewell_;
  bool ending_ = false;
  std::unique_ptr<web::Server> server_;
  std::unique_ptr<Studio> studio_;
  std::optional<Browser> browser_;
};

}  // namespace

void serve_studio(const StudioSettings& settings, const MakeParts& make_parts) { Serving(settings, make_parts).run(); }

}  // namespace mars::studio
