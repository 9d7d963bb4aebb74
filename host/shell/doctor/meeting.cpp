#include "host/shell/doctor/meeting.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ranges>
#include <utility>

#include "hal/failure/failure.h"
#include "host/child/environment.h"
#include "host/shell/launch/text_reader.h"

namespace mars::doctor {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostAddresses = 8;  // of a machine
constexpr std::size_t kAtOnce = 400;       // sockets: fewer than a process may usually open

sockaddr_in address_of(const std::string& text, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  inet_pton(AF_INET, text.c_str(), &address.sin_addr);
  return address;
}

child::Descriptor tcp_socket() {
  child::Descriptor made(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!made.open()) throw Failure(std::strerror(errno), "opening a socket", errno == EMFILE ? "raise ulimit -n" : "");
  return made;
}

// One of a machine's addresses.
struct Knock {
  std::size_t peer;
  child::Descriptor socket;
  int error = ETIMEDOUT;  // 0: the door was reached
};

Knock begin_knock(const Peer& peer, std::size_t number, const std::string& at) {
  Knock knock{number, tcp_socket()};
  const sockaddr_in address = address_of(at, peer.port);
  if (connect(knock.socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0)
    knock.error = 0;
  else if (errno != EINPROGRESS)
    knock.error = errno;
  if (knock.error != ETIMEDOUT) knock.socket.close();
  return knock;
}

void end_knock(Knock& knock) {
  socklen_t size = sizeof knock.error;
  getsockopt(knock.socket.number(), SOL_SOCKET, SO_ERROR, &knock.error, &size);
  knock.socket.close();
}

// poll() passes over the sockets that are closed.
void wait_for(std::span<Knock> knocks, std::chrono::milliseconds patience) {
  const auto deadline = Clock::now() + patience;
  std::vector<pollfd> ready;
  for (const Knock& each : knocks) ready.push_back({each.socket.number(), POLLOUT, 0});
  while (std::ranges::any_of(knocks, [](const Knock& each) { return each.socket.open(); })) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 || poll(ready.data(), ready.size(), static_cast<int>(left)) <= 0) return;
    for (std::size_t i = 0; i < knocks.size(); ++i) {
      if (std::exchange(ready[i].revents, 0) == 0) continue;
      end_knock(knocks[i]);
      ready[i].fd = -1;
    }
  }
}

std::string meaning_of_error(int error) {
  if (error == ETIMEDOUT) return "packets are dropped, by a firewall?";
  if (error == ECONNREFUSED) return "connections are refused, by a firewall?";
  return std::strerror(error);
}

// "10.0.0.5 41290 10.0.0.7 22": ssh names the address at which this machine was reached.
std::string reached_at() {
  const std::string connection = child::own_environment().value("SSH_CONNECTION").value_or("");
  launch::TextReader words(connection);
  std::string third;
  for (int i = 0; i < 3; ++i, words.skip_space()) third = words.word().value_or("");
  return third;
}

}  // namespace

Door::Door(const std::string& address) : socket_(tcp_socket()) {
  sockaddr_in own = address_of(address, 0);
  socklen_t size = sizeof own;
  if (bind(socket_.number(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0 ||
      listen(socket_.number(), SOMAXCONN) != 0 ||
      getsockname(socket_.number(), reinterpret_cast<sockaddr*>(&own), &size) != 0)
    throw Failure(std::strerror(errno), "listening at " + address, "");
  port_ = ntohs(own.sin_port);
}

std::vector<std::string> own_addresses() {
  std::vector<std::string> addresses;
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return {"127.0.0.1"};
  for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET) continue;
    if ((each->ifa_flags & IFF_UP) == 0 || (each->ifa_flags & IFF_LOOPBACK) != 0) continue;
    char text[INET_ADDRSTRLEN] = "";
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(each->ifa_addr)->sin_addr, text, sizeof text);
    addresses.emplace_back(text);
  }
  freeifaddrs(all);
  std::ranges::stable_partition(addresses, [at = reached_at()](const std::string& each) { return each == at; });
  if (addresses.size() > kMostAddresses) addresses.resize(kMostAddresses);
  return addresses.empty() ? std::vector<std::string>{"127.0.0.1"} : addresses;
}

std::vector<Missed> knock(std::span<const Peer> peers, std::chrono::milliseconds patience) {
  std::vector<Missed> missed;
  for (std::size_t next = 0; next < peers.size();) {
    const std::size_t begin = next;
    std::vector<Knock> knocks;
    for (; next < peers.size() && knocks.size() + kMostAddresses <= kAtOnce; ++next)
      for (const std::string& at : peers[next].addresses | std::views::take(kMostAddresses))
        knocks.push_back(begin_knock(peers[next], next, at));
    wait_for(knocks, patience);
    for (std::size_t peer = begin; peer < next; ++peer) {
      const auto of_peer = [&](const Knock& each) { return each.peer == peer; };
      if (std::ranges::any_of(knocks, [&](const Knock& each) { return of_peer(each) && each.error == 0; })) continue;
      const auto first_try = std::ranges::find_if(knocks, of_peer);
      missed.push_back(
          {peers[peer].host, meaning_of_error(first_try == knocks.end() ? EADDRNOTAVAIL : first_try->error)});
    }
  }
  return missed;
}

}  // namespace mars::doctor
