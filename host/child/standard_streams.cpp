#include "host/child/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <mutex>
#include <streambuf>
#include <string>
#include <string_view>

#include "hal/failure/failure.h"
#include "hal/failure/plain_text.h"

namespace mars::child {
namespace {

// Gives lines to `to` as soon as they end, the rest when the stream is flushed: characters come in any pieces.
class PlainText : public std::streambuf {
 public:
  explicit PlainText(std::streambuf& to) : to_(to) {}

 private:
  int_type overflow(int_type character) override {
    if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
    const char one = traits_type::to_char_type(character);
    return xsputn(&one, 1) == 1 ? character : traits_type::eof();
  }

  std::streamsize xsputn(const char* text, std::streamsize length) override {
    const std::lock_guard lock(mutex_);
    waiting_.append(text, static_cast<std::size_t>(length));
    return pass_on(waiting_.rfind('\n') + 1) ? length : 0;  // 0 where no line ends
  }

  int sync() override {
    const std::lock_guard lock(mutex_);
    return pass_on(waiting_.size()) && to_.pubsync() == 0 ? 0 : -1;
  }

  bool pass_on(std::size_t bytes) {
    const std::string plain = plain_text(std::string_view(waiting_).substr(0, bytes));
    waiting_.erase(0, bytes);
    const auto length = static_cast<std::streamsize>(plain.size());
    return to_.sputn(plain.data(), length) == length;
  }

  std::streambuf& to_;
  std::mutex mutex_;  // the standard streams may be used by several threads
  std::string waiting_;
};

// They are used until the process ends, after all destructors.
std::ostream& raw(std::ostream& stream) { return *new std::ostream(stream.rdbuf()); }

void pass_on_plain_text(std::ostream& stream, std::ostream& raw) { stream.rdbuf(new PlainText(*raw.rdbuf())); }

void open_those_closed() {
  int file = open("/dev/null", O_RDWR);  // gets the least number that is free
  while (file >= 0 && file <= STDERR_FILENO) file = open("/dev/null", O_RDWR);
  if (file >= 0) close(file);
}

}  // namespace

std::ostream& raw_output() {
  static std::ostream& stream = raw(std::cout);
  return stream;
}

std::ostream& raw_error() {
  static std::ostream& stream = raw(std::cerr);
  return stream;
}

void prepare_standard_streams() {
  open_those_closed();
  pass_on_plain_text(std::cout, raw_output());
  pass_on_plain_text(std::cerr, raw_error());
}

void finish_output() {
  errno = 0;
  if (std::cout.flush()) return;
  throw Failure(std::string("cannot be written") + (errno != 0 ? std::string(": ") + std::strerror(errno) : ""),
                "standard output", "see where it goes");
}

}  // namespace mars::child
