// Promise 5: once a film is loaded and warm, a node allocates nothing, its backend's own memory aside. Counts
// every operator new of a node's thread, at each strip it sends. Buffers for messages that came before they
// were waited for are kept for the next; how many there are at most is a matter of timing, so a few may be made
// late. One allocation a frame, or a tenth of one, is found.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <vector>

#include "tests/counted_new.h"
#include "tests/hal/counting_backend.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace {

thread_local long allocations = 0;

}  // namespace

void* mars::test::allocate(std::size_t size, std::size_t alignment) noexcept {
  ++allocations;
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
void mars::test::release(void* block) noexcept { std::free(block); }

namespace mars::test {
namespace {

// Notes at each strip how many allocations its rank's thread had made by then outside the backend.
class AllocationLog : public messages::CountingBackend {
 public:
  AllocationLog(messages::Backend& inner, messages::Counts& counts, std::vector<long>& log)
      : messages::CountingBackend(inner, counts), inner_(inner), log_(log) {}

  void send(int to, int type, const void* data, std::size_t length) override {
    aside([&] { inner_.send(to, type, data, length); });
  }
  messages::Ticket start_send(int to, int type, const void* data, std::size_t length) override {
    if (type == wire::kStrip) log_.push_back(allocations);
    messages::Ticket ticket{};
    aside([&] { ticket = inner_.start_send(to, type, data, length); });
    return ticket;
  }
  void take(void* buffer) override {
    aside([&] { inner_.take(buffer); });
  }

 private:
  template <typename Call>
  void aside(const Call& call) {
    const long before = allocations;
    call();
    allocations = before;
  }

  messages::Backend& inner_;
  std::vector<long>& log_;
};

void expect_none_in_steady_state(const wire::FilmData& film, trace::Trace* trace,
                                 wire::PixelFormat format = wire::PixelFormat::rgb8) {
  constexpr int kNodes = 3;
  const FilmBlock block(film);
  std::vector<std::vector<long>> logs(kNodes + 1);
  for (auto& log : logs) log.reserve(10'000);
  messages::Counts counts;
  RunOptions options;
  options.nodes = kNodes;
  options.work.groups = 1;
  options.farm.trace = trace;
  options.format = format;
  options.wrap = [&](messages::Backend& inner) {
    return std::make_unique<AllocationLog>(inner, counts, logs[static_cast<std::size_t>(inner.rank())]);
  };
  run_film(block.bytes(), options);
  for (int node = 0; node < kNodes; ++node) {
    const auto& log = logs[static_cast<std::size_t>(node)];
    ASSERT_GT(log.size(), 200u);
    EXPECT_GT(log.front(), 0) << "the hook counts";
    const long late = log.back() - log[log.size() / 2];
    EXPECT_LT(late, static_cast<long>(log.size() / 20)) << "node " << node << " allocated in steady state";
  }
}

TEST(Allocation, NoneInSteadyState) { expect_none_in_steady_state(crowd(64, 36, 600, 3), nullptr); }

TEST(Allocation, NoneWithSamplesInLinearLight) {
  expect_none_in_steady_state(richly_lit(with_samples(crowd(64, 36, 600, 3), 4)), nullptr);
}

TEST(Allocation, NoneWithLayers) {
  const auto layered = [](std::uint32_t samples) {
    return wire::with_layers(wire::PixelFormat::half, wire::kAllLayers, samples);
  };
  expect_none_in_steady_state(crowd(64, 36, 600, 3), nullptr, layered(1));
  expect_none_in_steady_state(with_samples(crowd(64, 36, 600, 3), 4), nullptr, layered(4));
}

TEST(Allocation, NoneWithSkins) {
  for (const wire::Blend blend : {wire::Blend::linear, wire::Blend::dual_quaternions}) {
    const wire::FilmData film = bending(64, 36, 396, 3, blend);  // whole intervals: all are shared alike
    expect_none_in_steady_state(film, nullptr);
    expect_none_in_steady_state(film, nullptr, wire::with_layers(wire::PixelFormat::half, wire::kAllLayers, 1));
  }
}

// Far lights, and lights in the midst of the scene, which have six views; with and without a size.
TEST(Allocation, NoneWithShadows) {
  expect_none_in_steady_state(casting(crowd(64, 36, 400, 3), {0.0f}), nullptr);
  expect_none_in_steady_state(casting(richly_lit(with_samples(crowd(64, 36, 400, 3), 4)), {0.0f, 0.0f, 0.0f}), nullptr);
  expect_none_in_steady_state(casting(crowd(64, 36, 400, 2), {0.1f, 0.1f}), nullptr);
  expect_none_in_steady_state(casting(crowd(64, 36, 400, 3), {-1.0f, 0.0f}), nullptr,
                              wire::with_layers(wire::PixelFormat::half, wire::kAllLayers, 1));
}

TEST(Allocation, NoneWhereTheRunIsTraced) {
  trace::Trace trace;
  expect_none_in_steady_state(crowd(64, 36, 600, 3), &trace);
  EXPECT_GT(trace.records().size(), 10'000u);
}

}  // namespace
}  // namespace mars::test
