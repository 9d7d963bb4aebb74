// Films at the size that must still work, with generous bounds on processors' time.
#include <gtest/gtest.h>

#include <functional>

#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/film/small_film.h"
#include "tests/processor_time.h"

namespace mars::film {
namespace {

double seconds_of(const std::function<void()>& work) {
  const test::ProcessorTime time;
  work();
  return time.seconds();
}

constexpr const char* kStart = R"({"frames": 24, "camera": {"eye": [0, -900, 200]}, "models": {"m": )";

TEST(LargeFilm, AMillionPatchesOfTeapots) {
  std::string json =
      std::string(kStart) + R"({"joints": [{"name": "t", "segment": {"shape": "teapot"}}]}}, "actors": [)";
  for (int i = 0; i < 31'250; ++i)
    json += (i ? ",\n" : "") + ("{\"name\": \"t" + std::to_string(i)) + "\", \"model\": \"m\", \"place\": [" +
            std::to_string(i % 177) + ", " + std::to_string(i / 177) + ", 0]}";
  CompiledFilm film;
  EXPECT_LT(seconds_of([&] { film = compiled(json + "]}"); }), 10);
  EXPECT_EQ(film.view().patch_instances(), 1'000'000u);
  EXPECT_EQ(film.view().patches().size(), 32u);
}

TEST(LargeFilm, AHundredThousandPatchesInline) {
  std::string patch = "[";
  for (int i = 0; i < 16; ++i) patch += std::string(i ? ", " : "") + "[0.123456, 0.5, 0.987654]";
  std::string json =
      std::string(kStart) + R"({"joints": [{"name": "t", "segment": {"shape": "s"}}], "shapes": {"s": [)";
  for (int i = 0; i < 100'000; ++i) json += (i ? ",\n" : "") + patch + "]";
  CompiledFilm film;
  EXPECT_LT(seconds_of([&] { film = compiled(json + R"(]}}}, "actors": [{"name": "x", "model": "m"}]})"); }), 30);
  EXPECT_EQ(film.view().patches().size(), 100'000u);
}

TEST(LargeFilm, AMillionTrianglesOfAMesh) {
  constexpr int kSide = 708;
  std::string json =
      std::string(kStart) +
      R"({"joints": [{"name": "t", "segment": {"shape": "s"}}], "shapes": {"s": {"mesh": {"vertices": [)";
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      json += (i + j ? ",\n[0." : "[0.") + std::to_string(1000 + i) + ", 0." + std::to_string(1000 + j) + ", 0." +
              std::to_string(1000 + (i * i + 3 * j) % 17) + "]";
  json += "], \"faces\": [";
  for (int j = 0; j + 1 < kSide; ++j)
    for (int i = 0; i + 1 < kSide; ++i) {
      const int a = j * kSide + i;
      const std::string first = std::to_string(a), opposite = std::to_string(a + kSide + 1);
      json += (a ? ",\n[" : "[") + first + ", " + std::to_string(a + 1) + ", " + opposite + "],\n[" + first + ", " +
              opposite + ", " + std::to_string(a + kSide) + "]";
    }
  CompiledFilm film;
  EXPECT_LT(seconds_of([&] { film = compiled(json + R"(]}}}}}, "actors": [{"name": "x", "model": "m"}]})"); }), 30);
  EXPECT_EQ(film.view().mesh_triangles().size(), 2u * (kSide - 1) * (kSide - 1));
}

std::string chain(int length) {
  std::string joints = R"({"name": "j0", "segment": {"shape": "box"}})";
  for (int i = 1; i < length; ++i)
    joints += ",\n{\"name\": \"j" + std::to_string(i) + "\", \"parent\": \"j" + std::to_string(i - 1) +
              "\", \"place\": [1, 0, 0], \"segment\": {\"shape\": \"box\"}}";
  return std::string(kStart) + "{\"joints\": [" + joints + "]}}, \"actors\": [{\"name\": \"x\", \"model\": \"m\"";
}

TEST(LargeFilm, AChainOfAHundredThousandJointsThatMoves) {
  const std::string keys =
      R"(, "keys": [{"frame": 0, "pose": {"j0": [0, 0, 0]}}, {"frame": 9, "pose": {"j0": [0, 0, 90]}}]}]})";
  CompiledFilm film;
  EXPECT_LT(seconds_of([&] { film = compiled(chain(100'000) + keys); }), 20);
  const wire::PackedFilm view = film.view();
  const wire::Matrix& last = view.matrix_at(view.segments()[99'999], 23);
  EXPECT_NEAR(last.m[1][3], 99'999, 1e-6);
  EXPECT_EQ(last.m[0][3], 0);
}

TEST(LargeFilm, LongFilmsAreCutQuickly) {
  std::string keys;
  for (int frame = 0; frame <= 20'000; frame += 10)
    keys += (frame ? ", " : "") + ("{\"frame\": " + std::to_string(frame)) + ", \"pose\": {\"b\": [0, " +
            std::to_string(frame / 10 % 5 * 20) + ", 0]}}";
  const std::string json =
      arm_film("{\"name\": \"x\", \"model\": \"arm\", \"keys\": [" + keys + "]}", "\"frames\": 20000");
  EXPECT_LT(seconds_of([&] { compiled(json); }), 5);
}

}  // namespace
}  // namespace mars::film
