// A node whose frame writer has a file under its name while the node does something else, by a clock that waiting
// moves.
#include "node/file_output.h"

#include <gtest/gtest.h>

#include <array>
#include <deque>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/timed_backend.h"

namespace mars::node {
namespace {

constexpr int kRanks = 3;

class ScriptedWriter : public wire::FrameWriter {
 public:
  bool sees_folder() const override { return true; }
  std::uint32_t lines_of_band() const override { return 8; }
  std::size_t shared_bytes() const override { return 64; }
  void share(std::span<std::byte>) override {}
  void begin_keyframe(const Keyframe&) override {}
  void begin_inbetween(std::uint32_t, const wire::LineSpan&) override {}
  void paste(const wire::Strip&, std::span<const wire::Run>, std::span<const std::uint32_t>) override {}
  std::span<const std::byte> edge() override { return {}; }
  void add_edge(std::span<const std::byte>) override {}
  void finish_bands() override {}
  bool has_background() const override { return false; }
  std::span<const std::byte> next_background(std::size_t) override { return {}; }
  std::size_t most_band_bytes() const override { return 8; }
  void add_background(std::span<const std::byte>) override {}
  std::span<const std::byte> picture() override { return {}; }
  void add_picture(std::span<const std::byte>) override {}
  void write() override {}
  bool is_full() override { return false; }
  bool is_busy() override { return true; }
  bool has_written() override { return !written.empty(); }
  std::optional<wire::Written> take_written() override {
    if (written.empty()) throw Failure("the disk is full", "", "");
    const wire::Written file{written.front(), 0, {}, 0, 0};
    written.pop_front();
    return file;
  }
  std::optional<std::string> take_warning() override { return std::nullopt; }

  std::deque<std::uint32_t> written;  // frames
};

class FileOutputTest : public testing::Test {
 protected:
  std::vector<std::uint32_t> reported() const {
    std::vector<std::uint32_t> frames;
    for (const auto& message : backend.sent_messages) {
      if (message.type != wire::kWritten) continue;
      wire::Written written;
      std::memcpy(&written, message.bytes.data(), sizeof written);
      frames.push_back(written.frame);
    }
    return frames;
  }

  messages::TimedBackend backend{0, kRanks};
  messages::Process process{backend};
  Heartbeat heartbeat{NodeIdentity{"n7", "", {}, 0, "", 77, {}}};
  const raster::Neighbours neighbours{std::array<std::int32_t, kRanks>{0, 1, 2}, kRanks};
  group::Outbox outbox{wire::PixelFormat::rgb8, 1, neighbours.group()};
  ScriptedWriter writer;
  FileOutput output{writer, neighbours, outbox, heartbeat};
};

using Frames = std::vector<std::uint32_t>;

TEST_F(FileOutputTest, ReportsAFileWhileTheNodeWaitsForSomethingElse) {
  backend.meanwhile = [this, turn = 0]() mutable {
    if (++turn == 20) writer.written = {3, 7};
    if (turn == 60) backend.hand(kRanks, wire::kRender, wire::Beat{});
  };
  cprobe(wire::kRender);
  EXPECT_EQ(reported(), (Frames{3, 7}));
}

TEST_F(FileOutputTest, ReportsAFileWhileTheNodeDraws) {
  writer.written = {3};
  heartbeat.look();
  EXPECT_EQ(reported(), Frames{3});
}

// A failure goes where the node is ready for it, and after the files that are there.
TEST_F(FileOutputTest, FailsOnlyWhereItIsAskedToReport) {
  EXPECT_NO_THROW(heartbeat.look());
  writer.written = {5};
  EXPECT_THROW(output.report(), Failure);
  EXPECT_EQ(reported(), Frames{5});
}

}  // namespace
}  // namespace mars::node
