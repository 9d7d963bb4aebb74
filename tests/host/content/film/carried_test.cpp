// Actors that others carry, and a camera that goes along with them.
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/animator/pose/camera_points.h"
#include "host/content/animator/pose/check.h"
#include "host/content/animator/pose/joint_frames.h"
#include "host/content/film/film_writer.h"
#include "host/content/film/moment.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/film/small_film.h"

namespace mars::film {
namespace {

// The ball stands alone, hangs on tom's joint b from frame 5 on, on hat's own frame from 12 on, and stands alone again;
// tom walks until frame 9 and stands then; the hat is carried by tom all the time.
const char* const kActors = R"(
{"name": "ball", "model": "arm", "keys": [
  {"frame": 0, "place": [4, 1, 0], "attach": null},
  {"frame": 5, "attach": {"actor": "tom", "joint": "b", "place": [0.1, 0.2, 0.3], "turn": [10, 20, 30]}},
  {"frame": 12, "attach": {"actor": "hat", "place": [0, 0, 1]}},
  {"frame": 16, "attach": null}]},
{"name": "tom", "model": "arm", "keys": [
  {"frame": 2, "place": [0, 0, 0], "turn": [0, 0, 0], "pose": {"a": [0, 0, 0], "b": [0, 0, 0]}},
  {"frame": 9, "place": [2, 1, 0], "turn": [0, 0, 70], "pose": {"a": [20, 0, 50], "b": [0, 300, 0]}}]},
{"name": "hat", "model": "arm", "attach": {"actor": "tom", "joint": "a", "place": [0, 0, 2]}})";

constexpr std::size_t kBall = 0, kTom = 1, kHat = 2;

animator::Film carried_film(const std::string& camera = R"({"eye": [0, -9, 2]})") {
  std::string json = arm_film(kActors);
  const std::string plain = R"({"eye": [0, -9, 2]})";
  return film_of(json.replace(json.find(plain), plain.size(), camera));
}

// The carrier's joint frame times the offset, from the figure as it is drawn.
modeler::Axes carried(const animator::ActorState& by, std::size_t joint, const glm::dvec3& place,
                      const glm::dvec3& turn) {
  const modeler::Axes& frame = by.joints[joint];
  return {frame.turn * modeler::orientation(animator::free_joint(), turn), frame.turn * place + frame.place};
}

void expect_root(const animator::ActorState& state, const modeler::Axes& root, std::uint32_t frame) {
  EXPECT_EQ(state.root.turn, root.turn) << frame;
  EXPECT_EQ(state.root.place, root.place) << frame;
}

TEST(Carried, StandWhereTheJointFrameTimesTheOffsetSays) {
  const animator::Film film = carried_film();
  for (std::uint32_t frame = 0; frame < film.frames; ++frame) {
    const auto ball = animator::state_at(film, kBall, frame), tom = animator::state_at(film, kTom, frame),
               hat = animator::state_at(film, kHat, frame);
    expect_root(hat, carried(tom, 0, {0, 0, 2}, {0, 0, 0}), frame);
    if (frame < 5 || frame >= 16)
      expect_root(ball, {glm::dmat3(1), {4, 1, 0}}, frame);
    else if (frame < 12)
      expect_root(ball, carried(tom, 1, {0.1, 0.2, 0.3}, {10, 20, 30}), frame);
    else
      expect_root(ball, {hat.root.turn, hat.root.turn * glm::dvec3(0, 0, 1) + hat.root.place}, frame);
  }
}

TEST(Carried, AreCompiledAsTheyStandAtEachFrame) {
  const animator::Film film = carried_film();
  const CompiledFilm compiled = compile(film);
  const wire::PackedFilm view = compiled.view();
  const FilmShapes shapes = shapes_of(film);
  for (std::uint32_t frame = 0; frame < film.frames; ++frame) {
    const wire::FilmData moment = moment_of(film, shapes.numbers, frame);
    for (std::size_t segment = 0; segment < view.segments().size(); ++segment) {
      const auto state = animator::state_at(film, segment / 2, frame);
      const wire::Matrix& matrix = view.matrix_at(view.segments()[segment], frame);
      EXPECT_EQ(matrix, *state.segments[segment % 2]) << segment << ' ' << frame;
      EXPECT_EQ(matrix, moment.matrices[segment]) << segment << ' ' << frame;
    }
  }
}

// A film with `balls` balls that are carried; several threads write a film of many balls.
std::string swarm(int balls) {
  std::string list = kActors;
  for (int i = 0; i < balls; ++i)
    list += R"(,{"name": "b)" + std::to_string(i) + R"(", "model": "arm", "keys": [{"frame": )" +
            std::to_string(i % 19) + R"(, "attach": {"actor": ")" + (i % 7 == 0 ? "tom" : "b" + std::to_string(i - 1)) +
            R"(", "joint": "b", "place": [0, 0, 1]}}]})";
  return arm_film(list, R"("frames": 60)");
}

