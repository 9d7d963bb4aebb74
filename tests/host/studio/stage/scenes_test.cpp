// What a view asks of the renderer: scenes, inbetweens where they suffice, and nothing while nothing changes.
#include <gtest/gtest.h>

#include <cstring>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/actor_state.h"
#include "host/content/film/compile.h"
#include "host/preview/viewpoint.h"
#include "host/studio/stage/eye.h"
#include "host/studio/stage/screen.h"
#include "tests/host/studio/stage/fakes.h"
#include "tests/host/studio/step_words.h"
#include "tests/render/film_run.h"

namespace mars::studio {
namespace {

// The scene's own parts; its shapes are the film's.
wire::PackedFilm scene_of(const FakeLink::Asked& asked) { return {asked.scene, "scene", true}; }

std::vector<std::uint32_t> moving_of(const FakeLink::Asked& asked) {
  const wire::PackedFilm scene = scene_of(asked);
  const auto moving = scene.moving(scene.intervals().front());
  return {moving.begin(), moving.end()};
}

std::string robot_name(const animator::Film& film) {
  for (const animator::Actor& actor : film.actors)
    for (const modeler::Joint& joint : film.models[actor.model].joints)
      if (joint.name == "elbow") return actor.name;
  return "";
}

Json elbow(const OnStage& on, double angle) {
  return pose(robot_name(on.project.film()), "elbow=0," + std::to_string(angle) + ",0", on.project.frame());
}

void preview(OnStage& on, double angle) {
  on.project.preview(elbow(on, angle));
  on.stage->project_changed();
}

TEST(Scenes, AtRestTheCameraSeesTheFilmsOwnFrame) {
  const animator::Film film = example("robot-arm.json");
  const film::CompiledFilm compiled = film::compile(film);
  const wire::PackedFilm whole = compiled.view();
  for (const std::uint32_t frame : {0u, 17u, 41u, 95u}) {
    OnStage on(film);
    on.project.set_frame(frame);
    on.view(0, int(film.width), int(film.height), "camera", "surface");
    ASSERT_EQ(on.link.asked.size(), 1u);
    ASSERT_TRUE(on.link.asked[0].begins);
    const wire::PackedFilm scene = scene_of(on.link.asked[0]);
    EXPECT_EQ(scene.camera_at(0), whole.camera_at(frame));
    ASSERT_EQ(scene.segments().size(), whole.segments().size());
    for (std::size_t i = 0; i < whole.segments().size(); ++i) {
      EXPECT_EQ(scene.segments()[i].shape, whole.segments()[i].shape);
      EXPECT_EQ(scene.matrix_at(scene.segments()[i], 0), whole.matrix_at(whole.segments()[i], frame)) << i;
      EXPECT_EQ(scene.material_at(scene.segments()[i], 0), whole.material_at(whole.segments()[i], frame)) << i;
    }
    for (const wire::Interval& interval : whole.intervals())
      if (frame >= interval.first_frame && frame < interval.first_frame + interval.frame_count) {
        const auto own = whole.moving(interval);
        EXPECT_EQ(moving_of(on.link.asked[0]), std::vector<std::uint32_t>(own.begin(), own.end()));
      }
    on.answer();
    EXPECT_TRUE(on.pictures.back().exact && on.pictures.back().rests);
  }
}

// Nodes get the film's shapes and the scene; what they draw of them is what `mars render` draws.
TEST(Scenes, DrawnTheyAreTheFilmsFrame) {
  animator::Film film = example("robot-arm.json");
  film.width = 160;
  film.height = 90;
  constexpr std::uint32_t kFrame = 30;
  OnStage on(film);
  on.project.set_frame(kFrame);
  on.view(0, 160, 90, "camera", "surface");
  const wire::PackedFilm shapes(*on.link.films.at(0), "film");
  const wire::PackedFilm scene = scene_of(on.link.asked.at(0));
  wire::FilmData data;
  const auto copy = [](auto& to, const auto& from) { to.assign(from.begin(), from.end()); };
  data.settings = scene.settings();
  copy(data.patches, shapes.patches());
  copy(data.mesh_places, shapes.mesh_places());
  copy(data.mesh_normals, shapes.mesh_normals());
  copy(data.mesh_triangles, shapes.mesh_triangles());
  copy(data.meshlets, shapes.meshlets());
  copy(data.shapes, shapes.shapes());
  copy(data.segments, scene.segments());
  copy(data.materials, scene.materials());
  copy(data.matrices, scene.matrices());
  copy(data.cameras, scene.cameras());
  copy(data.lights, scene.lights());
  copy(data.light_tracks, scene.light_tracks());
  copy(data.changes, scene.changes());
  copy(data.intervals, scene.intervals());
  data.moving = moving_of(on.link.asked[0]);
  for (std::size_t i = 0; i < data.segments.size(); ++i) data.segments[i].name = data.segments[i].material_name = 0;
  data.names = {'x', '\0'};
  const test::FilmRun drawn = test::run_film(wire::pack(data));
  test::RunOptions options;
  options.work.frames = {kFrame};
  const film::CompiledFilm compiled = film::compile(film);
  const test::FilmRun rendered = test::run_film(compiled.block(), options);
  EXPECT_EQ(drawn.frames.at(0), rendered.frames.at(kFrame));
}

TEST(Scenes, AGestureIsOneIntervalAndThenInbetweens) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  on.answer();
  on.paint();
  ASSERT_EQ(on.link.asked.size(), 1u);
  preview(on, 77);
  ASSERT_EQ(on.link.asked.size(), 2u);
  EXPECT_TRUE(on.link.asked[1].begins) << "nothing was to move in the first interval";
  const auto moving = moving_of(on.link.asked[1]);
  EXPECT_GT(moving.size(), 1u);
  EXPECT_LT(moving.size(), scene_of(on.link.asked[1]).segments().size());
  on.answer();
  on.paint();
  EXPECT_FALSE(on.pictures.back().rests);
  for (const double angle : {78.0, 80.0, 90.0}) {
    preview(on, angle);
    ASSERT_FALSE(on.link.asked.back().begins) << angle;
    ASSERT_EQ(on.link.asked.back().segments.size(), moving.size());
    for (std::size_t i = 0; i < moving.size(); ++i) EXPECT_EQ(on.link.asked.back().segments[i].segment, moving[i]);
    on.answer();
    on.paint();
  }
  const std::size_t asked = on.link.asked.size();
  on.project.commit(elbow(on, 90));
  on.stage->project_changed();
  on.paint();
  EXPECT_EQ(on.link.asked.size(), asked) << "what it shows is there already";
  EXPECT_TRUE(on.pictures.back().rests);
  EXPECT_TRUE(on.pictures.back().rects.empty());
  on.paint();
  on.stage->project_changed();
  EXPECT_EQ(on.link.asked.size(), asked) << "after the hand rests nothing is asked for";
}

TEST(Scenes, OnReleaseTheCamerasViewIsTheFilmsOwn) {
  const animator::Film film = example("robot-arm.json");
  OnStage on(film);
  on.project.set_frame(10);
  on.view(0, int(film.width), int(film.height), "camera", "surface");
  on.answer();
  on.paint();
  preview(on, 77);
  on.answer();
  on.paint();
  EXPECT_FALSE(on.pictures.back().exact);
  on.project.commit(elbow(on, 77));
  on.stage->project_changed();
  while (on.link.asked.size() > on.pictures.size()) on.answer();
  EXPECT_TRUE(on.pictures.back().exact && on.pictures.back().rests);
  animator::Film moved = on.project.film();
  const film::CompiledFilm compiled = film::compile(moved);
  const wire::PackedFilm whole = compiled.view();
  const FakeLink::Asked* begun = nullptr;
  for (const FakeLink::Asked& asked : on.link.asked)
    if (asked.begins) begun = &asked;
  for (const wire::Interval& interval : whole.intervals())
    if (interval.first_frame <= 10 && 10 < interval.first_frame + interval.frame_count) {
      const auto own = whole.moving(interval);
      EXPECT_EQ(moving_of(*begun), std::vector<std::uint32_t>(own.begin(), own.end()));
    }
}

TEST(Scenes, TurningTheEyeMovesEverything) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  on.answer();
  on.paint();
  on.take(R"({"do": "orbit", "edit": 7, "view": 0, "by": [12, 3], "how": "turn", "moving": true})");
  ASSERT_TRUE(on.link.asked.back().begins);
  EXPECT_EQ(moving_of(on.link.asked.back()).size(), scene_of(on.link.asked.back()).segments().size());
  on.answer();
  EXPECT_EQ(on.pictures.back().edit, 7u);
  on.paint();
  const std::size_t asked = on.link.asked.size();
  on.take(R"({"do": "orbit", "edit": 8, "view": 0, "by": [0, 0], "how": "turn", "moving": false})");
  EXPECT_EQ(on.link.asked.size(), asked);
  EXPECT_TRUE(on.pictures.back().rests);
  on.paint();
  preview(on, 77);
  EXPECT_TRUE(on.link.asked.back().begins) << "of an interval in which all moves nothing is kept";
  EXPECT_LT(moving_of(on.link.asked.back()).size(), scene_of(on.link.asked.back()).segments().size());
}

