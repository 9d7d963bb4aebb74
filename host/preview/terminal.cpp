#include "host/preview/terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "hal/failure/failure.h"

namespace mars::preview {
namespace {

using Clock = std::chrono::steady_clock;

// The second screen, no cursor, no wrapping; and all of it back.
constexpr std::string_view kEnter = "\x1b[?1049h\x1b[?25l\x1b[?7l\x1b[2J";
constexpr std::string_view kLeave = "\x1b[?2026l\x1b[0m\x1b[?7h\x1b[?25h\x1b[?1049l";
constexpr std::string_view kEndPicture = "\x1b\\";  // that was cut off
constexpr std::string_view kDeletePictures = "\x1b_Ga=d,d=A,q=2\x1b\\";
// Do you know kitty's graphics? Who are you? Every terminal answers the second, so it ends the waiting.
constexpr std::string_view kQuestions = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[c";
constexpr std::chrono::milliseconds kWithinKey{60};  // between the bytes of one key, over slow lines too
constexpr std::chrono::milliseconds kPatience{400};  // for answers and the last words, over slow lines too

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

// Standard output, opened once more so that writing never blocks and other programs that share it do not notice. Where
// that is not allowed, as in another user's terminal, it does block.
int open_output() {
  const int own = open("/proc/self/fd/1", O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  return own >= 0 ? own : fcntl(1, F_DUPFD_CLOEXEC, 0);
}

}  // namespace

Terminal::Terminal(Graphics wanted, const std::string& kind, bool colors24) : graphics_(wanted) {
  if (!isatty(0) || !isatty(1))
    throw Failure("there is no terminal to play in", "",
                  "write a file instead: -o sheet.png, -o film.gif or -o film.mp4");
  if (kind.empty() || kind == "dumb")
    throw Failure("the terminal cannot place pictures (TERM is '" + kind + "')", "",
                  "write a file instead: -o sheet.png, -o film.gif or -o film.mp4");
  block_signals();
  output_ = open_output();
  tcgetattr(0, &before_);
  try {
    enter();
    if (wanted == Graphics::automatic) ask(colors24);
  } catch (...) {
    leave();
    throw;
  }
}

void Terminal::block_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGCONT, SIGWINCH}) sigaddset(&set, signal);
  pthread_sigmask(SIG_BLOCK, &set, &signals_before_);
  signals_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
}

void Terminal::ask(bool colors24) {
  const std::string answer = answers(kQuestions);
  graphics_ = answer.find("\x1b_Gi=31;OK") != std::string::npos ? Graphics::kitty
              : has_sixel(answer)                               ? Graphics::sixel
              : colors24                                        ? Graphics::blocks
                                                                : Graphics::blocks256;
  write("\x1b[2J");  // what a terminal showed of a question it did not understand
}

Terminal::~Terminal() {
  leave();
  close(output_);
  close(signals_);
  pthread_sigmask(SIG_SETMASK, &signals_before_, nullptr);
}

// Without waiting for the output, which may never be taken.
void Terminal::set_modes(const termios& modes) {
  tcsetattr(0, TCSANOW, &modes);
  tcflush(0, TCIFLUSH);
}

void Terminal::enter() {
  termios raw = before_;
  raw.c_iflag &= ~static_cast<tcflag_t>(IXON | ICRNL);
  raw.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON | IEXTEN);  // Ctrl-C and Ctrl-Z stay signals
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  set_modes(raw);
  entered_ = true;
  measure();
  write(kEnter);
}

void Terminal::leave() {
  if (!entered_) return;
  entered_ = false;
  try {
    std::string last(kEndPicture);
    if (graphics_ == Graphics::kitty) last += kDeletePictures;
    write_within(last.append(kLeave), kPatience);
  } catch (const Failure&) {
    // The terminal is gone: nothing is left to be put right.
  }
  set_modes(before_);
}

// Gives the terminal back, stops as anyone would, and goes on where it was. The kernel does not stop a process of
// an orphaned group.
void Terminal::suspend() {
  leave();
  sigset_t stop;
  sigemptyset(&stop);
  sigaddset(&stop, SIGTSTP);
  raise(SIGTSTP);
  pthread_sigmask(SIG_UNBLOCK, &stop, nullptr);
  pthread_sigmask(SIG_BLOCK, &stop, nullptr);
  tcgetattr(0, &before_);
  read_signals();
}

