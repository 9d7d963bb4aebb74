// A part of a picture, and pixels around it: each pixel has the same bits as in the whole picture. And pixels that are
// not square.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "host/content/film/crop.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

using film::Crop;

struct Case {
  const char* name;
  wire::FilmData film;
  wire::PixelFormat format = wire::PixelFormat::rgb8;
};

constexpr std::uint32_t kWidth = 65, kHeight = 41;

std::vector<Case> cases() {
  const wire::FilmData four = with_samples(crowd(kWidth, kHeight, 3, 3), 4);
  const wire::FilmData shadows = with_samples(overhead(kWidth, kHeight, 2, 2), 4);
  wire::FilmData wide = casting(shadows, {0.4f, 0.3f});
  wide.settings.pixel_aspect = 1.5f;
  return {{"crowd", crowd(kWidth, kHeight, 5, 3)},
          {"lit", richly_lit(four), wire::PixelFormat::half},
          {"alpha", richly_lit(four), wire::PixelFormat::half_alpha},
          {"flight", richly_lit(with_samples(flight(kWidth, kHeight, 3), 2))},
          {"parallel", orthographic(four)},
          {"shifted", shifted(four, 0.3, -0.2)},
          {"sharp-shadows", casting(shadows, {0, 0})},
          {"soft-shadows", casting(shadows, {0.4f, 0.3f})},
          {"parallel-shadows", orthographic(casting(shadows, {0.4f, 0}))},
          {"wide-shadows", wide}};
}

wire::FilmData part_of(wire::FilmData film, const std::optional<Crop>& crop, std::uint32_t margin) {
  film::set_window(crop, margin, "test film", film.settings);
  return film;
}

FilmRun drawn(const wire::FilmData& film, wire::PixelFormat format, int nodes, const std::string& simd = "") {
  RunOptions options;
  options.nodes = nodes;
  options.format = format;
  options.simd = simd;
  return run_film(FilmBlock(film).bytes(), options);
}

// How many pixels of both differ, of `count`.
struct Compared {
  std::size_t different = 0;
  std::size_t count = 0;
};

// Of the places that both pictures have; places count from the whole picture's corner.
Compared compare(const Pixels& some, const wire::FilmSettings& of_some, const Pixels& all,
                 const wire::FilmSettings& of_all, std::size_t words) {
  Compared compared;
  const wire::PictureWindow &from = of_some.window, &to = of_all.window;
  for (std::int32_t y = 0; y < static_cast<std::int32_t>(of_some.height); ++y)
    for (std::int32_t x = 0; x < static_cast<std::int32_t>(of_some.width); ++x) {
      const std::int32_t there_x = x + from.left - to.left, there_y = y + from.top - to.top;
      const bool both = there_x >= 0 && there_y >= 0 && there_x < static_cast<std::int32_t>(of_all.width) &&
                        there_y < static_cast<std::int32_t>(of_all.height);
      if (!both) continue;
      const std::size_t a = (static_cast<std::size_t>(y) * of_some.width + static_cast<std::size_t>(x)) * words;
      const std::size_t b =
          (static_cast<std::size_t>(there_y) * of_all.width + static_cast<std::size_t>(there_x)) * words;
      ++compared.count;
      compared.different += !std::equal(some.begin() + static_cast<std::ptrdiff_t>(a),
                                        some.begin() + static_cast<std::ptrdiff_t>(a + words),
                                        all.begin() + static_cast<std::ptrdiff_t>(b));
    }
  return compared;
}

class Cropped : public testing::TestWithParam<Case> {};