// Where nobody has moved the eye; a page sends back what it received.
TEST(Scenes, AModelThatGrowsIsFramedAgain) {
  OnStage on(example("robot-arm.json"), true);
  on.view(0, 320, 200, "front", "surface");
  on.view(1, 320, 200, "free", "surface");
  on.take(R"({"do": "orbit", "edit": 7, "view": 1, "by": [12, 3], "how": "turn", "moving": false})");
  on.view(0, 320, 200, "front", "surface");
  const double before = on.last("orbit")["distance"];
  const auto grow = [&](double times) {
    on.project.change([times](animator::Film& film) {
      for (modeler::Joint& joint : film.models[film.actors.front().model].joints)
        if (joint.segment) joint.segment->sbb = {times * joint.segment->sbb.min, times * joint.segment->sbb.max};
    });
    on.stage->project_changed();
  };
  on.sent.clear();
  grow(1.05);
  EXPECT_TRUE(on.sent.empty() || on.sent.back().second["is"] != "orbit") << "a little more is what a pose does";
  grow(5);
  const Json after = on.last("orbit");
  EXPECT_EQ(after["view"], 0);
  EXPECT_GT(after["distance"].get<double>(), 1.3 * before);
  EXPECT_EQ(
      std::count_if(on.sent.begin(), on.sent.end(), [](const auto& sent) { return sent.second["is"] == "orbit"; }), 1);
}

