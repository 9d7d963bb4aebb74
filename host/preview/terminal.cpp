#include "host/preview/terminal.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "hal/failure.h"

namespace mars::host {
namespace {

using Clock = std::chrono::steady_clock;

// The second screen, no cursor, no wrapping; and all of it back.
constexpr std::string_view kEnter = "\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[2J";
constexpr std::string_view kLeave = "\x1b[?2026l\x1b[0m\x1b[?7h\x1b[?25h\x1b[?1049l";
// Do you know kitty's graphics? Who are you? Every terminal answers the second, so it ends the waiting.
constexpr std::string_view kQuestions = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[c";
constexpr std::chrono::milliseconds kPatience{400};  // for answers, over slow lines too

// Of the answer "ESC [ ? 62 ; 4 ; 6 c": is 4, sixel, among its numbers?
bool has_sixel(const std::string& answer) {
  const std::size_t start = answer.find("\x1b[?");
  const std::size_t end = answer.find('c', start == std::string::npos ? 0 : start);
  if (start == std::string::npos || end == std::string::npos) return false;
  std::string numbers = answer.substr(start + 2, end - start - 2);  // "?62;4;6"
  numbers += ';';
  return numbers.find(";4;") != std::string::npos;
}

bool is_complete(const std::string& answer) {
  const std::size_t start = answer.find("\x1b[?");
  return start != std::string::npos && answer.find('c', start) != std::string::npos;
}

}  // namespace

Terminal::Terminal(Graphics wanted, const std::string& kind, bool colors24) : graphics_(wanted) {
  if (!isatty(0) || !isatty(1))
    throw Failure("there is no terminal to play in", "",
                  "write a file instead: -o sheet.png, -o film.gif or -o film.mp4");
  if (kind.empty() || kind == "dumb")
    throw Failure("the terminal cannot place pictures (TERM is '" + kind + "')", "",
                  "write a file instead: -o sheet.png, -o film.gif or -o film.mp4");
  take_signals();
  tcgetattr(0, &before_);
  try {
    enter();
    if (wanted == Graphics::automatic) ask(colors24);
  } catch (...) {
    leave();
    throw;
  }
}

void Terminal::take_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGCONT, SIGWINCH}) sigaddset(&set, signal);
  pthread_sigmask(SIG_BLOCK, &set, &signals_before_);
  signals_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
}

void Terminal::ask(bool colors24) {
  const std::string answer = answers(kQuestions);
  graphics_ = answer.find("\x1b_Gi=31;OK") != std::string::npos ? Graphics::kitty
              : has_sixel(answer)                             ? Graphics::sixel
              : colors24                                      ? Graphics::blocks
                                                              : Graphics::blocks256;
  write("\x1b[2J");  // what a terminal showed of a question it did not understand
}

Terminal::~Terminal() {
  leave();
  if (signals_ >= 0) close(signals_);
  pthread_sigmask(SIG_SETMASK, &signals_before_, nullptr);
}

void Terminal::enter() {
  termios raw = before_;
  raw.c_iflag &= ~static_cast<tcflag_t>(IXON | ICRNL);
  raw.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON | IEXTEN);  // Ctrl-C and Ctrl-Z stay signals
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  tcsetattr(0, TCSAFLUSH, &raw);
  entered_ = true;
  measure();
  write(kEnter);
}

void Terminal::leave() {
  if (!entered_) return;
  entered_ = false;
  try {
    if (graphics_ == Graphics::kitty) write("\x1b_Ga=d,d=A,q=2\x1b\\");
    write(kLeave);
  } catch (const Failure&) {
    // The terminal is gone: nothing is left to be put right.
  }
  tcsetattr(0, TCSAFLUSH, &before_);
}

// Gives the terminal back, stops as anyone would, and goes on where it was.
void Terminal::suspend() {
  leave();
  raise(SIGSTOP);
  tcgetattr(0, &before_);
  enter();
}

void Terminal::measure() {
  winsize size{};
  if (ioctl(1, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return;
  cells_ = {size.ws_col, size.ws_row};
  if (size.ws_xpixel >= size.ws_col && size.ws_ypixel >= size.ws_row)
    cell_ = {static_cast<std::uint32_t>(size.ws_xpixel / size.ws_col),
             static_cast<std::uint32_t>(size.ws_ypixel / size.ws_row)};
}

void Terminal::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(1, bytes.data(), bytes.size());
    if (done < 0 && errno == EAGAIN) {
      pollfd ready{1, POLLOUT, 0};
      poll(&ready, 1, 100);
    } else if (done < 0 && errno != EINTR) {
      throw Failure(std::string("cannot write to the terminal: ") + std::strerror(errno), "", "");
    } else if (done > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(done));
    }
  }
}

std::string Terminal::answers(std::string_view questions) {
  write(questions);
  std::string answer;
  const auto deadline = Clock::now() + kPatience;
  while (!is_complete(answer)) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd input{0, POLLIN, 0};
    if (left <= 0 || poll(&input, 1, static_cast<int>(left)) <= 0) break;
    std::array<char, 256> bytes;
    const ssize_t done = read(0, bytes.data(), bytes.size());
    if (done <= 0) break;
    answer.append(bytes.data(), static_cast<std::size_t>(done));
  }
  return answer;
}

TerminalEvents Terminal::wait(std::chrono::nanoseconds time) {
  TerminalEvents events;
  std::array<pollfd, 2> sources{{{0, POLLIN, 0}, {signals_, POLLIN, 0}}};
  const timespec limit{static_cast<time_t>(time.count() / 1'000'000'000),
                       static_cast<long>(time.count() % 1'000'000'000)};
  ppoll(sources.data(), sources.size(), &limit, nullptr);
  signalfd_siginfo signal;
  while (read(signals_, &signal, sizeof signal) == sizeof signal) {
    const auto number = static_cast<int>(signal.ssi_signo);
    if (number == SIGTSTP) suspend();
    if (number == SIGTSTP || number == SIGCONT || number == SIGWINCH)
      events.redraw = true;
    else
      events.ended_by = number;
  }
  if (events.redraw) {
    measure();
    write("\x1b[2J");
  }
  if (sources[0].revents == 0) return events;
  std::array<char, 256> bytes;
  const ssize_t done = read(0, bytes.data(), bytes.size());
  if (done > 0) unread_.append(bytes.data(), static_cast<std::size_t>(done));
  if (done == 0 && (sources[0].revents & POLLHUP) != 0) events.ended_by = SIGHUP;
  events.keys = take_keys(unread_);
  return events;
}

}  // namespace mars::host