TEST(Carried, AreTheSameFromAnyNumberOfThreads) {
  const animator::Film film = film_of(swarm(1500));
  cpu_set_t all, one;
  sched_getaffinity(0, sizeof all, &all);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
  sched_setaffinity(0, sizeof one, &one);
  const CompiledFilm alone = compile(film);
  sched_setaffinity(0, sizeof all, &all);
  EXPECT_TRUE(std::ranges::equal(alone.block(), compile(film).block()));
}

TEST(Carried, StandStillWhileTheirCarriersDo) {
  const CompiledFilm compiled = compile(carried_film());
  const wire::PackedFilm view = compiled.view();
  const auto changes_after = [&](std::size_t segment, std::uint32_t first, std::uint32_t last) {
    const wire::Track& track = view.segments()[segment].motion;
    int changes = 0;
    for (std::uint32_t i = 0; i < track.count; ++i) {
      const std::uint32_t frame = view.changes()[track.first + i].frame;
      changes += frame > first && frame <= last;
    }
    return changes;
  };
  EXPECT_EQ(changes_after(2 * kBall, 0, 4), 0);
  EXPECT_EQ(changes_after(2 * kBall, 4, 9), 5);    // at 5 it is attached, then it goes with tom
  EXPECT_EQ(changes_after(2 * kBall, 9, 11), 0);   // tom stands
  EXPECT_EQ(changes_after(2 * kBall, 11, 19), 2);  // to the hat, and away
  EXPECT_EQ(changes_after(2 * kHat, 2, 9), 7);
  EXPECT_EQ(changes_after(2 * kHat, 9, 19), 0);
  // From frame 12 to 15 and from 16 on nothing moves.
  EXPECT_EQ(view.intervals().back().first_frame, 16u);
  EXPECT_EQ(view.intervals().back().moving_count, 0u);
}

TEST(Carried, KeysOfAttachCutIntervals) {
  const CompileOptions at_keys{.cutting = animator::Cutting::keyframes};
  const CompiledFilm compiled = compile(carried_film(), at_keys);
  std::vector<std::uint32_t> starts;
  for (const wire::Interval& interval : compiled.view().intervals()) starts.push_back(interval.first_frame);
  EXPECT_EQ(starts, (std::vector<std::uint32_t>{0, 2, 5, 9, 12, 16}));
}

std::string refusal(const std::string& first, const std::string& second, const std::string& more = "") {
  const auto actor = [](const char* name, const std::string& keys) {
    return std::string("\n{\"name\": \"") + name + "\", \"model\": \"arm\"" + (keys.empty() ? "" : ", " + keys) + "}";
  };
  return document::failure_of([&] { film_of(arm_film(actor("one", first) + "," + actor("two", second) + more)); });
}

TEST(Carried, WhatCannotBeIsRefusedAtItsLine) {
  const auto attach = [](const std::string& what) { return "\"attach\": {" + what + "}"; };
  const auto at = [&](int frame, const std::string& what) {
    return "{\"frame\": " + std::to_string(frame) + ", \"attach\": " + what + "}";
  };
  using document::holds;
  EXPECT_TRUE(holds(refusal(attach(R"("actor": "twoo")"), ""),
                    "f.json:9: actors[0].attach.actor: is 'twoo', which is "
                    "no actor of the film (did you mean 'two'?)"));
  EXPECT_TRUE(holds(refusal("", attach(R"("actor": "one", "joint": "c")")),
                    "f.json:10: actors[1].attach.joint: is 'c', which is no joint of 'one'"));
  EXPECT_TRUE(holds(refusal(attach(R"("actor": "two")"), attach(R"("actor": "one")")),
                    "f.json:9: actors[0].attach: goes round in a circle: 'one' is carried by 'two', 'two' by 'one'"));
  EXPECT_TRUE(holds(refusal(attach(R"("actor": "one")"), ""), "'one' is carried by 'one'"));
  const std::string matrices =
      R"(, {"name": "three", "model": "arm", "matrices": [{"frame": 0, "segments": {
         "a": [[1,0,0,0],[0,1,0,0],[0,0,1,0]], "b": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]}}]})";
  EXPECT_TRUE(holds(refusal(attach(R"("actor": "three")"), "", matrices), "is 'three', which is moved by matrices"));
  EXPECT_TRUE(holds(refusal(attach(R"("actor": "two")") + ", \"keys\": [" + at(3, "null") + "]", ""),
                    "actors[0].attach: is also set by keys"));
  // One carries the other, and later the other way round.
  EXPECT_EQ(refusal("\"keys\": [" + at(0, R"({"actor": "two"})") + "," + at(5, "null") + "]",
                    "\"keys\": [" + at(5, R"({"actor": "one"})") + "," + at(9, "null") + "]"),
            "");
}