// From where the eye looks already.
TEST(Scenes, WhatIsSelectedFillsTheView) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  on.take(R"({"do": "orbit", "edit": 7, "view": 0, "by": [120, 30], "how": "turn", "moving": false})");
  const Json before = on.last("orbit");
  const auto selected = [&](const Json& names) {
    Json message = names;
    message["do"] = "select";
    on.take(message.dump());
    on.take(R"({"do": "orbit", "edit": 8, "view": 0, "how": "selected", "moving": false})");
    const Json orbit = on.last("orbit");
    EXPECT_EQ(orbit["turn"], before["turn"]);
    EXPECT_EQ(orbit["height"], before["height"]);
    return orbit;
  };
  const std::string robot = robot_name(on.project.film());
  const Json elbow = selected({{"actor", robot}, {"joint", "elbow"}});
  EXPECT_LT(elbow["distance"].get<double>(), 0.7 * before["distance"].get<double>());
  const auto& joints = on.project.film().models[on.project.film().actors[0].model].joints;
  const animator::ActorState state = animator::state_at(on.project.film(), 0, 0);
  for (std::size_t joint = 0; joint < joints.size(); ++joint) {
    if (joints[joint].name != "elbow") continue;
    const wire::PackedFilm scene = scene_of(on.link.asked.back());
    const Screen screen(scene.camera_at(0), 320, 200);
    glm::dvec2 low(1e9), high(-1e9);
    for (int corner = 0; corner < 8; ++corner) {
      const modeler::Box& box = joints[joint].segment->sbb;
      const glm::dvec3 at(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                          corner & 4 ? box.max.z : box.min.z);
      const auto pixel = screen.pixel_of(state.joints[joint].turn * at + state.joints[joint].place);
      ASSERT_TRUE(pixel);
      low = glm::min(low, *pixel);
      high = glm::max(high, *pixel);
    }
    EXPECT_GE(std::min(low.x, low.y), 0);
    EXPECT_LE(high.x, 320);
    EXPECT_LE(high.y, 200);
    EXPECT_GT(std::max(high.x - low.x, high.y - low.y), 100) << "of 200 pixels";
  }
  EXPECT_GT(selected({{"actor", robot}})["distance"], elbow["distance"]);
  EXPECT_NEAR(selected({{"actor", nullptr}})["distance"].get<double>(), before["distance"].get<double>(), 1e-9);
  on.take(R"({"do": "select", "thing": "camera"})");
  on.view(0, 320, 200, "camera", "surface");
  on.take(R"({"do": "orbit", "edit": 9, "view": 0, "how": "selected", "moving": false})");
  EXPECT_EQ(on.last("orbit")["from"], "free");
}

