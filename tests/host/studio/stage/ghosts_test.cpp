// Ghosts of figures at other frames and the way of a joint: their polygons, order, clipping and time.
#include "host/studio/stage/ghosts.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <set>

#include "host/studio/stage/eye.h"
#include "tests/host/content/film/small_film.h"
#include "tests/host/studio/stage/fakes.h"
#include "tests/processor_time.h"
#include "tests/sanitizers/sanitized.h"

namespace mars::studio {
namespace {

constexpr const char* kOrbit = R"(, "orbit": {"center": [1.5, 0, 0], "turn": -90, "height": 0, "distance": 9})";

// A box that slides along x by 1/8 a frame, a rod on it that turns about y, and a post that stands.
animator::Film slider() {
  return film::film_of(R"({"frames": 25, "size": [640, 480], "camera": {"eye": [1, -9, 2], "at": [1, 0, 0]},
    "models": {"box": {"joints": [
      {"name": "body", "segment": {"shape": "box", "sbb": [[0, -0.5, 0], [1, 0.5, 1]]}},
      {"name": "rod", "parent": "body", "place": [1, 0, 1], "limits": {"y": [-90, 90]},
       "segment": {"shape": "box", "sbb": [[0, -0.1, -0.1], [2, 0.1, 0.1]]}}]},
      "post": {"joints": [{"name": "post", "segment": {"shape": "box"}}]}},
    "actors": [{"name": "post", "model": "post", "place": [0, 2, 0]},
      {"name": "box", "model": "box", "keys": [
        {"frame": 0, "place": [0, 0, 0], "pose": {"rod": [0, 0, 0]}},
        {"frame": 16, "place": [2, 0, 0], "pose": {"rod": [0, 80, 0]}},
        {"frame": 24, "place": [2, 0, 0]}]}]})");
}

struct GhostScene : OnStage {
  GhostScene() : OnStage(slider()) { project.set_frame(8); }

  void show(const std::string& ghosts) {
    view(0, kViewWidth, kViewHeight, "free", "stick", kOrbit + (", \"ghosts\": " + ghosts));
    if (pictures.empty()) return;
    paint();
  }
  Screen screen() const { return {camera_from({From::free, {{1.5, 0, 0}, -90, 0, 9}}, 1), kViewWidth, kViewHeight}; }
  std::set<std::string> ghost_texts() const {
    std::set<std::string> texts;
    const Json sent_last = last("handles");
    const Json& all = sent_last.is_object() ? sent_last["shapes"] : pictures.back().handles;
    for (const Json& shape : all)
      if (shape["kind"] == "ghost") texts.insert(shape["text"]);
    return texts;
  }
};

Polyline polygon_of(const Json& shape) {
  Polyline polygon;
  for (const Json& point : shape["points"]) polygon.emplace_back(point[0].get<double>(), point[1].get<double>());
  return polygon;
}

Polyline corners_seen(const Screen& screen, const glm::dvec3& low, const glm::dvec3& high) {
  Polyline pixels;
  for (int corner = 0; corner < 8; ++corner)
    pixels.push_back(
        screen.pixel_of({corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z})
            .value());
  return convex_hull(pixels);
}

double area_of(const Polyline& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 one = polygon[i], other = polygon[(i + 1) % polygon.size()];
    area += (one.x * other.y - one.y * other.x) / 2;
  }
  return area;
}

TEST(Ghosts, AreTheOutlinesOfTheSegmentsAtOtherFrames) {
  GhostScene scene;
  scene.take(R"({"do": "select", "actor": "box", "joint": null})");
  scene.show(R"({"before": 1, "after": 1, "step": 4})");
  EXPECT_EQ(scene.ghost_texts(), (std::set<std::string>{"-4", "4"}));
  for (const auto& [id, x] : {std::pair("ghost:-4", 0.5), {"ghost:4", 1.5}}) {
    ASSERT_EQ(scene.shapes(id).size(), 2u) << id;
    const Polyline expected = corners_seen(scene.screen(), {x, -0.5, 0}, {x + 1, 0.5, 1});
    double nearest = 1e9;
    for (const Json& shape : scene.shapes(id)) {
      const Polyline polygon = polygon_of(shape);
      if (polygon.size() != expected.size()) continue;
      double farthest = 0;
      for (std::size_t i = 0; i < polygon.size(); ++i) farthest = std::max(farthest, distance_to(polygon, expected[i]));
      nearest = std::min(nearest, farthest);
    }
    EXPECT_LT(nearest, 0.08) << id << ": the body's box";
  }
}

TEST(Ghosts, OfNobodySelectedAreThoseThatMove) {
  GhostScene scene;
  scene.show(R"({"before": 2, "after": 0, "step": 3})");
  EXPECT_EQ(scene.ghost_texts(), (std::set<std::string>{"-3", "-6"}));
  EXPECT_EQ(scene.shapes("ghost:-3").size(), 2u) << "the post stands";
  EXPECT_TRUE(scene.shapes("trail").empty());
  scene.take(R"({"do": "select", "actor": "post", "joint": null})");
  EXPECT_TRUE(scene.ghost_texts().empty());
  scene.show("null");
  scene.take(R"({"do": "select", "actor": "box", "joint": null})");
  EXPECT_TRUE(scene.ghost_texts().empty());
}

TEST(Ghosts, EndWithTheFilmAndLeaveOutWhatStandsWhereItIs) {
  GhostScene scene;
  scene.take(R"({"do": "select", "actor": "box", "joint": null})");
  scene.project.set_frame(24);
  scene.show(R"({"before": 2, "after": 3, "step": 8})");
  EXPECT_EQ(scene.ghost_texts(), (std::set<std::string>{"-16"})) << "frame 16 is as 24";
}

