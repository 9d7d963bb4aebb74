#include "host/shell/doctor/round.h"

#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <functional>
#include <list>
#include <utility>

#include "host/child/descriptor.h"
#include "host/child/process.h"

namespace mars::doctor {
namespace {

constexpr std::size_t kLongestAnswer = 1 << 22;  // bytes of a line
constexpr std::size_t kLastWords = 4096;         // bytes that are kept of what is no answer
constexpr std::chrono::milliseconds kEnding{2000};
constexpr timeval kSending{5, 0};

class Session {
 public:
  explicit Session(const Call& call) : Session(call, child::make_socket_pair()) {}

  bool open() const { return stream_.open(); }
  int number() const { return stream_.number(); }
  const std::vector<std::string>& hosts() const { return hosts_; }
  const std::string& words() const { return words_; }

  void read(Answers& answers) {
    std::array<char, 65536> bytes;
    const ssize_t count = ::read(stream_.number(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) return;
    const auto now = std::chrono::system_clock::now();
    rest_.append(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    for (std::size_t end; (end = rest_.find('\n')) != std::string::npos; rest_.erase(0, end + 1))
      take(rest_.substr(0, end), answers, now);
    if (count > 0 && rest_.size() < kLongestAnswer) return;
    take(rest_, answers, now);
    stream_.close();
  }

  void send(const std::string& line) {
    if (!open()) return;
    const ssize_t sent = ::send(stream_.number(), line.data(), line.size(), MSG_NOSIGNAL);
    if (sent < static_cast<ssize_t>(line.size())) stream_.close();
  }

  void say_nothing_more() const { shutdown(stream_.number(), SHUT_WR); }

 private:
  Session(const Call& call, child::SocketPair ends)
      : hosts_(call.hosts),
        stream_(std::move(ends.ours)),
        process_(call.command,
                 {.streams = {{0, ends.theirs.number()}, {1, ends.theirs.number()}, {2, ends.theirs.number()}},
                  .signal_at_our_end = SIGTERM,
                  .default_signals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE}}) {
    setsockopt(stream_.number(), SOL_SOCKET, SO_SNDTIMEO, &kSending, sizeof kSending);
  }

  void take(const std::string& line, Answers& answers, SystemTime now) {
    if (line.empty() || answers.take(line, now)) return;
    words_ += line + "\n";
    if (words_.size() > kLastWords) words_.erase(0, words_.size() - kLastWords);
  }

  std::vector<std::string> hosts_;
  child::Descriptor stream_;
  child::Process process_;
  std::string rest_;   // the beginning of a line
  std::string words_;  // lines that are no answers
};

// Reads answers until all sessions have said all, or the time is over.
void hear(std::list<Session>& sessions, Answers& answers, std::chrono::milliseconds longest,
          const std::function<bool(const Session&)>& has_said_all) {
  const auto deadline = std::chrono::steady_clock::now() + longest;
  while (!std::ranges::all_of(sessions, [&](const Session& each) { return !each.open() || has_said_all(each); })) {
    std::vector<pollfd> ready;  // poll() passes over those that are closed
    for (const Session& each : sessions) ready.push_back({each.number(), POLLIN, 0});
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
    if (left <= 0 || poll(ready.data(), ready.size(), static_cast<int>(left)) == 0) return;
    auto next = ready.begin();
    for (Session& each : sessions)
      if ((next++)->revents != 0) each.read(answers);
  }
}

}  // namespace

Round go_round(const std::vector<Call>& calls, const std::string& self, const RoundLimits& limits) {
  Round round;
  Answers& answers = round.answers;
  std::list<Session> sessions(calls.begin(), calls.end());
  hear(sessions, answers, limits.answer, [&](const Session& each) {
    return std::ranges::all_of(each.hosts(), [&](const std::string& host) { return answers.has_door(host); });
  });
  answers.given = std::chrono::system_clock::now();
  for (Session& each : sessions) each.send(doors_line(answers.doors));
  hear(sessions, answers, limits.meeting, [&](const Session& each) {
    return std::ranges::all_of(
        each.hosts(), [&](const std::string& host) { return !answers.has_door(host) || answers.met.contains(host); });
  });
  for (const Session& each : sessions) each.say_nothing_more();
  for (const Session& each : sessions) {
    std::vector<std::string> silent, unmet;
    for (const std::string& host : each.hosts())
      if (!answers.met.contains(host)) (answers.has_door(host) ? unmet : silent).push_back(host);
    if (!silent.empty()) round.silences.push_back(check_silence(silent, each.words(), self));
    if (!unmet.empty()) round.silences.push_back(check_half_answer(unmet, each.words()));
  }
  hear(sessions, answers, kEnding, [](const Session&) { return false; });
  return round;
}

}  // namespace mars::doctor
