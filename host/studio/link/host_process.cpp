#include "host/studio/link/host_process.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/streambuf.hpp>
#include <chrono>
#include <istream>

#include "host/child/descriptor.h"

namespace mars::studio {
namespace {

namespace asio = boost::asio;
using Error = boost::system::error_code;
using namespace std::chrono_literals;

constexpr auto kLook = 20ms;       // for the end of a process that has closed its streams
constexpr auto kLongestStop = 5s;  // of a process that was asked to end
constexpr std::size_t kMostLine = 1 << 16;

}  // namespace

class HostProcess::Streams : public std::enable_shared_from_this<Streams> {
 public:
  Streams(asio::io_context& context, const Start& start, std::chrono::seconds grace, Listener listener)
      : grace_(grace), listener_(std::move(listener)), pipes_{child::make_pipe(), child::make_pipe()}, timer_(context) {
    const child::Descriptor nothing = child::null_device();
    process_ =
        start({.streams = {{0, nothing.number()}, {1, pipes_[0].writing.number()}, {2, pipes_[1].writing.number()}},
               .own_group = true,
               .signal_at_our_end = SIGTERM,
               .default_signals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE}});
    for (std::size_t i = 0; i < 2; ++i) {
      pipes_[i].writing.close();
      streams_[i].descriptor.emplace(context, dup(pipes_[i].reading.number()));
      pipes_[i].reading.close();
    }
  }

  void begin() {
    read(0);
    read(1);
  }

  void stop() { process_->send(SIGTERM); }

  void close() {
    closed_ = true;
    Error ignored;
    timer_.cancel(ignored);
    for (Stream& stream : streams_) stream.descriptor->close(ignored);
    if (ended_ || ends_within(grace_)) return;
    stop();
    if (!ends_within(kLongestStop)) process_->give_up();  // it kills what does not end, and takes its time for it
  }

 private:
  struct Stream {
    std::optional<asio::posix::stream_descriptor> descriptor;
    asio::streambuf rest{kMostLine};
  };

  void read(std::size_t number) {
    Stream& stream = streams_[number];
    asio::async_read_until(*stream.descriptor, stream.rest, '\n',
                           [self = shared_from_this(), number](Error error, std::size_t) {
                             if (self->closed_) return;
                             self->take_line(number);
                             if (!error) return self->read(number);
                             if (++self->streams_ended_ == 2) self->look_for_end();
                           });
  }

  void take_line(std::size_t number) {
    std::istream from(&streams_[number].rest);
    std::string line;
    if (!std::getline(from, line) || line.empty()) return;
    if (number == 0) return listener_.warned(line);
    const std::string own = line.starts_with("mars: ") ? line.substr(6) : line;
    if (own.starts_with("warning: ")) return listener_.warned(own);
    if (reason_.empty()) reason_ = own;
  }

  bool ends_within(std::chrono::milliseconds longest) {
    const auto last = std::chrono::steady_clock::now() + longest;
    while (!process_->poll()) {
      if (std::chrono::steady_clock::now() >= last) return false;
      ::poll(nullptr, 0, 2);
    }
    return true;
  }

  void look_for_end() {
    if (const auto ending = process_->poll()) {
      ended_ = true;
      return listener_.ended(*ending, ending->well() ? "" : reason_);
    }
    timer_.expires_after(kLook);
    timer_.async_wait([self = shared_from_this()](Error error) {
      if (!error && !self->closed_) self->look_for_end();
    });
  }

  const std::chrono::seconds grace_;
  const Listener listener_;
  std::array<child::Pipe, 2> pipes_;  // until it is started
  std::unique_ptr<child::Process> process_;
  std::array<Stream, 2> streams_;
  asio::steady_timer timer_;
  std::string reason_;
  int streams_ended_ = 0;
  bool closed_ = false, ended_ = false;
};

HostProcess::HostProcess(asio::io_context& context, const Start& start, std::chrono::seconds grace, Listener listener)
    : streams_(std::make_shared<Streams>(context, start, grace, std::move(listener))) {
  streams_->begin();
}

HostProcess::~HostProcess() { streams_->close(); }

void HostProcess::stop() { streams_->stop(); }

}  // namespace mars::studio
