#include "host/shell/launch/prepared_text.h"

#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "hal/failure/explain.h"

namespace mars::launch {
namespace {

// 0: there was none to answer to.
int look_for(const std::function<std::string()>& find, const child::Descriptor& asked) {
  char word = 0;
  if (read(asked.number(), &word, 1) != 1) return 0;
  std::string text;
  try {
    text = find();
  } catch (const std::exception& failure) {
    text = "\n" + reason_of(failure);
  }
  return child::write_all(asked, text) ? 0 : 1;
}

}  // namespace

PreparedText::PreparedText(const std::function<std::string()>& find) : PreparedText(find, child::make_socket_pair()) {}

// The copy has our end, too: it would never hear that we have closed it.
PreparedText::PreparedText(const std::function<std::string()>& find, child::SocketPair ends)
    : stream_(std::move(ends.ours)),
      process_(
          [&] {
            stream_.close();
            return look_for(find, ends.theirs);
          },
          {.signal_at_our_end = SIGKILL, .default_signals = {SIGINT, SIGTERM, SIGHUP}}) {}

void PreparedText::begin() { send(stream_.number(), "?", 1, MSG_NOSIGNAL); }

std::optional<std::string> PreparedText::take() {
  pollfd ready{stream_.number(), POLLIN, 0};
  while (stream_.open() && poll(&ready, 1, 0) > 0) {
    std::array<char, 4096> bytes;
    const ssize_t count = read(stream_.number(), bytes.data(), bytes.size());
    if (count > 0) {
      text_.append(bytes.data(), static_cast<std::size_t>(count));
      continue;
    }
    stream_.close();
    if (!text_.empty()) return std::exchange(text_, "");
  }
  return std::nullopt;
}

}  // namespace mars::launch
