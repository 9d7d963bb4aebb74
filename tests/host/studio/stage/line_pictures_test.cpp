// Sticks, control vertices and prisms in a view: what is hidden, and what of a picture is sent.
#include "host/studio/stage/line_pictures.h"

#include <gtest/gtest.h>

#include "host/preview/film_drawing.h"
#include "tests/host/content/film/small_film.h"
#include "tests/host/studio/stage/fakes.h"
#include "tests/host/studio/step_words.h"

namespace mars::studio {
namespace {

// A large box before a small one, seen from -y; `shape` of both.
animator::Film two_boxes(const std::string& shape) {
  return film::film_of(R"({"frames": 3, "camera": {"eye": [0, -10, 0], "at": [0, 0, 0]},
    "materials": {"near": {"color": [1, 0, 0]}, "far": {"color": [0, 1, 0]}},
    "models": {"m": {"joints": [
      {"name": "near", "limits": {"z": [-90, 90]},
       "segment": {"shape": ")" +
                       shape + R"(", "sbb": [[-2, -2, -2], [2, 2, 2]], "material": "near"}},
      {"name": "far", "place": [0, 6, 0],
       "segment": {"shape": ")" +
                       shape + R"(", "sbb": [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]], "material": "far"}}]}},
    "actors": [{"name": "a", "model": "m"}]})");
}

struct Counts {
  int red = 0, green = 0;
};

Counts count(const images::Image& image) {
  Counts counts;
  for (const std::uint32_t pixel : image.pixels) {
    const int red = pixel & 0xff, green = pixel >> 8 & 0xff;
    counts.red += red > 2 * green;
    counts.green += green > 2 * red;
  }
  return counts;
}

Counts drawn(const std::string& shape, preview::As as, bool hidden) {
  FakeProject project(two_boxes(shape));
  Moments moments(project);
  moments.renew();
  LinePictures lines(project, moments);
  preview::Drawing drawing(200, 200);
  lines.draw({as, hidden, false}, moments.now().cameras.front(), drawing);
  return count(drawing.image());
}

TEST(LinePictures, PrismsHideByTheirFaces) {
  const Counts all = drawn("box", preview::As::prisms, false), seen = drawn("box", preview::As::prisms, true);
  EXPECT_GT(all.green, 50);
  EXPECT_EQ(seen.green, 0) << "it is behind the large one";
  EXPECT_GT(seen.red, all.red / 3) << "edges are before their own faces";
  EXPECT_LT(seen.red, all.red) << "those behind are not seen";
}

TEST(LinePictures, ControlVerticesHideBySurfaces) {
  const Counts all = drawn("sphere", preview::As::vertices, false), seen = drawn("sphere", preview::As::vertices, true);
  EXPECT_GT(all.green, 50);
  EXPECT_EQ(seen.green, 0);
  EXPECT_GT(seen.red, all.red / 4);
  EXPECT_LT(seen.red, all.red);
}

TEST(LinePictures, SticksRunWithinAndAreNotHidden) {
  const Counts all = drawn("box", preview::As::stick, false), seen = drawn("box", preview::As::stick, true);
  EXPECT_GT(all.red + all.green, 0);
  EXPECT_EQ(seen.red, all.red);
  EXPECT_EQ(seen.green, all.green);
}

// The near plane cuts a face that reaches behind the eye.
TEST(LinePictures, CoversReachBehindTheEye) {
  preview::Drawing drawing(100, 100);
  wire::Camera camera{{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}}, 1, 0.5, 100};
  drawing.begin(camera, {0, 0, 0}, 1, 100);
  const preview::Placing world{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  // A floor below the eye, from behind it to far away; a line under it and one above.
  drawing.cover({{-90, -1, 90, 90, -1, 90, 0, -1, -90}, {0, 1, 2}}, world, 0);
  drawing.draw({{-2, -2, -5, 2, -2, -5}, {0, 1}, 0}, world, {1, 1, 1});
  for (const std::uint32_t pixel : drawing.image().pixels) ASSERT_EQ(pixel, 0u);
  drawing.draw({{-2, -0.5, -5, 2, -0.5, -5}, {0, 1}, 0}, world, {1, 1, 1});
  int lit = 0;
  for (const std::uint32_t pixel : drawing.image().pixels) lit += pixel != 0;
  EXPECT_GT(lit, 20);
}

TEST(LinePictures, OnlyWhatDiffersIsSent) {
  OnStage on(two_boxes("box"));
  on.view(0, 200, 200, "free", "prisms");
  ASSERT_EQ(on.pictures.size(), 1u);
  ASSERT_EQ(on.pictures[0].rects.size(), 1u);
  EXPECT_EQ(on.pictures[0].pixels.size(), 200u * 200);
  EXPECT_FALSE(on.pictures[0].exact);
  EXPECT_TRUE(on.link.asked.empty()) << "lines are drawn here";
  images::Image page{200, 200, on.pictures[0].pixels};
  on.paint();
  on.project.preview(pose("a", "near=0,0,4", 0));
  on.stage->project_changed();
  ASSERT_EQ(on.pictures.size(), 2u);
  const ViewPicture& next = on.pictures[1];
  EXPECT_FALSE(next.rests);
  EXPECT_LT(next.pixels.size(), 200u * 200);
  EXPECT_EQ(pictures::pixels_in(next.rects), next.pixels.size());
  pictures::paste(next.pixels, next.rects, 200, page.pixels);
  OnStage fresh(on.project.film());
  fresh.view(
      0, 200, 200, "free", "prisms", R"(, "orbit": )" + [&] {
        Json orbit = on.last("orbit");
        return orbit.dump();
      }());
  EXPECT_TRUE(page.pixels == fresh.pictures.at(0).pixels) << "what the page has is the picture";
  on.project.cancel();
  on.stage->project_changed();
  on.paint();
  EXPECT_TRUE(on.pictures.back().rests);
}

TEST(LinePictures, RectanglesCoverWhatDiffersOnce) {
  images::Image before{70, 40, std::vector<std::uint32_t>(70 * 40, 1)}, now = before;
  EXPECT_TRUE(changed_rects(before, now).empty());
  now.pixels[5 * 70 + 3] = 2;
  now.pixels[20 * 70 + 15] = 2;
  now.pixels[39 * 70 + 69] = 2;
  const auto rects = changed_rects(before, now);
  ASSERT_EQ(rects.size(), 2u);
  EXPECT_EQ(rects[0].height, 32);
  EXPECT_EQ(rects[1].x, 64);
  EXPECT_EQ(rects[1].width, 6);
  EXPECT_EQ(rects[1].height, 8);
  EXPECT_EQ(pictures::pixels_in(rects), 16u * 32 + 6 * 8);
}

TEST(LinePictures, ControlVerticesFollowAPulledShape) {
  OnStage on(model_film("robot-arm.json"), true);
  on.view(0, 200, 200, "free", "vertices");
  on.paint();
  on.project.preview(step("model point elbow --patch 0 --at 1 2 --to 2.5 0.3 0.5"));
  on.stage->project_changed();
  ASSERT_EQ(on.pictures.size(), 2u);
  EXPECT_FALSE(on.pictures[1].rects.empty());
}

}  // namespace
}  // namespace mars::studio
