// T-matrices of many actors: the same whoever computes them, dense however few there are, and refused before memory
// ends.
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <string>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/film/compile.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::film {
namespace {

constexpr int kJoints = 40;

std::string chain() {
  std::string joints = R"({"name": "j0", "segment": {"shape": "box"}})";
  for (int i = 1; i < kJoints; ++i)
    joints += R"(, {"name": "j)" + std::to_string(i) + R"(", "parent": "j)" + std::to_string(i - 1) +
              R"(", "place": [1, 0, 0], "segment": {"shape": "box"}})";
  return joints;
}

// Actors of three kinds: one turns all the time, one stands still between its keys, one never moves.
animator::Film crowd(int actors, int frames) {
  std::string list;
  for (int i = 0; i < actors; ++i) {
    const std::string angle = std::to_string(5 + i % 50), last = std::to_string(frames - 1);
    list += std::string(i ? "," : "") + R"({"name": "a)" + std::to_string(i) + R"(", "model": "m", "keys": [)" +
            R"({"frame": 0, "pose": {"j0": [0, 0, )" + angle + R"(], "j7": [0, 0, 0]}}, )" + R"({"frame": )" +
            (i % 3 == 1 ? "9" : last) + R"(, "pose": {"j0": [0, 0, )" + angle + R"(], "j7": )" +
            (i % 3 == 2 ? "[0, 0, 0]" : "[0, 0, 80]") + "}}]}";
  }
  const std::string json = R"({"frames": )" + std::to_string(frames) +
                           R"(, "camera": {"eye": [0, -9, 0]}, "models": {"m": {"joints": [)" + chain() +
                           R"(]}}, "actors": [)" + list + "]}";
  const document::Document document(json, "crowd.json");
  return animator::read_film(document.root(), ".");
}

// Runs `call` where only one processor may be used.
template <typename Call>
auto on_one_processor(Call call) {
  cpu_set_t all, one;
  sched_getaffinity(0, sizeof all, &all);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
  sched_setaffinity(0, sizeof one, &one);
  auto result = call();
  sched_setaffinity(0, sizeof all, &all);
  return result;
}

TEST(MotionWriter, SeveralThreadsWriteWhatOneDoes) {
  const animator::Film film = crowd(90, 90);
  const CompiledFilm alone = on_one_processor([&] { return compile(film); });
  const CompiledFilm together = compile(film);
  EXPECT_TRUE(std::ranges::equal(alone.block(), together.block()));
}

TEST(MotionWriter, KeepsOnlyWhatDiffersAndNoGaps) {
  constexpr int kActors = 9, kFrames = 30;
  const animator::Film film = crowd(kActors, kFrames);
  const CompiledFilm compiled = compile(film);
  const wire::PackedFilm view = compiled.view();
  // Each actor's joints at frame 0; then j7 and those it carries, in all later frames or in nine of them.
  EXPECT_EQ(view.matrices().size(), kActors * kJoints + 3u * (kJoints - 7) * (kFrames - 1 + 9));
  for (std::size_t actor = 0; actor < kActors; ++actor)
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      const animator::ActorState state = animator::state_at(film, actor, frame);
      for (std::size_t joint = 0; joint < kJoints; ++joint)
        ASSERT_EQ(*state.segments[joint], view.matrix_at(view.segments()[actor * kJoints + joint], frame))
            << actor << ' ' << joint << ' ' << frame;
    }
}

TEST(MotionWriter, RefusesBeforeMemoryEnds) {
  animator::Film film = crowd(200, 1000);
  film.frames = wire::kMostFrames;
  for (animator::Actor& actor : film.actors)
    for (auto& pose : actor.motion.pose)
      if (pose.size() > 1) pose.back().frame = film.frames - 1;
  EXPECT_TRUE(document::holds(document::failure_of([&] { compile(film); }), "moves so much that it needs "));
}

}  // namespace
}  // namespace mars::film
