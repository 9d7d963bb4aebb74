// Bands of inbetweens between the nodes of a team that get ahead of each other, and that stop at different frames.
#include "node/group/team_bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "hal/threads/run_threads.h"
#include "node/wire/protocol.h"

namespace mars::group {
namespace {

constexpr collectives::Group kTeam{0, 3};

std::vector<std::byte> bands_of(std::uint32_t frame, int node, std::size_t bytes) {
  return std::vector<std::byte>(bytes, static_cast<std::byte>(16 * node + static_cast<int>(frame)));
}

// Each node's part; the host stops all of them once it has heard of all.
void run_team(const std::function<void(TeamBands&, Outbox&)>& part) {
  threads::run_threads(
      kTeam.count,
      [] {
        for (int node = 0; node < kTeam.count; ++node) {
          crecv(wire::kLoaded, nullptr, 0);
        }
        for (int node = 0; node < kTeam.count; ++node) csend(wire::kStop, nullptr, 0, node, 0);
      },
      [&] {
        TeamBands bands(kTeam);
        Outbox outbox(wire::PixelFormat::rgb8, 1, kTeam);
        bands.join(kTeam);
        part(bands, outbox);
        bands.finish();
        crecv(wire::kStop, nullptr, 0);
      });
}

void report_to_host() { csend(wire::kLoaded, nullptr, 0, myhost(), 0); }

TEST(TeamBands, ComeToTheWriterInTheOrderOfFramesWhoeverIsAhead) {
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{100}, std::size_t{300'000}})
    run_team([&](TeamBands& bands, Outbox& outbox) {
      const int self = static_cast<int>(mynode());
      for (std::uint32_t frame = 0; frame < 9; ++frame) {
        const int writer = static_cast<int>(frame % 3);
        if (writer != self) {
          bands.send(frame, bands_of(frame, self, bytes), writer);
          continue;
        }
        for (int node = 0; node < 3; ++node) {
          if (node == self) continue;
          const auto came = bands.receive(frame, node, outbox);
          ASSERT_TRUE(came.has_value());
          EXPECT_TRUE(std::ranges::equal(*came, bands_of(frame, node, bytes)));
        }
      }
      report_to_host();
    });
}

// Node 0 stops before it has received what others have sent; node 2 waits for what node 0 never sends.
TEST(TeamBands, NoNodeWaitsForOneThatHasStopped) {
  run_team([&](TeamBands& bands, Outbox& outbox) {
    switch (mynode()) {
      case 0: report_to_host(); break;
      case 1:
        bands.send(0, bands_of(0, 1, 200'000), 0);
        bands.send(1, bands_of(1, 1, 200'000), 2);
        report_to_host();
        break;
      case 2:
        EXPECT_TRUE(bands.receive(1, 1, outbox).has_value());
        report_to_host();
        EXPECT_FALSE(bands.receive(1, 0, outbox).has_value());
        break;
    }
  });
}

TEST(TeamBands, OfAnotherFrameMakeNoSense) {
  bool refused = false;
  run_team([&](TeamBands& bands, Outbox& outbox) {
    if (mynode() == 1) bands.send(4, bands_of(4, 1, 10), 0);
    if (mynode() == 0) {
      try {
        bands.receive(5, 1, outbox);
      } catch (const Failure&) {
        refused = true;
      }
    }
    report_to_host();
  });
  EXPECT_TRUE(refused);
}

}  // namespace
}  // namespace mars::group
