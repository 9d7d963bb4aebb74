// The studio's end of the stream of pictures, against hosts that this test plays.
#include "host/studio/link/host_connection.h"

#include <gtest/gtest.h>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <chrono>
#include <filesystem>
#include <optional>

#include "host/render/pictures/socket.h"

namespace mars::studio {
namespace {

using pictures::Kind;

class HostConnectionTest : public testing::Test {
 protected:
  pictures::Socket connect() {
    child::Descriptor descriptor = pictures::connect_to(connection_->path());
    EXPECT_TRUE(descriptor.open());
    return {std::move(descriptor), pictures::Peer::studio};
  }

  template <typename Holds>
  bool run_until(Holds holds) {
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(200);
    while (!holds() && std::chrono::steady_clock::now() < last) context_.run_one_for(std::chrono::milliseconds(10));
    return holds();
  }

  static pictures::Body begin(std::uint32_t frames) {
    return pictures::body_of_begin({4, 2, 2, 1, frames, 0}, std::vector<wire::Hello>(1));
  }
  static pictures::Body picture(std::uint32_t lines) {
    pictures::Picture picture{0, 0, {}, {{0, 0, 4, 2}}, std::vector<pictures::Line>(lines), {}};
    picture.head.width = 4;
    picture.head.height = 2;
    picture.pixels.resize(8, 0xff123456u);
    return body_of_picture(picture);
  }

  boost::asio::io_context context_;
  // Without it, a context that waits for another thread's work alone would stop for good.
  const boost::asio::executor_work_guard<boost::asio::io_context::executor_type> kept_{context_.get_executor()};
  int connected_ = 0, begun_ = 0, drawn_ = 0;
  std::vector<pictures::Picture> pictures_;
  std::vector<std::uint32_t> dropped_;
  std::vector<std::string> closed_;
  std::optional<HostConnection> connection_{
      std::in_place, context_,
      HostConnection::Listener{.connected = [this] { ++connected_; },
                               .begin = [this](const pictures::BeginMessage&) { ++begun_; },
                               .picture = [this](pictures::Picture each) { pictures_.push_back(std::move(each)); },
                               .dropped = [this](auto, auto each) { dropped_.push_back(each); },
                               .drawn = [this](const pictures::DrawnMessage&) { ++drawn_; },
                               .closed = [this](const std::string& reason) { closed_.push_back(reason); }}};
};

TEST_F(HostConnectionTest, HearsViewsAndARendering) {
  {
    pictures::Socket host = connect();
    host.send({Kind::begin}, begin(0));
    host.send({Kind::picture, 3, 9}, picture(0));
    host.send({Kind::dropped, 3, 10});
  }
  ASSERT_TRUE(run_until([&] { return closed_.size() == 1; }));
  EXPECT_EQ(closed_[0], "");
  ASSERT_EQ(pictures_.size(), 1u);
  EXPECT_EQ(pictures_[0].picture, 9u);
  EXPECT_EQ(dropped_, std::vector<std::uint32_t>{10});
  {
    pictures::Socket host = connect();
    host.send({Kind::begin}, begin(5));
    host.send({Kind::picture}, picture(2));
    host.send({Kind::drawn}, pictures::body_of(pictures::DrawnHead{}));
  }
  ASSERT_TRUE(run_until([&] { return closed_.size() == 2; }));
  EXPECT_EQ(connected_, 2);
  EXPECT_EQ(begun_, 2);
  EXPECT_EQ(drawn_, 1);
  EXPECT_EQ(pictures_.size(), 2u);
}

TEST_F(HostConnectionTest, AForeignHostIsClosedWithAReasonAndTheNextIsHeard) {
  pictures::Socket foreign = connect();
  foreign.send({Kind::scene, 1, 1}, begin(0));
  ASSERT_TRUE(run_until([&] { return closed_.size() == 1; }));
  EXPECT_NE(closed_[0].find("the host sends a message of no known kind"), std::string::npos) << closed_[0];
  foreign.look();
  EXPECT_FALSE(foreign.is_open());

  pictures::Socket early = connect();
  early.send({Kind::picture}, picture(2));  // of no film
  ASSERT_TRUE(run_until([&] { return closed_.size() == 2; }));
  EXPECT_NE(closed_[1].find("before it has begun"), std::string::npos) << closed_[1];
  EXPECT_TRUE(pictures_.empty());

  pictures::Socket host = connect();
  host.send({Kind::begin}, begin(5));
  EXPECT_TRUE(run_until([&] { return begun_ == 1; }));
}

TEST_F(HostConnectionTest, SendsAsTheHostTakesAndTakesBackWhatIsOld) {
  pictures::Socket host = connect();
  ASSERT_TRUE(run_until([&] { return connected_ == 1; }));
  const auto large = std::make_shared<const std::vector<std::byte>>(std::size_t{20} << 20);
  connection_->send(Kind::film, 0, 0, large);
  for (std::uint32_t picture = 1; picture <= 3; ++picture)
    connection_->send(picture == 2 ? Kind::scene : Kind::draw, 7, picture, large);
  EXPECT_EQ(connection_->take_back(7, false), (std::vector<std::uint32_t>{1, 3}));
  std::vector<Kind> kinds;
  ASSERT_TRUE(run_until([&] {
    while (const auto message = host.receive()) kinds.push_back(message->head.kind);
    return kinds.size() == 2;
  }));
  EXPECT_EQ(kinds, (std::vector<Kind>{Kind::film, Kind::scene}));
}

TEST_F(HostConnectionTest, LeavesNoNameBehind) {
  const std::filesystem::path path = connection_->path();
  EXPECT_EQ(std::filesystem::status(path.parent_path()).permissions(), std::filesystem::perms::owner_all);
  pictures::Socket host = connect();
  ASSERT_TRUE(run_until([&] { return connected_ == 1; }));
  connection_->close_to_others();
  EXPECT_FALSE(std::filesystem::exists(path.parent_path()));
  host.send({Kind::begin}, begin(0));
  EXPECT_TRUE(run_until([&] { return begun_ == 1; })) << "the host that is there stays";
  connection_.reset();
  context_.poll();
  host.look();
  EXPECT_FALSE(host.is_open());
}

}  // namespace
}  // namespace mars::studio