TEST(Scenes, APictureThatIsBeingDrawnBringsHandlesOfWhatIsSelectedByThen) {
  OnStage on(example("robot-arm.json"));
  const animator::Actor& robot = on.project.film().actors[0];
  const std::string joint = on.project.film().models[robot.model].joints.back().name;
  on.view(0, 320, 200, "free", "surface", R"(, "handles": "move")");
  on.answer();
  on.paint();
  on.project.change([](animator::Film& film) { film.lights[0].intensity = animator::constant(0.25); });
  on.stage->project_changed();  // asked for, with handles of nothing
  on.take(R"({"do": "select", "actor": ")" + robot.name + R"(", "joint": ")" + joint + R"("})");
  on.answer();
  EXPECT_EQ(on.pictures.back().handles, on.last("handles")["shapes"]);
}

TEST(Scenes, AnotherMaterialOrLightIsAnotherInterval) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  on.answer();
  on.paint();
  on.project.change([](animator::Film& film) { film.lights[0].intensity = animator::constant(0.25); });
  on.stage->project_changed();
  ASSERT_TRUE(on.link.asked.back().begins);
  EXPECT_EQ(moving_of(on.link.asked.back()).size(), scene_of(on.link.asked.back()).segments().size());
  on.answer();
  on.paint();
  on.project.change([](animator::Film& film) {
    for (animator::MaterialMotion& material : film.materials)
      material.color = animator::constant(glm::dvec3(0.1, 0.2, 0.3));
  });
  on.stage->project_changed();
  EXPECT_TRUE(on.link.asked.back().begins);
  EXPECT_EQ(on.link.films.size(), 1u) << "shapes are the same";
}

TEST(Scenes, OtherShapesAreLoadedAndPulledOnesAreNot) {
  OnStage on(model_film("robot-arm.json"), true);
  on.view(0, 320, 200, "free", "surface");
  on.answer();
  on.paint();
  ASSERT_EQ(on.link.films.size(), 1u);
  const wire::PackedFilm film(*on.link.films[0], "film");
  const auto pull = [&](double to) {
    return step("model point elbow --patch 0 --at 1 2 --to 0.5 " + std::to_string(to) + " 0.5");
  };
  on.project.preview(pull(0.3));
  on.stage->project_changed();
  ASSERT_TRUE(on.link.asked.back().begins);
  const wire::PackedFilm scene = scene_of(on.link.asked.back());
  EXPECT_EQ(scene.shapes().size(), 1u);
  EXPECT_GT(scene.patches().size(), 0u);
  const auto moving = moving_of(on.link.asked.back());
  ASSERT_EQ(moving.size(), 1u);
  EXPECT_EQ(scene.segments()[moving[0]].shape, film.shapes().size());
  on.answer();
  on.paint();
  on.project.preview(pull(0.4));
  on.stage->project_changed();
  ASSERT_FALSE(on.link.asked.back().begins);
  ASSERT_EQ(on.link.asked.back().patches.size(), 1u);
  EXPECT_EQ(on.link.asked.back().patches[0].points.points[9][1], 0.4f);
  on.answer();
  on.paint();
  on.project.commit(pull(0.4));
  on.stage->project_changed();
  EXPECT_EQ(on.link.films.size(), 2u);
  EXPECT_TRUE(on.link.asked.back().begins);
  EXPECT_EQ(scene_of(on.link.asked.back()).shapes().size(), 0u);
}

