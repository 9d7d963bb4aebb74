// The host's pictures are bounded: the sinks' frames, and one saved background a group where intervals have
// inbetweens. Counts the host thread's blocks of a picture's size. And a longer film needs no more memory.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "host/render/sinks/sink_pool.h"
#include "node/firmware.h"
#include "tests/counted_new.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"

namespace {

constexpr std::uint32_t kWidth = 200, kHeight = 150;
constexpr std::size_t kPicture = std::size_t{kWidth} * kHeight * sizeof(std::uint32_t);

thread_local bool is_host = false;
std::array<void*, 1000> host_pictures;  // the host's own, of which some are freed
std::size_t made = 0;
std::size_t live = 0;
std::size_t most = 0;
std::atomic<std::int64_t> allocated{0};  // bytes that all threads have

}  // namespace

void* mars::test::allocate(std::size_t size, std::size_t alignment) noexcept {
  void* block = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (block == nullptr) return nullptr;
  allocated += static_cast<std::int64_t>(malloc_usable_size(block));
  if (is_host && size == kPicture) {
    host_pictures.at(made++) = block;
    most = std::max(most, ++live);
  }
  return block;
}

void mars::test::release(void* block) noexcept {
  if (is_host && block != nullptr) {
    void** const end = host_pictures.data() + made;
    void** const found = std::find(host_pictures.data(), end, block);
    if (found != end) *found = nullptr, --live;
  }
  allocated -= static_cast<std::int64_t>(malloc_usable_size(block));
  std::free(block);
}

namespace mars::test {
namespace {

constexpr std::uint32_t kFrames = 3;  // buffers

// The most pictures the host had at a time while it rendered the film.
std::size_t most_pictures(const wire::FilmData& film, bool coherence, std::uint32_t groups) {
  const FilmBlock block(film);
  farm::PlanRequest work{std::vector<std::uint32_t>(film.settings.frames), coherence, groups};
  std::iota(work.frames.begin(), work.frames.end(), 0u);
  const farm::Plan plan = farm::make_plan(block.view(), work, 4);
  made = live = most = 0;
  const auto host = [&] {
    is_host = true;
    sinks::NullSink sink;
    {
      sinks::SinkPool pool(sink, {kWidth, kHeight, 16, kFrames, 1});
      farm::render_film(block.bytes(), plan, {}, pool, {});
    }
    is_host = false;
  };
  threads::run_threads(4, host, [] { node::run_node({"test", "", {}, 256 << 20, ""}); });
  EXPECT_EQ(live, 0u);
  return most;
}

TEST(HostMemory, OneSavedBackgroundAGroup) {
  const wire::FilmData film = crowd(kWidth, kHeight, 60, 3);
  for (const std::uint32_t groups : {1u, 2u, 4u}) {
    const std::size_t pictures = most_pictures(film, true, groups);
    EXPECT_LE(pictures, kFrames + groups);
    EXPECT_GE(pictures, 2u) << "the hook counts";
  }
}

TEST(HostMemory, NoneWhereNoIntervalHasInbetweens) {
  const wire::FilmData film = crowd(kWidth, kHeight, 20, 3);
  EXPECT_LE(most_pictures(film, false, 4), kFrames);
  EXPECT_LE(most_pictures(crowd(kWidth, kHeight, 20, 1), true, 4), kFrames);
}

TEST(HostMemory, DoesNotGrowWithTheFramesDone) {
  constexpr std::size_t kWarm = 500, kAll = 4000;
  const FilmBlock block(crowd(16, 16, kAll, 3));
  std::size_t done = 0;
  std::int64_t warm = 0;
  std::int64_t grown = 0;
  farm::FarmListener listener;
  listener.finished = [&](const farm::FinishedFrame&) {
    if (++done == kWarm) warm = allocated;
    if (done == kAll) grown = allocated - warm;
  };
  farm::PlanRequest work{std::vector<std::uint32_t>(kAll)};
  std::iota(work.frames.begin(), work.frames.end(), 0u);
  const farm::Plan plan = farm::make_plan(block.view(), work, 1);
  const auto host = [&] {
    sinks::NullSink sink;
    sinks::SinkPool pool(sink, {16, 16, 16, kFrames, 1});
    farm::render_film(block.bytes(), plan, {}, pool, listener);
  };
  threads::run_threads(1, host, [] { node::run_node({"test", "", {}, 256 << 20, ""}); });
  EXPECT_EQ(done, kAll);
  EXPECT_LT(grown, static_cast<std::int64_t>(kAll - kWarm)) << "bytes: not one a frame";
}

}  // namespace
}  // namespace mars::test
