// Excerpts of films: what decides the pixels of the frames that are asked for is as in the whole film, and little else
// is there.
#include "host/content/film/excerpt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

#include "host/content/film/frame_content.h"
#include "node/wire/pixel_format.h"
#include "tests/host/content/film/small_film.h"

namespace mars::film {
namespace {

using Frames = std::vector<std::uint32_t>;

constexpr std::uint32_t kFrames = 400;

// Joints that move now and then, a material and a camera that change, and exposure, which cuts intervals.
const std::string kFourHundred = R"("frames": 400, "color": "linear")";
const std::string kArms = R"({"name": "x", "model": "arm", "keys": [
    {"frame": 0, "place": [0, 0, 0], "pose": {"b": [0, 0, 0]}}, {"frame": 90, "pose": {"b": [0, 90, 0]}},
    {"frame": 200, "place": [1, 2, 0]}, {"frame": 399, "place": [5, 0, 1], "pose": {"b": [0, 300, 0]}}]},
  {"name": "y", "model": "arm", "place": [0, 3, 0]})";

CompiledFilm long_film(const std::string& film) {
  const auto with_exposure = [](std::string text) {
    const std::string eye = R"("eye": [0, -9, 2])";
    return text.replace(text.find(eye), eye.size(), eye + R"(, "keys": [
        {"frame": 0, "exposure": 0}, {"frame": 120, "exposure": 0}, {"frame": 140, "exposure": 1}])");
  };
  return compiled(with_exposure(film));
}

void expect_as_whole(const CompiledFilm& film, const Frames& frames) {
  const auto excerpt = excerpt_of(film, frames);
  ASSERT_TRUE(excerpt);
  EXPECT_LT(excerpt->block().size(), film.block().size() / 2);
  const wire::PackedFilm some(excerpt->block(), "excerpt");  // it is a sound film
  const wire::LayerSet layers = wire::kAllLayers;
  const FrameContent whole(film.view(), layers), part(some, layers);
  for (const std::uint32_t frame : frames) EXPECT_EQ(part.checksum(frame), whole.checksum(frame)) << frame;
  ASSERT_EQ(some.intervals().size(), film.view().intervals().size());
  for (const std::uint32_t frame : frames) {
    const std::uint32_t first = film.view().interval_at(frame).first_frame;
    EXPECT_EQ(some.interval_at(frame).first_frame, first);
    EXPECT_EQ(part.checksum(first), whole.checksum(first));
  }
}

TEST(Excerpt, ShowsTheSameFrames) {
  for (const CompiledFilm& film :
       {long_film(arm_film(kArms, kFourHundred)), compiled(sleeve_film(R"({"name": "x", "model": "arm", "keys": [
        {"frame": 0, "pose": {"fore": [0, 0, 0]}}, {"frame": 399, "pose": {"fore": [0, -90, 0]}}]})",
                                                                       R"("frames": 400)"))})
    for (const Frames& frames : {Frames{0}, Frames{7}, Frames{50, 51, 130, 131}, Frames{90, 200}, Frames{kFrames - 1}})
      expect_as_whole(film, frames);
}

TEST(Excerpt, IsMadeWhereItIsMuchSmaller) {
  const CompiledFilm film = long_film(arm_film(kArms, kFourHundred));
  Frames all(kFrames);
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_FALSE(excerpt_of(film, all));
  EXPECT_FALSE(excerpt_of(compiled(arm_film(R"({"name": "x", "model": "arm"})")), Frames{3}));
}

}  // namespace
}  // namespace mars::film