TEST(Scenes, AFilmOfManyFramesIsNotCompiled) {
  animator::Film film = example("robot-arm.json");
  film.frames = wire::kMostFrames;
  OnStage on(film);
  on.project.set_frame(50);
  on.view(0, int(film.width), int(film.height), "camera", "surface");
  on.answer();
  EXPECT_FALSE(on.pictures.back().exact) << "nobody knows its intervals at once";
}

TEST(Scenes, AFilmThatShowsNothingLeavesWhatWas) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  on.answer();
  on.paint();
  on.project.change([](animator::Film& film) { film.camera.at = film.camera.eye; });
  on.stage->project_changed();
  EXPECT_NE(on.last("remark").dump().find("has its eye where it looks at"), std::string::npos);
  EXPECT_EQ(on.link.asked.size(), 1u);
}

// The film then has other actors than those that were seen.
TEST(Scenes, NoHandTakesWhatCannotBeShown) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  on.answer();
  on.project.change(
      [](animator::Film& film) {
        film.camera.at = film.camera.eye;
        film.actors.clear();
      },
      true);
  on.stage->project_changed();
  for (const char* message :
       {R"({"do": "hover", "view": 0, "x": 160, "y": 100})", R"({"do": "grab", "view": 0, "x": 160, "y": 100})",
        R"({"do": "orbit", "view": 0, "by": [1, 1], "how": "turn"})"})
    EXPECT_THROW(on.take(message), Failure) << message;
  on.view(1, 320, 200, "free", "stick");
  on.take(R"({"do": "select", "thing": "camera"})");
  on.project.change([&](animator::Film& film) { film.camera = example("robot-arm.json").camera; });
  on.stage->project_changed();
  EXPECT_EQ(on.link.films.size(), 2u) << "its shapes are loaded once it can be shown";
  on.take(R"({"do": "hover", "view": 0, "x": 160, "y": 100})");
}

// ---- flow

TEST(Flow, NewestWinsAndTwoAreOnTheWay) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  on.answer();
  preview(on, 71);
  const std::size_t asked = on.link.asked.size();
  for (const double angle : {72.0, 73.0, 74.0}) preview(on, angle);
  EXPECT_EQ(on.link.asked.size(), asked) << "a picture is under way";
  on.answer();
  EXPECT_EQ(on.link.asked.size(), asked) << "two pictures are not painted yet";
  EXPECT_EQ(on.pictures.size(), 2u);
  on.paint();
  ASSERT_EQ(on.link.asked.size(), asked + 1);
  const FakeLink::Asked& newest = on.link.asked.back();
  ASSERT_FALSE(newest.begins);
  bool shown = false;
  for (std::size_t actor = 0; actor < on.project.film().actors.size(); ++actor)
    for (const auto& matrix : animator::state_at(on.project.film(), actor, 0).segments)
      for (const wire::MovedSegment& moved : newest.segments) shown = shown || (matrix && *matrix == moved.matrix);
  EXPECT_TRUE(shown) << "it shows 74 degrees";
  for (std::size_t i = 0; i < on.pictures.size(); ++i) EXPECT_EQ(on.pictures[i].picture, i + 1);
}

TEST(Flow, EditsComeWithTheirPicture) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface", R"(, "edit": 3)");
  on.answer();
  EXPECT_EQ(on.pictures.back().edit, 3u);
  on.paint();
  on.project.preview(elbow(on, 77));
  on.take(R"({"do": "preview", "edit": 4})");
  on.take(R"({"do": "preview", "edit": 5})");
  on.answer();
  EXPECT_EQ(on.pictures.back().edit, 4u) << "it was asked for before the fifth";
}