TEST(Carried, OneCarriesTheOtherAndLaterTheOtherWayRound) {
  const animator::Film film = film_of(arm_film(
      R"({"name": "one", "model": "arm", "keys": [{"frame": 0, "attach": {"actor": "two", "joint": "b"}},
          {"frame": 6, "place": [0, 0, 0], "attach": null}, {"frame": 12, "place": [3, 0, 0]}]},
         {"name": "two", "model": "arm", "keys": [{"frame": 2, "pose": {"b": [0, 0, 0]}},
          {"frame": 5, "pose": {"b": [0, 50, 0]}}, {"frame": 7, "attach": {"actor": "one", "place": [0, 1, 0]}}]})"));
  const CompiledFilm compiled = compile(film);  // checks what was planned
  EXPECT_EQ(animator::state_at(film, 1, 12).place, glm::dvec3(3, 1, 0));
}

TEST(Carried, CheckReportsWhereOneIsDropped) {
  const auto lines = animator::check_film(carried_film()).lines;
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(document::holds(lines[0], "actor 'ball': jumps ")) << lines[0];
  EXPECT_TRUE(document::holds(lines[0], "detached at frame 16 (fix it with: detach ball --frame 16)")) << lines[0];
}

TEST(CameraPoints, GoAlongWithActors) {
  const animator::Film film = carried_film(
      R"({"eye": {"actor": "tom", "offset": [0, -6, 1.5], "level": true},
          "at": {"actor": "tom", "joint": "b", "offset": [0, 0, 0.5], "axes": "joint"}})");
  for (std::uint32_t frame = 0; frame < film.frames; ++frame) {
    const auto tom = animator::state_at(film, kTom, frame);
    EXPECT_EQ(animator::eye_at(film, frame), glm::dvec3(tom.place.x, tom.place.y - 6, 1.5));
    EXPECT_EQ(animator::at_at(film, frame), tom.joints[1].turn * glm::dvec3(0, 0, 0.5) + tom.joints[1].place);
  }
}

TEST(CameraPoints, BetweenKeysGoFromWhereTheyAreAtTheFrame) {
  const animator::Film film =
      carried_film(R"({"keys": [{"frame": 0, "eye": [0, -9, 2]}, {"frame": 10, "eye": {"actor": "tom", "joint": "a",
          "offset": [0, -5, 1]}}, {"frame": 14, "eye": [8, 0, 0]}]})");
  for (const std::uint32_t frame : {0u, 3u, 8u}) {
    const glm::dvec3 start(0, -9, 2),
        end = animator::state_at(film, kTom, frame).joints[0].place + glm::dvec3(0, -5, 1);
    EXPECT_EQ(animator::eye_at(film, frame), start + frame / 10.0 * (end - start)) << frame;
  }
  EXPECT_EQ(animator::eye_at(film, 14), glm::dvec3(8, 0, 0));
}

TEST(CameraPoints, SplinesAreThoseOfPlacesWhereNobodyMoves) {
  const auto eye_of = [](const std::string& third) {
    animator::Film film = carried_film(R"({"keys": [{"frame": 10, "eye": [0, -9, 2]}, {"frame": 12, "eye": [3, -8, 4]},
        {"frame": 16, "eye": )" + third +
                                       R"(}, {"frame": 19, "eye": [1, 1, 1]}]})");
    for (auto& key : film.camera.eye) key.ease.spline = true;
    return film;
  };
  const animator::Film fixed = eye_of("[3, 1, 5]"), followed = eye_of(R"({"actor": "tom", "offset": [1, 0, 5]})");
  for (const std::uint32_t frame : {11u, 13u, 15u, 17u})
    EXPECT_EQ(animator::eye_at(fixed, frame), animator::eye_at(followed, frame)) << frame;
}

TEST(CameraPoints, TheCameraStandsWhereTheActorDoes) {
  const CompiledFilm compiled = compile(carried_film(R"({"eye": {"actor": "tom", "offset": [0, -6, 1.5]}})"));
  const wire::PackedFilm view = compiled.view();
  const wire::Track& track = view.settings().camera;
  EXPECT_EQ(track.count, 8u);  // at first, and tom walks in seven frames
  EXPECT_EQ(view.changes()[track.first + track.count - 1].frame, 9u);
  EXPECT_EQ(view.intervals().back().moving_count, 0u);
}

TEST(CameraPoints, LightsOfAFilmWithoutLightsStandAsForTheFirstFrame) {
  const animator::Film fixed = carried_film(R"({"eye": [0, -6, 1.5]})"),
                       followed = carried_film(R"({"eye": {"actor": "tom", "offset": [0, -6, 1.5]}})");
  ASSERT_EQ(fixed.lights.size(), followed.lights.size());
  for (std::size_t i = 0; i < fixed.lights.size(); ++i)
    EXPECT_EQ(fixed.lights[i].vector[0].value, followed.lights[i].vector[0].value);
}

}  // namespace
}  // namespace mars::film
