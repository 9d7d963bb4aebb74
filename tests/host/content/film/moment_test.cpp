// A film at one frame, asked alone, is what the compiled film has there, bit for bit.
#include "host/content/film/moment.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "host/content/animator/reading/read_film.h"
#include "host/content/film/compile.h"
#include "tests/host/content/film/small_film.h"

namespace mars::film {
namespace {

template <typename Value>
void expect_same(const Value& one, const Value& other, const std::string& what) {
  EXPECT_EQ(std::memcmp(&one, &other, sizeof one), 0) << what;
}

template <typename Value>
void expect_same(std::span<const Value> ones, std::span<const Value> others, const std::string& what) {
  ASSERT_EQ(ones.size(), others.size()) << what;
  EXPECT_EQ(ones.empty() ? 0 : std::memcmp(ones.data(), others.data(), ones.size_bytes()), 0) << what;
}

void expect_film_at(const animator::Film& film, const wire::PackedFilm& whole, std::uint32_t frame) {
  const CompiledFilm compiled = compiled_moment(film, frame);
  const wire::PackedFilm moment = compiled.view();
  const std::string at = film.source + ", frame " + std::to_string(frame);
  wire::FilmSettings settings = whole.settings();
  settings.frames = 1;
  settings.camera = moment.settings().camera;
  expect_same(moment.settings(), settings, at);
  expect_same(moment.patches(), whole.patches(), at);
  expect_same(moment.shapes(), whole.shapes(), at);
  expect_same(moment.meshlets(), whole.meshlets(), at);
  expect_same(moment.net_points(), whole.net_points(), at);
  expect_same(moment.stencil_terms(), whole.stencil_terms(), at);
  expect_same(moment.stencils(), whole.stencils(), at);
  expect_same(moment.net_patches(), whole.net_patches(), at);
  expect_same(moment.skin_bones(), whole.skin_bones(), at);
  expect_same(moment.skin_weights(), whole.skin_weights(), at);
  expect_same(moment.camera_at(0), whole.camera_at(frame), at);
  ASSERT_EQ(moment.light_tracks().size(), whole.light_tracks().size()) << at;
  for (std::size_t i = 0; i < whole.light_tracks().size(); ++i)
    expect_same(moment.lights()[moment.value_at(moment.light_tracks()[i], 0)],
                whole.lights()[whole.value_at(whole.light_tracks()[i], frame)], at);
  ASSERT_EQ(moment.segments().size(), whole.segments().size()) << at;
  for (std::size_t i = 0; i < whole.segments().size(); ++i) {
    const wire::Segment &mine = moment.segments()[i], &its = whole.segments()[i];
    EXPECT_EQ(mine.shape, its.shape) << at;
    EXPECT_EQ(moment.name(mine), whole.name(its));
    expect_same(moment.matrix_at(mine, 0), whole.matrix_at(its, frame), at);
    ASSERT_EQ(mine.bone_count, its.bone_count) << at;
    for (std::size_t bone = 0; bone < its.bone_count; ++bone)
      expect_same(moment.matrix_at(moment.bones_of(mine)[bone], 0), whole.matrix_at(whole.bones_of(its)[bone], frame),
                  at);
    expect_same(moment.material_at(mine, 0), whole.material_at(its, frame), at);
  }
}

void expect_moments(const animator::Film& film) {
  const CompiledFilm whole = compile(film);
  const Cut cut = cut_of(film, shapes_of(film));
  const wire::PackedFilm view = whole.view();
  expect_same(std::span<const wire::Interval>(cut.intervals), view.intervals(), film.source);
  for (std::uint32_t frame = 0; frame < film.frames; ++frame) {
    expect_film_at(film, view, frame);
    for (const wire::Interval& interval : view.intervals())
      if (frame >= interval.first_frame && frame < interval.first_frame + interval.frame_count)
        expect_same(cut.moving_at(frame), view.moving(interval), film.source);
  }
}

TEST(Moment, IsTheCompiledFilms) {
  expect_moments(film_of(arm_film(
      R"({"name": "x", "model": "arm", "keys": [
           {"frame": 2, "place": [1, 2, 3], "turn": [10, 20, 30], "pose": {"a": [10, 20, 30], "b": [0, 10, 0]}, "ease": "both"},
           {"frame": 15, "place": [4, 2, 3], "turn": [0, 20, 80], "pose": {"a": [-40, 70, 3], "b": [0, 300, 0]}}]},
         {"name": "y", "model": "arm", "material": "glow"})")));
}

TEST(Moment, OfSkinsToo) {
  expect_moments(film_of(sleeve_film(R"({"name": "x", "model": "arm", "keys": [
      {"frame": 2, "place": [1, 2, 3], "pose": {"fore": [0, -10, 0]}},
      {"frame": 15, "place": [4, 2, 3], "pose": {"sleeve": [5, 5, 5], "fore": [0, -140, 0]}}]},
      {"name": "y", "model": "arm", "keys": [{"frame": 3, "attach": {"actor": "x", "joint": "fore"}}]})")));
}

TEST(Moment, OfExamplesToo) {
  for (const char* name : {"caterpillar.json", "robot-arm.json", "demo.json"})
    expect_moments(animator::read_film(std::filesystem::path(MARS_SOURCE_DIR) / "examples" / name));
}

}  // namespace
}  // namespace mars::film
