#include "host/studio/serve_studio.h"

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "host/studio/opening.h"
#include "host/studio/web/server.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
using namespace std::chrono_literals;
using Error = boost::system::error_code;

constexpr auto kLook = 200ms;      // between looks at files
constexpr auto kFarewell = 300ms;  // for pages to answer a close frame
constexpr auto kLongestStep = 5s;  // that a signal waits for

void warn(const std::string& text) { std::cerr << "mars: warning: " << text << '\n'; }

// Not where nohup started this.
bool signal_is_heard(int number) {
  struct sigaction action {};
  return sigaction(number, nullptr, &action) == 0 && action.sa_handler != SIG_IGN;
}

// Hears signals in a thread of its own, so that they end the studio also in the middle of a long step. The file then is
// as it was before the step; renderers end with their studio.
class Signals {
 public:
  // `end` runs in `loop`; the second signal stops the loop, and waits for nobody.
  Signals(asio::io_context& loop, std::function<void()> end)
      : loop_(loop), end_(std::move(end)), signals_(context_, SIGINT, SIGTERM), patience_(context_) {
    if (signal_is_heard(SIGHUP)) signals_.add(SIGHUP);
    wait();
    thread_ = std::jthread([this] { context_.run(); });
  }
  ~Signals() { context_.stop(); }

 private:
  void wait() {
    signals_.async_wait([this](Error error, int) {
      if (error) return;
      if (!asked_)
        ask();
      else if (heard_)
        loop_.stop();
      else
        end_at_once();
      wait();
    });
  }

  void ask() {
    asked_ = true;
    asio::post(loop_, [this] {
      heard_ = true;
      end_();
    });
    patience_.expires_after(kLongestStep);
    patience_.async_wait([this](Error error) {
      if (!error && !heard_) end_at_once();
    });
  }

  [[noreturn]] static void end_at_once() {
    std::cerr << "mars: the studio ends in the middle of a step, which is not done\n";
    std::_Exit(1);
  }

  asio::io_context& loop_;
  const std::function<void()> end_;
  asio::io_context context_{1};
  asio::signal_set signals_;
  asio::steady_timer patience_;
  bool asked_ = false;  // of the thread alone
  std::atomic<bool> heard_ = false;
  std::jthread thread_;
};

class Serving {
 public:
  Serving(const StudioSettings& settings, const MakeParts& make_parts) : look_(context_), farewell_(context_) {
    const std::filesystem::path file = file_to_open(settings.file);
    server_ = web::make_server(context_, server_settings(settings), page_listener());
    studio_ = std::make_unique<Studio>(make_parts(file, context_), *server_);
    if (settings.insecure && settings.certificate.empty())
      warn("without TLS, whoever reads this network's traffic gets the token and may work in the studio");
    if (!std::filesystem::exists(file)) std::cout << file.string() << " is new: your first step writes it\n";
    std::cout << "Open " << server_->link() << '\n' << "Ctrl-C ends the studio\n" << std::flush;
    if (settings.browser) browser_.emplace(server_->link());
  }

  void run() {
    const Signals signals(context_, [this] { end(); });
    look();
    context_.run();
  }

 private:
  web::PageListener page_listener() {
    return {.opened = [this](PageNumber page) { studio_->page_opened(page); },
            .received = [this](PageNumber page, const Json& message) { studio_->handle_message(page, message); },
            .closed = [this](PageNumber page) { studio_->page_closed(page); },
            .uploaded = [this](const UploadedFile& file) { return studio_->upload(file); }};
  }

  void end() {
    server_->close();
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
  asio::steady_timer look_, farewell_;
  std::unique_ptr<web::Server> server_;
  std::unique_ptr<Studio> studio_;
  std::optional<Browser> browser_;
};

}  // namespace

void serve_studio(const StudioSettings& settings, const MakeParts& make_parts) { Serving(settings, make_parts).run(); }

}  // namespace mars::studio