TEST(Flow, TheHandsViewComesFirst) {
  OnStage on(example("robot-arm.json"));
  for (int view = 0; view < 4; ++view) on.view(view, 320, 200, view == 3 ? "free" : "front", "surface");
  for (std::size_t i = 0; i < 4; ++i) on.answer(FakeLink::Asked(on.link.asked[i]), 320, 200);
  on.paint();
  const std::size_t before = on.link.asked.size();
  on.take(R"({"do": "select", "actor": ")" + robot_name(on.project.film()) + R"(", "joint": "elbow"})");
  // Somewhere on the robot, in the last view.
  Json grabbed;
  for (int y = 20; y < 200 && !grabbed.contains("joint"); y += 4)
    for (int x = 20; x < 300; x += 4) {
      on.take(R"({"do": "hover", "view": 3, "x": )" + std::to_string(x) + R"(, "y": )" + std::to_string(y) + "}");
      if (on.last("hovered")["joint"] != "elbow") continue;
      on.take(R"({"do": "grab", "view": 3, "x": )" + std::to_string(x) + R"(, "y": )" + std::to_string(y) + "}");
      grabbed = on.last("grabbed");
      on.take(R"({"do": "drag", "x": )" + std::to_string(x + 9) + R"(, "y": )" + std::to_string(y + 5) + "}");
      break;
    }
  ASSERT_EQ(grabbed["joint"], "elbow");
  ASSERT_EQ(on.link.asked.size(), before + 2) << "the hand's, and one of the others";
  EXPECT_EQ(on.link.asked[before].view, 3u);
}

TEST(Flow, AHandDoesNotWaitForAPictureOfRest) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  preview(on, 77);
  ASSERT_EQ(on.link.asked.size(), 2u);
  EXPECT_TRUE(on.link.asked[1].begins);
  on.stage->surface_dropped(0, on.link.asked[0].picture);
  EXPECT_EQ(on.link.asked.size(), 2u) << "nobody waits for it";
  on.answer(FakeLink::Asked(on.link.asked[0]), 320, 200);
  EXPECT_TRUE(on.pictures.empty()) << "nor is it shown";
  on.answer();
  EXPECT_EQ(on.pictures.size(), 1u);
}

TEST(Flow, WhatWasDroppedIsAskedForAgain) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  on.stage->surface_dropped(0, on.link.asked[0].picture);
  ASSERT_EQ(on.link.asked.size(), 2u);
  EXPECT_TRUE(on.link.asked[1].begins);
  on.answer();
  on.paint();
  preview(on, 77);
  on.answer();
  on.paint();
  preview(on, 78);
  ASSERT_FALSE(on.link.asked.back().begins);
  const std::size_t asked = on.link.asked.size();
  on.stage->surface_dropped(0, on.link.asked.back().picture);
  ASSERT_EQ(on.link.asked.size(), asked + 1);
  EXPECT_FALSE(on.link.asked.back().begins) << "the interval is as it was";
}

TEST(Flow, ClosedPagesCloseTheirViews) {
  OnStage on(example("robot-arm.json"));
  on.view(0, 320, 200, "free", "surface");
  on.view(1, 320, 200, "front", "prisms");
  on.stage->page_closed(1);
  EXPECT_EQ(on.link.closed, (std::vector<std::uint32_t>{0}));
}

TEST(Flow, WhatTheProjectObeysIsNotRefused) {
  OnStage on(example("robot-arm.json"));
  for (const char* text :
       {R"({"do": "undo"})", R"({"do": "redo"})", R"({"do": "cancel"})", R"({"do": "frame", "edit": 2})"})
    EXPECT_NO_THROW(on.take(text)) << text;
}

TEST(Flow, NonsenseIsRefused) {
  OnStage on(example("robot-arm.json"));
  for (
      const char* text :
      {R"([])", R"({})", R"({"do": 3})", R"({"do": "dance"})", R"({"do": "dance", "edit": 3})",
       R"({"do": "view", "view": 8})",
       R"({"do": "view", "view": 0, "width": 15, "height": 99, "from": "front", "as": "surface"})",
       R"({"do": "view", "view": 0, "width": 99, "height": 4097, "from": "front", "as": "surface"})",
       R"({"do": "view", "view": 0, "width": 99, "height": 99, "from": "behind", "as": "surface"})",
       R"({"do": "view", "view": 0, "width": 99, "height": 99, "from": "free", "as": "surface", "orbit": {"center": 3}})",
       R"({"do": "painted", "view": 0, "picture": 1})", R"({"do": "grab", "view": 0, "x": 1, "y": 1})",
       R"({"do": "select", "actor": "nobody"})", R"({"do": "view", "edit": -1})"})
    EXPECT_THROW(on.take(text), Failure) << text;
  EXPECT_TRUE(on.link.asked.empty());
}

}  // namespace
}  // namespace mars::studio
