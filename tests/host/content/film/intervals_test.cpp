#include "host/content/film/intervals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/host/content/film/small_film.h"

namespace mars::film {
namespace {

using Starts = std::vector<std::uint32_t>;

Starts starts_of(const wire::PackedFilm& film) {
  Starts starts;
  for (const wire::Interval& interval : film.intervals()) starts.push_back(interval.first_frame);
  return starts;
}

bool changes_within(const wire::PackedFilm& film, const wire::Track& track, std::uint32_t first, std::uint32_t end) {
  for (std::uint32_t frame = first + 1; frame < end; ++frame)
    if (film.value_at(track, frame) != film.value_at(track, frame - 1)) return true;
  return false;
}

// What moves in [first, end), plainly.
Starts movers_between(const wire::PackedFilm& film, std::uint32_t first, std::uint32_t end) {
  bool all = changes_within(film, film.settings().camera, first, end);
  for (const wire::Track& light : film.light_tracks()) all = all || changes_within(film, light, first, end);
  Starts movers;
  for (std::uint32_t i = 0; i < film.segments().size(); ++i) {
    const wire::Segment& segment = film.segments()[i];
    if (all || changes_within(film, segment.motion, first, end) || changes_within(film, segment.material, first, end))
      movers.push_back(i);
  }
  return movers;
}

double cost_of(const wire::PackedFilm& film, const Starts& starts) {
  const double pixels = double(film.settings().width) * film.settings().height;
  double cost = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::uint32_t end = i + 1 < starts.size() ? starts[i + 1] : film.settings().frames;
    double moving = 0;
    for (const std::uint32_t segment : movers_between(film, starts[i], end))
      moving += film.shapes()[film.segments()[segment].shape].patch_count;
    cost += double(film.patch_instances()) + pixels / kPixelsPerPatch + (end - starts[i] - 1) * moving;
  }
  return cost;
}

void expect_sound(const CompiledFilm& compiled) {
  const wire::PackedFilm film(compiled.block(), "f");  // checks that every frame is covered once
  for (const wire::Interval& interval : film.intervals()) {
    const auto list = film.moving(interval);
    EXPECT_EQ(Starts(list.begin(), list.end()),
              movers_between(film, interval.first_frame, interval.first_frame + interval.frame_count));
  }
}

// A film of boxes and spheres that move now and then.
std::string random_film(std::mt19937& random, std::uint32_t frames) {
  const auto number = [&](int below) { return std::to_string(random() % below); };
  std::string actors;
  for (int i = 0; i < 5; ++i) {
    actors += (i ? ", " : "") + ("{\"name\": \"" + std::to_string(i)) + "\", \"model\": \"arm\", \"keys\": [";
    std::uint32_t frame = random() % frames;
    for (int key = 0; frame < frames + 3; ++key, frame += 1 + random() % 6)
      actors += (key ? ", " : "") + ("{\"frame\": " + std::to_string(frame)) + ", \"pose\": {\"" +
                (random() % 2 ? "a\": [0, 0, " + number(2) + "]" : "b\": [0, " + number(2) + ", 0]") +
                "}, \"place\": [" + number(2) + ", 0, 0]}";
    actors += random() % 2 ? "], \"material\": \"glow\"}" : "]}";
  }
  return arm_film(actors, "\"size\": [100, 100], \"frames\": " + std::to_string(frames));
}

TEST(Intervals, AutomaticOnesCostLeast) {
  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    const std::uint32_t frames = 1 + random() % 11;
    const CompiledFilm film = compiled(random_film(random, frames));
    expect_sound(film);
    double best = 1e300;
    for (std::uint32_t cuts = 0; cuts < 1u << (frames - 1); ++cuts) {
      Starts starts = {0};
      for (std::uint32_t frame = 1; frame < frames; ++frame)
        if (cuts >> (frame - 1) & 1) starts.push_back(frame);
      best = std::min(best, cost_of(film.view(), starts));
    }
    EXPECT_NEAR(cost_of(film.view(), starts_of(film.view())), best, 1e-6 * best);
  }
}

TEST(Intervals, OfKeyframesAreCutWhereKeysAre) {
  const std::string json = arm_film(R"({"name": "x", "model": "arm", "keys": [
      {"frame": 2, "place": [0, 0, 0]}, {"frame": 9, "place": [1, 0, 0]}, {"frame": 40, "place": [2, 0, 0]}]})");
  EXPECT_EQ(starts_of(compiled(json, {animator::Cutting::keyframes, {}}).view()), (Starts{0, 2, 9}));
  std::mt19937 random(4);
  for (int round = 0; round < 20; ++round)
    expect_sound(compiled(random_film(random, 30), {animator::Cutting::keyframes, {}}));
}

TEST(Intervals, DenseKeysDoNotDestroyCoherence) {
  std::string keys;
  for (int frame = 0; frame < 300; ++frame)
    keys += (frame ? ", " : "") + ("{\"frame\": " + std::to_string(frame)) + ", \"pose\": {\"b\": [0, " +
            std::to_string(frame % 90) + ", 0]}}";
  const std::string still = R"(, {"name": "y", "model": "arm"}, {"name": "z", "model": "arm"})";
  const std::string json =
      arm_film("{\"name\": \"x\", \"model\": \"arm\", \"keys\": [" + keys + "]}" + still, "\"frames\": 300");
  EXPECT_EQ(compiled(json).view().intervals().size(), 1u);
  EXPECT_EQ(compiled(json, {animator::Cutting::keyframes, {}}).view().intervals().size(), 300u);
}

TEST(Intervals, WhatMovesShortlyIsCutOut) {
  const std::string still = R"({"name": "s", "model": "arm"})";
  const std::string json = arm_film(R"({"name": "x", "model": "arm", "keys": [
      {"frame": 50, "place": [0, 0, 0]}, {"frame": 60, "place": [1, 0, 0]}]}, )" +
                                        still,
                                    "\"frames\": 200");
  const CompiledFilm film = compiled(json);
  EXPECT_EQ(starts_of(film.view()), (Starts{0, 51, 60})) << "frame 51 is the first to differ, 60 the last";
  EXPECT_EQ(film.view().intervals()[0].moving_count, 0u);
  EXPECT_EQ(film.view().intervals()[1].moving_count, 2u);
}

TEST(Intervals, AMovingCameraOrLightMovesEverything) {
  const std::string actor = R"({"name": "s", "model": "arm"})";
  std::string json = arm_film(actor);
  const std::string camera = R"("camera": {"eye": [0, -9, 2]})";
  json.replace(json.find(camera), camera.size(),
               R"("camera": {"keys": [{"frame": 0, "eye": [0, -9, 2]}, {"frame": 5, "eye": [0, -8, 2]}]})");
  const CompiledFilm film = compiled(json);
  expect_sound(film);
  EXPECT_EQ(film.view().intervals()[0].moving_count, 2u);
  EXPECT_EQ(film.view().intervals().back().moving_count, 0u);
}

}  // namespace
}  // namespace mars::film
