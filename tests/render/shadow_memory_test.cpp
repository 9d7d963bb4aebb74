// Drawing shadows takes no more memory than is planned for it: counts the bytes that a node has allocated at most,
// beside those of the same film without shadows. What it has in large blocks is as planned by construction.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <numeric>

#include "host/render/sinks/sink_pool.h"
#include "node/firmware.h"
#include "node/shadow/shadow_plan.h"
#include "tests/counted_new.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace {

std::atomic<std::int64_t> allocated{0};  // bytes that all threads have
std::atomic<std::int64_t> most{0};

}  // namespace

void* mars::test::allocate(std::size_t size, std::size_t alignment) noexcept {
  void* block = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (block == nullptr) return nullptr;
  const std::int64_t now = allocated += static_cast<std::int64_t>(malloc_usable_size(block));
  for (std::int64_t before = most; before < now && !most.compare_exchange_weak(before, now);) continue;
  return block;
}
void mars::test::release(void* block) noexcept {
  allocated -= static_cast<std::int64_t>(malloc_usable_size(block));
  std::free(block);
}

namespace mars::test {
namespace {

// The most that was allocated at a time while a node drew the film, with `shadows` bytes for shadows.
std::int64_t most_allocated(const wire::FilmData& film, std::uint64_t shadows) {
  const FilmBlock block(film);
  farm::PlanRequest work{std::vector<std::uint32_t>(film.settings.frames)};
  std::iota(work.frames.begin(), work.frames.end(), 0u);
  const farm::Plan plan = farm::make_plan(block.view(), work, 1);
  farm::FarmOptions options;
  options.asked_memory.shadows = shadows;
  const std::int64_t before = most = allocated.load();
  const auto host = [&] {
    sinks::NullSink sink;
    sinks::SinkPool pool(sink, {film.settings.width, film.settings.height, 16, 3, 1});
    farm::render_film(block.bytes(), plan, options, pool, {});
  };
  threads::run_threads(1, host, [] { node::run_node({"test", "", {}, 1 << 30, ""}); });
  return most - before;
}

void expect_as_planned(wire::FilmData film, const char* what) {
  const shadow::ShadowNeeds needs = shadow::shadow_needs(FilmBlock(film).view());
  wire::FilmData without = film;
  for (wire::Light& light : without.lights) light.casts = 0;
  const std::int64_t others = most_allocated(without, 0);
  for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{1} << 30}) {
    const shadow::ShadowPlan plan = shadow::plan_shadows(needs, bytes);
    EXPECT_LE(most_allocated(film, bytes) - others, static_cast<std::int64_t>(plan.bytes())) << what;
  }
}

TEST(ShadowMemory, IsAsPlanned) {
  expect_as_planned(casting(with_samples(crowd(320, 200, 3, 3), 16), {0.0f}), "a far light");
  expect_as_planned(casting(richly_lit(with_samples(crowd(320, 200, 3, 3), 16)), {0.0f, 0.0f, 0.0f}), "several lights");
  expect_as_planned(casting(with_samples(crowd(320, 200, 2, 2), 4), {-1.0f, 0.0f}), "a light in the midst");
  expect_as_planned(casting(crowd(160, 100, 2, 2), {0.1f}), "a soft light");
}

}  // namespace
}  // namespace mars::test