TEST(Ghosts, AreDrawnBackToFrontBelowAllOthers) {
  GhostScene scene;
  scene.take(R"({"do": "select", "actor": "box", "joint": "rod"})");
  scene.view(0, kViewWidth, kViewHeight, "free", "stick",
             R"(, "orbit": {"center": [1, 0, 0], "turn": 0, "height": 0, "distance": 9}, "handles": "turn",
                  "ghosts": {"before": 1, "after": 1, "step": 4})");
  const Json shapes = scene.pictures.back().handles;
  std::vector<std::string> order;
  for (const Json& shape : shapes) order.push_back(shape["kind"]);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end(), [](const std::string& one, const std::string& two) {
    const auto rank = [](const std::string& kind) { return kind == "ghost" ? 0 : kind == "trail" ? 1 : 2; };
    return rank(one) < rank(two);
  }));
  EXPECT_EQ(shapes[0]["text"], "-4") << "seen from +x, what is farther back along x comes first";
  EXPECT_TRUE(std::ranges::find(order, "ring") != order.end());
}

TEST(Ghosts, TheTrailIsTheWayOfTheJointsEndWithATickAFrame) {
  GhostScene scene;
  scene.take(R"({"do": "select", "actor": "box", "joint": "rod"})");
  scene.show(R"({"before": 2, "after": 2, "step": 4})");
  std::map<std::string, Json> ticks;
  std::size_t line = 0;
  for (const Json& shape : scene.shapes("trail")) {
    if (shape["points"].size() == 1)
      ticks[shape["text"].get<std::string>()] = shape;
    else
      line += shape["points"].size();
  }
  EXPECT_EQ(line, 17u);
  ASSERT_EQ(ticks.size(), 17u);
  for (const int frame : {0, 3, 8, 16}) {
    const animator::ActorState state = animator::state_at(scene.project.film(), 1, std::uint32_t(frame));
    const glm::dvec2 end =
        scene.screen().pixel_of(state.joints[1].turn * glm::dvec3(2, 0, 0) + state.joints[1].place).value();
    const Json& tick = ticks.at(std::to_string(frame - 8));
    EXPECT_LT(glm::length(polygon_of(tick)[0] - end), 0.08) << frame;
    EXPECT_EQ(tick.contains("selected"), frame == 0 || frame == 16) << frame;
  }
}

TEST(Ghosts, AreCutAtTheEye) {
  const Screen screen(camera_from({From::free, {{0, 0, 0}, -90, 0, 2}}, 1), 200, 100);
  // A beam from far ahead to behind the eye at y = -2.
  std::vector<glm::dvec3> beam;
  for (const double y : {4.0, -6.0})
    for (const double x : {-0.2, 0.2})
      for (const double z : {-0.3, -0.2}) beam.emplace_back(x, y, z);
  const Polyline cut = screen.outline(beam);
  ASSERT_GE(cut.size(), 3u);
  for (const glm::dvec2& pixel : cut) EXPECT_GT(pixel.y, 50) << "all of it is below the eye";
  EXPECT_GT(area_of(cut), 0);
  EXPECT_TRUE(screen.outline(std::vector<glm::dvec3>{{0, -3, 0}, {1, -3, 0}, {0, -3, 1}}).empty()) << "behind";
  EXPECT_TRUE(screen.outline(std::vector<glm::dvec3>{{9, 0, 0}, {9.5, 0, 0}, {9, 0, 1}}).empty()) << "beside";
}

TEST(Ghosts, AreNotOfAFilmThatShowsNothing) {
  GhostScene scene;
  scene.take(R"({"do": "select", "actor": "box", "joint": null})");
  scene.show(R"({"before": 1, "after": 1, "step": 4})");
  ASSERT_FALSE(scene.ghost_texts().empty());
  scene.project.change([](animator::Film& film) {
    film.actors.push_back(film.actors[1]);
    film.actors[2].name = "more";
    film.camera.eye = film.camera.at;
  });
  scene.stage->project_changed();
  scene.take(R"({"do": "select", "actor": "more", "joint": null})");
  EXPECT_TRUE(scene.ghost_texts().empty());
}

TEST(Ghosts, AFiguresFourTakeLittleTime) {
  FakeProject project(example("demo.json"));
  project.set_frame(20);
  Moments moments(project);
  moments.renew();
  Ghosts ghosts(project, moments);
  Selection selection;
  for (std::size_t actor = 0; actor < project.film().actors.size(); ++actor)
    if (project.film().models[project.film().actors[actor].model].joints.size() > 12) selection.actor = actor;
  ASSERT_TRUE(selection.actor);
  selection.joint = 5;
  const Screen screen(moments.now().cameras.front(), 1280, 720);
  const auto count = ghosts.handles(0, {2, 2, 4}, selection, screen).size();
  EXPECT_GT(count, 30u);
  double least = 1e9;
  for (int i = 0; i < 20; ++i) {
    project.change([](animator::Film&) {});
    moments.renew();
    const test::ProcessorTime time;
    const Json shapes = described(ghosts.handles(0, {2, 2, 4}, selection, screen), "");
    EXPECT_EQ(shapes.size(), count);
    least = std::min(least, time.seconds());
  }
  EXPECT_LT(described(ghosts.handles(0, {2, 2, 4}, selection, screen), "").dump().size(), 40'000u);
  EXPECT_LT(least, 0.02 * sanitizers::kSlowness) << "of one or two milliseconds";
}

}  // namespace
}  // namespace mars::studio
