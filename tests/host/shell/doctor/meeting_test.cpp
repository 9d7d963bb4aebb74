#include "host/shell/doctor/meeting.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <list>

namespace mars::doctor {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLong{60000};  // for what answers at once
constexpr milliseconds kShort{300};   // for what never answers

// A socket that listens and takes no more connections: packets to it have no answer, as behind a firewall that drops.
class FullDoor {
 public:
  FullDoor() : listening_(new_socket()) {
    address_.sin_family = AF_INET;
    inet_pton(AF_INET, "127.0.0.4", &address_.sin_addr);
    socklen_t size = sizeof address_;
    bind(listening_.number(), reinterpret_cast<sockaddr*>(&address_), size);
    listen(listening_.number(), 0);
    getsockname(listening_.number(), reinterpret_cast<sockaddr*>(&address_), &size);
    while (visitors_.size() < 8) {
      visitors_.push_back(new_socket());
      connect(visitors_.back().number(), reinterpret_cast<sockaddr*>(&address_), size);
    }
  }

  std::uint16_t port() const { return ntohs(address_.sin_port); }

 private:
  static child::Descriptor new_socket() {
    return child::Descriptor(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  }

  child::Descriptor listening_;
  std::list<child::Descriptor> visitors_;
  sockaddr_in address_{};
};

std::uint16_t closed_port() { return Door("127.0.0.2").port(); }

TEST(Knock, ReachesOpenDoorsAndSaysWhatHappenedAtOthers) {
  const Door second("127.0.0.2"), third("127.0.0.3"), anywhere;
  const std::vector<Peer> peers{{"n2", second.port(), {"127.0.0.2"}},
                                {"n3", third.port(), {"127.0.0.3"}},
                                {"n4", closed_port(), {"127.0.0.2"}},
                                {"n5", anywhere.port(), own_addresses()},
                                {"n6", 1, {}}};
  EXPECT_EQ(knock("n1", peers, kLong), (std::vector<Missed>{{"n1", "n4", "connections are refused, by a firewall?"},
                                                            {"n1", "n6", "Cannot assign requested address"}}));
}

TEST(Knock, PacketsWithoutAnAnswerAreDropped) {
  const FullDoor full;
  const Door open("127.0.0.2");
  const std::vector<Peer> peers{{"n2", open.port(), {"127.0.0.2"}}, {"n4", full.port(), {"127.0.0.4"}}};
  EXPECT_EQ(knock("n1", peers, kShort), (std::vector<Missed>{{"n1", "n4", "packets are dropped, by a firewall?"}}));
}

TEST(Knock, AnyAddressOfAMachineWillDo) {
  const Door open("127.0.0.3");
  EXPECT_TRUE(knock("n1", std::vector<Peer>{{"n3", open.port(), {"127.0.0.2", "127.0.0.3"}}}, kLong).empty());
}

// More of them than the system keeps connections that nobody takes.
TEST(Knock, ManyMachinesAreTriedInTurn) {
  const Door open("127.0.0.2");
  const std::vector<Peer> peers(5000, {"n2", open.port(), {"127.0.0.2"}});
  EXPECT_TRUE(knock("n1", peers, kLong).empty());
}

TEST(Knock, HasAnEndWhereAllPacketsAreDropped) {
  const FullDoor full;
  const std::vector<Peer> peers(10000, {"n4", full.port(), {"127.0.0.4"}});
  EXPECT_LT(knock("n1", peers, milliseconds(1)).size(), peers.size());
}

}  // namespace
}  // namespace mars::doctor
