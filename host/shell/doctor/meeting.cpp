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

namespace mars::doctor {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostAddresses = 8;  // of a machine
constexpr std::size_t kAtOnce = 50;        // machines: for fewer sockets than a process may usually open
constexpr int kMostPatience = 4;           // times the patience for a group of machines, for all of them

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

// At one address of a machine.
struct Knock {
  const Peer* peer;
  child::Descriptor socket = tcp_socket();
  int error = ETIMEDOUT;  // 0: the door was reached
};

void begin(Knock& knock, const std::string& at) {
  const sockaddr_in address = address_of(at, knock.peer->port);
  const int failed = connect(knock.socket.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  if (failed != 0 && errno == EINPROGRESS) return;
  knock.error = failed != 0 ? errno : 0;
  knock.socket.close();
}

// poll() passes over the sockets that are closed.
void wait_for(std::span<Knock> knocks, std::chrono::milliseconds patience) {
  const auto deadline = Clock::now() + patience;
  while (std::ranges::any_of(knocks, [](const Knock& each) { return each.socket.open(); })) {
    std::vector<pollfd> ready;
    for (const Knock& each : knocks) ready.push_back({each.socket.number(), POLLOUT, 0});
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 || poll(ready.data(), ready.size(), static_cast<int>(left)) <= 0) return;
    for (std::size_t i = 0; i < knocks.size(); ++i) {
      if (ready[i].revents == 0) continue;
      socklen_t size = sizeof knocks[i].error;
      getsockopt(ready[i].fd, SOL_SOCKET, SO_ERROR, &knocks[i].error, &size);
      knocks[i].socket.close();
    }
  }
}

std::string meaning_of_error(int error) {
  if (error == ETIMEDOUT) return "packets are dropped, by a firewall?";
  if (error == ECONNREFUSED) return "connections are refused, by a firewall?";
  return std::strerror(error);
}

void knock_at_some(const std::string& from, std::span<const Peer> peers, std::chrono::milliseconds patience,
                   std::vector<Missed>& missed) {
  std::vector<Knock> knocks;
  for (const Peer& peer : peers)
    for (const std::string& at : peer.addresses | std::views::take(kMostAddresses))
      begin(knocks.emplace_back(Knock{&peer}), at);
  wait_for(knocks, patience);
  for (const Peer& peer : peers) {
    const auto of_peer = [&](const Knock& each) { return each.peer == &peer; };
    const auto first = std::ranges::find_if(knocks, of_peer);
    if (std::ranges::none_of(knocks, [&](const Knock& each) { return of_peer(each) && each.error == 0; }))
      missed.push_back({from, peer.host, meaning_of_error(first == knocks.end() ? EADDRNOTAVAIL : first->error)});
  }
}

// Connections that nobody takes fill the system's queue, of 128 on some systems, and then it drops packets.
void take_all(int socket, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pollfd ready{socket, POLLIN, 0};
    if (poll(&ready, 1, -1) > 0) const child::Descriptor taken(accept4(socket, nullptr, nullptr, SOCK_CLOEXEC));
  }
}

}  // namespace

Door::Door(const std::string& address) : socket_(tcp_socket()) {
  sockaddr_in own = address_of(address, 0);
  socklen_t size = sizeof own;
  const auto pointer = reinterpret_cast<sockaddr*>(&own);
  if (bind(socket_.number(), pointer, size) != 0 || listen(socket_.number(), SOMAXCONN) != 0 ||
      getsockname(socket_.number(), pointer, &size) != 0)
    throw Failure(std::strerror(errno), "listening at " + address, "");
  port_ = ntohs(own.sin_port);
  porter_ = std::jthread([this](const std::stop_token& stop) { take_all(socket_.number(), stop); });
}

// Closed for both directions, the socket wakes the thread.
Door::~Door() {
  porter_.request_stop();
  shutdown(socket_.number(), SHUT_RDWR);
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
  return addresses.empty() ? std::vector<std::string>{"127.0.0.1"} : addresses;
}

std::vector<Missed> knock(const std::string& from, std::span<const Peer> peers, std::chrono::milliseconds patience) {
  const auto deadline = Clock::now() + kMostPatience * patience;
  std::vector<Missed> missed;
  for (std::size_t first = 0; first < peers.size() && Clock::now() < deadline; first += kAtOnce)
    knock_at_some(from, peers.subspan(first, std::min(kAtOnce, peers.size() - first)), patience, missed);
  return missed;
}

}  // namespace mars::doctor