TEST_P(Cropped, HasThePixelsOfTheWholePicture) {
  const auto& [name, film, format] = GetParam();
  const FilmRun whole = drawn(film, format, 2);
  const std::size_t words = wire::pixel_words(format);
  struct Part {
    std::optional<Crop> crop;
    std::uint32_t margin;
    int nodes;
    const char* simd;
  };
  for (const Part& part : {Part{Crop{21, 11, 27, 20}, 0, 2, ""}, Part{Crop{0, 0, 33, 41}, 0, 1, "sse2"},
                           Part{Crop{62, 38, 3, 3}, 5, 3, ""}, Part{{}, 13, 2, ""}}) {
    const wire::FilmData some = part_of(film, part.crop, part.margin);
    const FilmRun run = drawn(some, format, part.nodes, part.simd);
    ASSERT_EQ(run.frames.size(), whole.frames.size());
    for (const auto& [frame, pixels] : run.frames) {
      const Compared compared = compare(pixels, some.settings, whole.frames.at(frame), film.settings, words);
      EXPECT_EQ(compared.different, 0u) << film::size_text(some.settings) << ", frame " << frame;
      EXPECT_GE(compared.count, 9u);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Films, Cropped, testing::ValuesIn(cases()), [](const auto& info) {
  std::string name = info.param.name;
  std::erase(name, '-');
  return name;
});

// A larger picture at the same scale has the same content, but for how finely patches near its corners are diced.
TEST(Margin, ShowsWhatIsBesideThePicture) {
  const wire::FilmData film = with_samples(crowd(kWidth, kHeight, 1, 1), 4);
  const wire::FilmData more = part_of(film, {}, 20);
  wire::FilmData larger = film;
  larger.settings.width += 40;
  larger.settings.height += 40;
  larger.cameras[0].focal *= double(kHeight) / (kHeight + 40);
  wire::FilmSettings shown = larger.settings;
  shown.window = {-20, -20, kWidth, kHeight};
  const Pixels margin = drawn(more, wire::PixelFormat::rgb8, 2).frames.at(0);
  const Compared compared =
      compare(margin, more.settings, drawn(larger, wire::PixelFormat::rgb8, 2).frames.at(0), shown, 1);
  EXPECT_EQ(compared.count, std::size_t{kWidth + 40} * (kHeight + 40));
  EXPECT_LT(compared.different, compared.count / 20);
}

TEST(Crop, LessensTheWork) {
  const wire::FilmData film = with_samples(crowd(320, 180, 2, 2), 4);
  const auto boxes = [](const FilmRun& run) {
    std::uint64_t sum = 0;
    for (const wire::Strip& strip : run.report.strips) sum += strip.work.edge_boxes;
    return sum;
  };
  const std::uint64_t all = boxes(drawn(film, wire::PixelFormat::rgb8, 2));
  const std::uint64_t some = boxes(drawn(part_of(film, Crop{120, 60, 80, 45}, 0), wire::PixelFormat::rgb8, 2));
  EXPECT_LT(some, all / 2);
}

// In numbers that are exact: pixels twice as wide show what the camera sees of a scene of half the width.
TEST(PixelAspect, SqueezesThePicture) {
  wire::FilmData wide = in_pure_colors(with_samples(crowd(80, 90, 1, 1), 4));
  wide.settings.dice = 12;
  wire::FilmData narrow = wide;
  wide.settings.pixel_aspect = 2;
  for (double& number : narrow.cameras[0].world_to_eye.m[0]) number /= 2;
  EXPECT_EQ(drawn(wide, wire::PixelFormat::rgb8, 2).frames.at(0),
            drawn(narrow, wire::PixelFormat::rgb8, 1).frames.at(0));
}

// A pixel twice as wide shows the mean of two square ones, also where surfaces shine and shadows fall.
TEST(PixelAspect, ShadesAsSquarePixelsDo) {
  const wire::FilmData square = with_samples(casting(overhead(80, 46, 1, 1), {0.4f, 0}), 16);
  wire::FilmData wide = square;
  wide.settings.width = 40;
  wide.settings.pixel_aspect = 2;
  const Pixels one = drawn(wide, wire::PixelFormat::rgb8, 1).frames.at(0);
  const Pixels two = drawn(square, wire::PixelFormat::rgb8, 1).frames.at(0);
  std::uint64_t error = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    for (const int shift : {0, 8, 16}) {
      const auto level = [shift](std::uint32_t pixel) { return static_cast<int>(pixel >> shift & 0xff); };
      error += static_cast<std::uint64_t>(std::abs(2 * level(one[i]) - level(two[2 * i]) - level(two[2 * i + 1])));
    }
  EXPECT_LT(static_cast<double>(error) / (6.0 * static_cast<double>(one.size())), 1.0) << "levels, on average";
}

}  // namespace
}  // namespace mars::test
