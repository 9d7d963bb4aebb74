// Panoramas of whole films: what stands in a known direction is at its pixel, and faces meet without a seam.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "host/content/animator/reading/read_film.h"
#include "host/content/document/fields.h"
#include "host/content/film/compile.h"
#include "host/content/film/panorama.h"
#include "host/images/half_light.h"
#include "host/render/panorama/join.h"
#include "tests/render/film_run.h"

namespace mars::test {
namespace {

constexpr std::uint32_t kWidth = 128;
constexpr const char* kBall =
    R"({"joints": [{"name": "a", "segment": {"shape": "sphere", "sbb": [[-1, -1, -1], [1, 1, 1]]}}]})";

// The camera stands at 1, 2, 3 and looks along y.
film::CompiledFilm compiled(const std::string& more) {
  const std::string text = R"({"frames": 2, "size": [128, 64], "samples": 4, "lights": [], "background": [0, 0, 0],
    "camera": {"projection": "panorama", "eye": [1, 2, 3], "at": [1, 12, 3]}, )" +
                           more + "}";
  return film::compile(animator::read_film(document::Document(text, "panorama").root(), {}));
}

struct Joined {
  std::vector<panorama::Light> pixels;

  const panorama::Light& at(std::uint32_t x, std::uint32_t y) const { return pixels[std::size_t{y} * kWidth + x]; }
};

Joined joined(const film::CompiledFilm& film, std::uint32_t frame) {
  const film::CompiledFilm faces = film::faces_of(film);
  RunOptions options;
  options.nodes = 2;
  options.format = wire::PixelFormat::half;
  const FilmRun run = run_film(faces.block(), options);
  const std::uint32_t side = film::face_side(kWidth);
  std::vector<panorama::Face> pictures;
  for (const std::uint32_t number : film::face_frames({frame}, 2))
    pictures.emplace_back(images::Image{side, side, run.frames.at(number)});
  const panorama::Joiner joiner(kWidth);
  Joined all;
  for (std::uint32_t y = 0; y < joiner.height(); ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) all.pixels.push_back(joiner.light_at(pictures, x, y));
  return all;
}

// The mean direction of what is bright in one channel: to the right, up and ahead.
std::array<double, 3> direction_of_light(const Joined& picture, std::size_t channel) {
  std::array<double, 3> sum{};
  for (std::uint32_t y = 0; y < kWidth / 2; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const double longitude = ((x + 0.5) / kWidth - 0.5) * 2 * std::numbers::pi,
                   latitude = (0.5 - 2 * (y + 0.5) / kWidth) * std::numbers::pi;
      const double light = double(picture.at(x, y)[channel]) * std::cos(latitude);  // by the angle that a pixel covers
      sum[0] += light * std::sin(longitude) * std::cos(latitude);
      sum[1] += light * std::sin(latitude);
      sum[2] += light * std::cos(longitude) * std::cos(latitude);
    }
  }
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  for (double& part : sum) part /= length;
  return sum;
}

// Places and frames are those of the world: to the right is x, ahead y, up z.
TEST(Panoramas, ShowThingsWhereTheyAre) {
  constexpr double kDistance = 10;
  const std::array<double, 3> ways[] = {
      {0, 0, 1},          {1, 0, 0},           {0, 0, -1},         {-1, 0, 0},
      {0, 1, 0},          {0, -1, 0},          {0.6, 0, 0.8},      {0.577, 0.577, 0.577},
      {-0.707, 0, 0.707}, {0, -0.707, -0.707}, {-0.36, 0.48, -0.8}};
  for (const auto& [right, up, ahead] : ways) {
    const auto place = [&](double distance) {
      return "[" + std::to_string(1 + distance * right) + ", " + std::to_string(2 + distance * ahead) + ", " +
             std::to_string(3 + distance * up) + "]";
    };
    const film::CompiledFilm film =
        compiled(R"("models": {"ball": )" + std::string(kBall) +
                 R"(}, "materials": {"bright": {"ambient": 1, "diffuse": 0, "specular": 0, "color": [1, 1, 1]}},
           "actors": [{"name": "ball", "model": "ball", "material": "bright", "keys": [{"frame": 0, "place": )" +
                 place(kDistance) + R"(}, {"frame": 1, "place": )" + place(-kDistance) + "}]}]");
    for (const std::uint32_t frame : {0u, 1u}) {
      const std::array<double, 3> found = direction_of_light(joined(film, frame), 0);
      const double sign = frame == 0 ? 1 : -1;
      EXPECT_NEAR(found[0], sign * right, 0.01) << right << " " << up << " " << ahead;
      EXPECT_NEAR(found[1], sign * up, 0.01) << right << " " << up << " " << ahead;
      EXPECT_NEAR(found[2], sign * ahead, 0.01) << right << " " << up << " " << ahead;
    }
  }
}

// Inside a ball that is lit from above and below: light is a linear function of the direction's height, on every face.
TEST(Panoramas, FacesMeetWithoutASeam) {
  const film::CompiledFilm film = compiled(
      R"("models": {"ball": {"joints": [{"name": "a", "segment":
           {"shape": "sphere", "sbb": [[-20, -20, -20], [20, 20, 20]]}}]}},
         "ambient": {"sky": [1, 1, 1], "ground": [0, 0, 0]}, "dice": 32,
         "materials": {"plain": {"ambient": 1, "diffuse": 0, "specular": 0, "color": [1, 1, 1]}},
         "actors": [{"name": "ball", "model": "ball", "material": "plain", "place": [1, 2, 3]}])");
  const Joined picture = joined(film, 1);
  for (std::uint32_t y = 0; y < kWidth / 2; ++y) {
    const double inwards = -std::sin((0.5 - 2 * (y + 0.5) / kWidth) * std::numbers::pi);
    for (std::uint32_t x = 0; x < kWidth; ++x)
      ASSERT_NEAR(picture.at(x, y)[1], (1 + inwards) / 2, 0.003) << x << ", " << y;
  }
}

TEST(Panoramas, FacesHaveTheIntervalsOfThePanorama) {
  const film::CompiledFilm film =
      compiled(R"("models": {"ball": )" + std::string(kBall) +
               R"(}, "actors": [{"name": "still", "model": "ball"}, {"name": "ball", "model": "ball",
           "keys": [{"frame": 0, "place": [0, 5, 0]}, {"frame": 1, "place": [0, 6, 0]}]}])");
  const film::CompiledFilm faces = film::faces_of(film);
  EXPECT_NO_THROW(wire::PackedFilm(faces.block(), "faces"));  // all of it is checked
  const wire::PackedFilm view = film.view(), of_faces = faces.view();
  ASSERT_EQ(of_faces.intervals().size(), 6 * view.intervals().size());
  for (std::size_t i = 0; i < of_faces.intervals().size(); ++i) {
    const wire::Interval &face = of_faces.intervals()[i], &whole = view.intervals()[i % view.intervals().size()];
    EXPECT_EQ(face.frame_count, whole.frame_count);
    EXPECT_EQ(of_faces.moving(face).size(), view.moving(whole).size());
  }
}

}  // namespace
}  // namespace mars::test
