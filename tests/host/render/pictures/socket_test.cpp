#include "host/render/pictures/socket.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace mars::pictures {
namespace {

// A host's end, and the studio's as plain bytes.
class SocketTest : public testing::Test {
 protected:
  explicit SocketTest(Peer peer = Peer::studio) {
    std::array<int, 2> ends{};
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
    other_ = child::Descriptor(ends[0]);
    socket_.emplace(child::Descriptor(ends[1]), peer);
  }

  void write(std::span<const std::byte> bytes) {
    ASSERT_EQ(::send(other_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  // What the peer takes of what it was sent.
  std::size_t take(std::size_t most) {
    std::vector<std::byte> bytes(most);
    const ssize_t count = recv(other_.number(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    return count < 0 ? 0 : static_cast<std::size_t>(count);
  }

  child::Descriptor other_;
  std::optional<Socket> socket_;
};

TEST_F(SocketTest, MessagesComeWholeHoweverTheirBytesCome) {
  const std::vector<std::byte> bytes = joined(Head{Kind::scene, 3, 1, 0, 5}, std::vector<std::byte>(5, std::byte{9}));
  for (const std::byte& byte : bytes) {
    EXPECT_FALSE(socket_->receive());
    write(std::span(&byte, 1));
  }
  const std::optional<Message> message = socket_->receive();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->head.view, 3u);
  EXPECT_EQ(message->body, std::vector<std::byte>(5, std::byte{9}));
  EXPECT_FALSE(socket_->receive());
  EXPECT_TRUE(socket_->is_open());
  other_.close();
  EXPECT_FALSE(socket_->receive());
  EXPECT_FALSE(socket_->is_open());
}

// A tebibyte is promised: memory is made for what comes.
TEST_F(SocketTest, PromisesTakeNoMemory) {
  write(joined(Head{Kind::film, 0, 0, 0, std::uint64_t{1} << 40}, std::vector<std::byte>(100)));
  EXPECT_FALSE(socket_->receive());
  EXPECT_TRUE(socket_->is_open());
}

TEST_F(SocketTest, ForeignBytesAreRefused) {
  write(joined(std::array<char, 40>{"GET / HTTP/1.1"}));
  EXPECT_THROW(socket_->receive(), Malformed);
}

TEST_F(SocketTest, SendingNeverWaits) {
  const Body body = body_of(std::vector<std::byte>(std::size_t{1} << 20));
  for (std::uint32_t picture = 1; picture <= 100; ++picture) socket_->send({Kind::dropped, 0, picture}, body);
  EXPECT_FALSE(socket_->flushed());
  write(joined(Head{Kind::close}));
  EXPECT_FALSE(socket_->receive()) << "who takes nothing is not heard";
  std::size_t taken = 0;
  while (const std::size_t count = take(std::size_t{1} << 20)) {
    taken += count;
    socket_->flush();
  }
  EXPECT_EQ(taken, 100 * (sizeof(Head) + body->size()));
  EXPECT_TRUE(socket_->flushed());
  EXPECT_TRUE(socket_->receive());
}

TEST_F(SocketTest, WhatHasNotBegunIsTakenBack) {
  const Body body = body_of(std::vector<std::byte>(std::size_t{40} << 20));
  socket_->send({Kind::draw, 0, 1}, body);
  socket_->send({Kind::draw, 0, 2}, body);
  socket_->send({Kind::scene, 0, 3}, body);
  socket_->take_back([](const Head& head) { return head.kind == Kind::draw; });
  std::size_t taken = 0;
  while (const std::size_t count = take(std::size_t{1} << 20)) {
    taken += count;
    socket_->flush();
  }
  EXPECT_EQ(taken, 2 * (sizeof(Head) + body->size())) << "the first was under way";
}

TEST_F(SocketTest, AWatcherThatTakesNothingIsGivenUp) {
  socket_->send({Kind::picture}, body_of(std::vector<std::byte>(std::size_t{64} << 20)));
  int asked = 0;
  socket_->drain([&] { return ++asked == 2; });
  EXPECT_EQ(asked, 2);
  EXPECT_FALSE(socket_->is_open());
}

TEST_F(SocketTest, AWatcherThatIsGoneIsNoticed) {
  socket_->look();
  EXPECT_TRUE(socket_->is_open());
  other_.close();
  socket_->look();
  EXPECT_FALSE(socket_->is_open());
}

TEST(Names, AreOfSockets) {
  EXPECT_THROW(connect_to(std::string(108, 's')), Failure);
  EXPECT_FALSE(connect_to("/nowhere/at-all").open());
  EXPECT_EQ(errno, ENOENT);
}

}  // namespace
}  // namespace mars::pictures