void Terminal::measure() {
  winsize size{};
  if (ioctl(1, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return;
  cells_ = {size.ws_col, size.ws_row};
  if (size.ws_xpixel >= size.ws_col && size.ws_ypixel >= size.ws_row)
    cell_ = {static_cast<std::uint32_t>(size.ws_xpixel / size.ws_col),
             static_cast<std::uint32_t>(size.ws_ypixel / size.ws_row)};
}

// Takes from `bytes` what the terminal takes at once; false: that is nothing.
bool Terminal::write_some(std::string_view& bytes) {
  const ssize_t done = ::write(output_, bytes.data(), bytes.size());
  if (done > 0) bytes.remove_prefix(static_cast<std::size_t>(done));
  if (done >= 0 || errno == EINTR) return true;
  if (errno == EAGAIN) return false;
  if (errno != EIO) throw Failure(std::string("cannot write to the terminal: ") + std::strerror(errno), "", "");
  ended_by_ = SIGHUP;  // it was closed
  bytes = {};
  return true;
}

void Terminal::write(std::string_view bytes) {
  while (!bytes.empty() && ended_by_ == 0) {
    if (write_some(bytes)) continue;
    std::array<pollfd, 2> sources{{{output_, POLLOUT, 0}, {signals_, POLLIN, 0}}};
    poll(sources.data(), sources.size(), -1);
    read_signals();
  }
}

void Terminal::write_within(std::string_view bytes, std::chrono::milliseconds time) {
  const auto deadline = Clock::now() + time;
  while (!bytes.empty()) {
    if (write_some(bytes)) continue;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd ready{output_, POLLOUT, 0};
    if (left <= 0 || poll(&ready, 1, static_cast<int>(left)) <= 0) return;
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

void Terminal::read_signals() {
  signalfd_siginfo signal;
  while (read(signals_, &signal, sizeof signal) == sizeof signal) switch (signal.ssi_signo) {
      case SIGTSTP: stop_ = true; break;
      case SIGCONT: continued_ = true; break;
      case SIGWINCH: resized_ = true; break;
      default: ended_by_ = static_cast<int>(signal.ssi_signo);
    }
}

// The shell that continues us may have changed the terminal's modes and screen meanwhile.
void Terminal::handle_signals() {
  if (stop_) suspend();
  if (ended_by_ != 0) return;
  if (stop_ || continued_) {
    enter();
  } else if (resized_) {
    measure();
    write("\x1b[2J");
  }
  stop_ = continued_ = resized_ = false;
}

void Terminal::read_keys() {
  std::array<char, 256> bytes;
  const ssize_t done = read(0, bytes.data(), bytes.size());
  if (done > 0) unread_.append(bytes.data(), static_cast<std::size_t>(done));
  read_at_ = Clock::now();
  if (done < 0 && errno == EIO) ended_by_ = SIGHUP;  // closed, or no longer ours
}

TerminalEvents Terminal::wait(std::chrono::nanoseconds time) {
  std::array<pollfd, 2> sources{{{0, POLLIN, 0}, {signals_, POLLIN, 0}}};
  const timespec limit{static_cast<time_t>(time.count() / 1'000'000'000),
                       static_cast<long>(time.count() % 1'000'000'000)};
  if (ended_by_ == 0) ppoll(sources.data(), sources.size(), &limit, nullptr);
  read_signals();
  TerminalEvents events;
  events.redraw = stop_ || continued_ || resized_;
  handle_signals();
  if (sources[0].revents != 0) read_keys();
  if ((sources[0].revents & POLLHUP) != 0) ended_by_ = SIGHUP;
  events.keys = take_keys(unread_);
  if (unread_ == kEscape && Clock::now() - read_at_ > kWithinKey) {
    events.keys.push_back({0, Special::escape});
    unread_.clear();
  }
  events.ended_by = ended_by_;
  return events;
}

}  // namespace mars::preview
