// The number of messages of the crystal router and of direct sending: exactly, at every number of nodes.
#include <bit>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hal/collectives/crystal_router.h"
#include "hal/nx/nx_messages.h"
#include "tests/hal/counting_backend.h"

namespace mars::collectives {
namespace {

// Every node has a few bytes for two others.
void exchange_few(Route route) {
  const auto nodes = static_cast<int>(numnodes()), me = static_cast<int>(mynode());
  const std::string text = "from " + std::to_string(me);
  const std::span bytes(reinterpret_cast<const std::byte*>(text.data()), text.size());
  const std::vector<Parcel> parcels = {{(me + 1) % nodes, bytes}, {(me * 3 + 2) % nodes, bytes}};
  CrystalRouter router;
  router.exchange({0, nodes}, parcels, route);
}

class Routes : public testing::TestWithParam<int> {};

TEST_P(Routes, CrystalSendsOneMessageADimension) {
  const int nodes = GetParam();
  const auto corners = static_cast<int>(std::bit_floor(static_cast<unsigned>(nodes)));
  const auto dimensions = static_cast<unsigned>(std::countr_zero(static_cast<unsigned>(corners)));
  messages::Counts counts;
  threads::run_threads(
      nodes, [] {}, [] { exchange_few(Route::crystal); }, messages::counting(counts));
  for (int node = 0; node < nodes; ++node) {
    const bool folded = node >= corners, folds = node + corners < nodes;
    EXPECT_EQ(counts.sent({.from = node}).messages, folded ? 1u : dimensions + (folds ? 1 : 0)) << node;
  }
}

TEST_P(Routes, DirectSendsOneMessageANode) {
  const int nodes = GetParam();
  messages::Counts counts;
  threads::run_threads(
      nodes, [] {}, [] { exchange_few(Route::direct); }, messages::counting(counts));
  for (int node = 0; node < nodes; ++node)
    EXPECT_EQ(counts.sent({.from = node}).messages, static_cast<unsigned>(nodes - 1)) << node;
}

INSTANTIATE_TEST_SUITE_P(Nodes, Routes, testing::Values(1, 2, 3, 4, 5, 7, 8, 13, 16, 32, 64));

// To agree on the route is one more exchange.
TEST(RouteChoice, CostsOneMessageADimension) {
  messages::Counts counts;
  threads::run_threads(
      64, [] {}, [] { exchange_few(Route::automatic); }, messages::counting(counts));
  EXPECT_EQ(counts.sent({}).messages, 64u * (6 + 6));
}

TEST(RouteChoice, GoesByNodesAndBytes) {
  EXPECT_EQ(route_for(2, 100), Route::direct);
  EXPECT_EQ(route_for(64, 100), Route::crystal);
  EXPECT_EQ(route_for(64, 100'000'000), Route::direct);
}

}  // namespace
}  // namespace mars::collectives
