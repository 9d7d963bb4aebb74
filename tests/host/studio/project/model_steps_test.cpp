// Steps of models: what is written is what `mars model` writes; mirrors, points, bodies; what nodes must receive again.
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "host/content/animator/pose/actor_state.h"
#include "host/content/modeler/edit.h"
#include "host/content/modeler/model_file.h"
#include "host/content/modeler/proportions.h"
#include "host/content/modeler/scale_model.h"
#include "tests/host/studio/project/open_files.h"

namespace mars::studio {
namespace {

class ModelSteps : public OpenFiles {
 protected:
  // As the command would change a copy of the file.
  template <typename Change>
  std::string by_command(Change change) const {
    write("copy.json", text("pip.json"));
    modeler::change_model(path("copy.json"), [&](document::Json& model, const modeler::Model&) { change(model); });
    return text("copy.json");
  }

  const modeler::Joint& joint(const Project& project, const std::string& name) const {
    for (const modeler::Joint& each : project.film().models[0].joints)
      if (each.name == name) return each;
    throw Failure("is not in the model", name, "");
  }
};

TEST_F(ModelSteps, AJointsStepWritesWhatTheCommandWrites) {
  const auto project = open("pip.json");
  modeler::JointChange change;
  change.joint["place"] = {0, 0.5, -0.125};
  change.limits = {{'x', {-20, 20}}};
  change.segment = {{"shape", "cone"}, {"top", 0.5}, {"sbb", {{-1, -2, -3}, {1, 2, 3.5}}}};
  change.reset = {"axes"};
  const std::string expected = by_command([&](Json& model) { modeler::set_joint(model, "left-leg", change); });
  const Json wanted = step(
      "model set left-leg --place 0 0.5 -0.125 --limits x -20 20 --shape cone --with top=0.5 --sbb -1 -2 -3 1 2 3.5 "
      "--reset axes");
  project->preview(wanted);
  EXPECT_EQ(joint(*project, "left-leg").limits[0].upper, 20);
  EXPECT_EQ(text("pip.json"), kPip);
  project->commit(wanted);
  EXPECT_EQ(text("pip.json"), expected);
  EXPECT_EQ(project->describe()["undo"], "change left-leg's place and limits and shape and box and axes");
}

TEST_F(ModelSteps, OtherStepsWriteWhatTheCommandsWrite) {
  const auto project = open("pip.json");
  modeler::JointChange tail;
  tail.joint["parent"] = "hip";
  tail.segment["shape"] = "cone";
  tail.freedom = modeler::Freedom::fixed;
  tail.limb = "spine";
  modeler::JointChange renamed;
  renamed.name = "leg";
  const Json blue{{"color", {0, 0, 1}}, {"specular", 0.25}};
  modeler::Proportions larger;
  larger.joints = {{"left-*", false, {1, 1, 2}}};
  const std::pair<Json, std::function<void(Json&)>> cases[] = {
      {step("model add tail --parent hip --shape cone --fixed --limb spine"),
       [&](Json& model) { modeler::add_joint(model, "tail", tail); }},
      {step("model set left-leg --name leg"), [&](Json& model) { modeler::set_joint(model, "left-leg", renamed); }},
      {step("model add --material blue --color 0 0 1 --specular 0.25"),
       [&](Json& model) { modeler::add_material(model, "blue", blue); }},
      {step("model set --material red --color 0 0 1 --specular 0.25 --name rose"),
       [&](Json& model) { modeler::set_material(model, "red", blue, "rose"); }},
      {step("model remove --material blue"), [](Json& model) { modeler::remove_material(model, "blue"); }},
      {step("model scale 1 1 2 --joint left-*"),
       [&](Json& model) { modeler::scale_model(model, modeler::load_own_model(path("pip.json")), larger); }},
      {step("model remove left-foot"), [](Json& model) { modeler::remove_joint(model, "left-foot", false); }}};
  for (const auto& [each, change] : cases) {
    const std::string expected = by_command(change);
    project->commit(each);
    EXPECT_EQ(text("pip.json"), expected) << each;
  }
}

TEST_F(ModelSteps, TheOtherSideIsMadeAndChangedAsInAMirror) {
  const auto project = open("pip.json");
  project->commit(step("model mirror left"));
  EXPECT_TRUE(holds(text("pip.json"), R"("right": {"knee": "right-leg"})")) << text("pip.json");
  const modeler::Joint leg = joint(*project, "right-leg");
  EXPECT_EQ(leg.place, glm::dvec3(0, -0.5, 0));
  EXPECT_EQ(leg.limits[0].lower, -30);
  EXPECT_EQ(leg.limits[0].upper, 10);
  EXPECT_EQ(leg.limits[1].upper, 90);
  EXPECT_EQ(leg.segment->sbb.min, glm::dvec3(-0.1, -0.3, -1));
  EXPECT_EQ(project->film().models[0].shapes[joint(*project, "right-foot").segment->shape].name, "right_hand");
  EXPECT_FALSE(project->take_remarks().empty());
  // In mirrored poses every corner of every segment stands mirrored.
  project->commit(Json{{"pose",
                        {{"left-leg", {20, 30, 0}},
                         {"right-leg", {-20, 30, 0}},
                         {"left-foot", {0, 0, 20}},
                         {"right-foot", {0, 0, -20}}}}});
  const auto state = animator::state_at(project->film(), 0, 0);
  const auto& joints = project->film().models[0].joints;
  const auto corner = [](const wire::Matrix& matrix, double x, double y, double z) {
    glm::dvec3 at;
    for (int row = 0; row < 3; ++row) {
      const auto& m = matrix.m[static_cast<std::size_t>(row)];
      at[row] = m[0] * x + m[1] * y + m[2] * z + m[3];
    }
    return at;
  };
  for (const auto& [left, right] : {std::pair{"left-leg", "right-leg"}, {"left-foot", "right-foot"}}) {
    std::size_t one = 0, two = 0;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (joints[i].name == left) one = i;
      if (joints[i].name == right) two = i;
    }
    for (int c = 0; c < 8; ++c) {
      const glm::dvec3 a = corner(*state.segments[one], c & 1, (c >> 1) & 1, c >> 2);
      const glm::dvec3 b = corner(*state.segments[two], c & 1, 1 - ((c >> 1) & 1), c >> 2);
      EXPECT_NEAR(a.x, b.x, 1e-12);
      EXPECT_NEAR(a.y, -b.y, 1e-12);
      EXPECT_NEAR(a.z, b.z, 1e-12);
    }
  }
  project->commit(step("model mirror right"));
  const std::string mirrored = text("pip.json");
  project->commit(step("model mirror left"));
  EXPECT_EQ(text("pip.json"), mirrored) << "a mirrored figure's mirror image is itself";
}

TEST_F(ModelSteps, JointsWithoutSideWordsAreFoundWhereTheyStand) {
  write("crab.json", R"({"joints": [{"name": "shell"}, {"name": "arm", "parent": "shell", "place": [1, 1, 0]},
    {"name": "claw", "parent": "arm", "place": [1, 0, 0]}, {"name": "other", "parent": "shell", "place": [1, -1, 0]}]})");
  const auto project = open("crab.json");
  project->commit(step("model set arm --limits z -10 20"));
  project->commit(step("model mirror left arm"));
  EXPECT_EQ(joint(*project, "other").limits[2].lower, -20);
  EXPECT_EQ(joint(*project, "right-claw").parent, 3u);
  EXPECT_TRUE(holds(refusal([&] { project->commit(step("model mirror left shel")); }), "side"));
}

TEST_F(ModelSteps, OwnShapesAreMirroredToo) {
  write("own.json", R"({"shapes": {
      "sail": {"bspline": {"points": [[[0, 0, 0], [0.5, 0.25, 0], [1, 0, 0], [0.5, 0, 0.5]], [[0, 0.25, 1], [0.5, 0, 1], [1, 0, 1], [0.5, 1, 1]]],
               "u": {"degree": 2, "ends": "periodic"}, "v": {"degree": 1}}},
      "stone": {"mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0.5, 0.5, 1]], "faces": [[2, 1, 0], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}}},
    "joints": [{"name": "a"}, {"name": "left-a", "parent": "a", "segment": {"shape": "sail"}},
               {"name": "left-b", "parent": "a", "segment": {"shape": "stone"}}]})");
  const auto project = open("own.json");
  project->commit(step("model mirror left"));
  const modeler::Model& model = project->film().models[0];
  const modeler::Shape& sail = model.shapes[joint(*project, "left-a").segment->shape];
  const modeler::Shape& mirrored = model.shapes[joint(*project, "right-a").segment->shape];
  EXPECT_EQ(mirrored.name, "sail-mirrored");
  ASSERT_EQ(sail.patches.size(), mirrored.patches.size());
  std::set<std::array<float, 3>> points, images;
  for (std::size_t i = 0; i < sail.patches.size(); ++i)
    for (std::size_t point = 0; point < 16; ++point) {
      auto at = sail.patches[i].points[point];
      at[1] = 1 - at[1];
      for (float& each : at) each = std::round(each * 1e5f);
      points.insert(at);
      auto image = mirrored.patches[i].points[point];
      for (float& each : image) each = std::round(each * 1e5f);
      images.insert(image);
    }
  EXPECT_EQ(points, images);
  const auto& stone = *model.shapes[joint(*project, "right-b").segment->shape].mesh;
  EXPECT_EQ(stone.vertices[2], (modeler::Mesh::Place{1, 0, 0}));
  EXPECT_EQ(stone.corners[0], 0u);
}

TEST_F(ModelSteps, APulledPointTakesItsNeighboursAlong) {
  const auto project = open("pip.json");
  const auto pull = [](double z) { return step("model point hip --at 0 0 --to 0.1 0.1 " + std::to_string(z)); };
  const auto points = project->control_points("hip");
  ASSERT_EQ(points.size(), 6u * 16);
  const auto own = project->shapes_revision();
  project->preview(pull(0.2));
  project->preview(pull(0.3));
  ASSERT_TRUE(project->pulled());
  EXPECT_EQ(project->shapes_revision(), own);
  EXPECT_EQ(project->film().models[0].shapes[project->pulled()->shape].name, "hip-shape");
  std::size_t moved = 0;
  for (const auto& point : project->control_points("hip"))
    moved += glm::length(point.place - glm::dvec3(0.1, 0.1, 0.3)) < 1e-6 ? 1 : 0;
  EXPECT_EQ(moved, 3u) << "three sides of a box meet in a corner";
  EXPECT_THROW(project->commit(pull(7)), Failure) << "a point lies in the box";
  project->commit(pull(1));
  EXPECT_FALSE(project->pulled());
  EXPECT_GT(project->shapes_revision(), own);
  EXPECT_TRUE(holds(text("pip.json"), R"("shape": "hip-shape")"));
  EXPECT_TRUE(holds(text("pip.json"), "[0.1, 0.1, 1]"));
  const auto after = project->shapes_revision();
  project->preview(pull(0.5));
  EXPECT_EQ(project->shapes_revision(), after);
  EXPECT_TRUE(project->pulled());
  project->cancel();
  EXPECT_EQ(project->shapes_revision(), after);
  EXPECT_FALSE(project->pulled());
}

TEST_F(ModelSteps, PointsOfBSplinesArePulledThemselves) {
  write("sail.json", R"({"shapes": {"sail": {"bspline": {"points": [[[0, 0, 0], [1, 0, 0]], [[0, 0, 1], [1, 0, 1]]],
      "u": {"degree": 1}, "v": {"degree": 1}}}}, "joints": [{"name": "mast", "segment": {"shape": "sail"}}]})");
  const auto project = open("sail.json");
  ASSERT_EQ(project->control_points("mast").size(), 4u);
  project->commit(step("model point mast --at 1 0 --to 0.5 0.5 0"));
  EXPECT_TRUE(holds(text("sail.json"), "[[0, 0, 0], [0.5, 0.5, 0]]")) << text("sail.json");
  refusal([&] { project->commit(step("model point mast --at 2 0 --to 0 0 0")); });
}

TEST_F(ModelSteps, ANewModelBeginsAsAnyBody) {
  const auto project = open("new.json");
  EXPECT_TRUE(project->is_model());
  EXPECT_EQ(project->film().models[0].joints[0].name, "body");
  EXPECT_FALSE(std::filesystem::exists(path("new.json")));
  const Json bodies = project->describe()["bodies"];
  EXPECT_GE(bodies.size(), 5u);
  for (const Json& body : bodies) {
    project->commit(step("model new --figure " + body["name"].get<std::string>() + " --replace"));
    EXPECT_GT(project->film().models[0].joints.size(), 10u) << body;
    modeler::load_own_model(path("new.json"));
  }
  EXPECT_TRUE(holds(refusal([&] { project->commit(step("model new --figure child")); }), "is open already"));
  project->commit(step("model new --figure child --height 1.25 --replace"));
  const auto bounds = modeler::rest_bounds(project->film().models[0]);
  EXPECT_NEAR(bounds->max.z - bounds->min.z, 1.25, 2e-3);
  EXPECT_TRUE(holds(refusal([&] { project->commit(step("model new --figure chield --replace")); }), "child"));
  while (project->describe()["undo"].is_string()) project->undo();
  EXPECT_EQ(project->film().models[0].joints.size(), 1u);
}

TEST_F(ModelSteps, FilesElsewhereAreNotRead) {
  const auto project = open("pip.json");
  for (const char* words : {"model new --replace --from ../secret.json", "model new --replace --from /etc/passwd"})
    EXPECT_TRUE(holds(refusal([&] { project->commit(step(words)); }), "below")) << words;
  for (const char* words : {"film add ball --model ball", "animate check", "render pip.json"})
    refusal([&] { project->commit(step(words)); });
  EXPECT_EQ(text("pip.json"), kPip);
}

TEST_F(ModelSteps, PosesAreShownAndInNoFile) {
  const auto project = open("pip.json");
  const Json pose = Json{{"pose", {{"head", {0, 99, 0}}}}};
  project->preview(pose);
  EXPECT_EQ(project->describe_poses()["actors"][0]["joints"][1], Json::parse("[0, 40, 0]"));
  project->cancel();
  EXPECT_EQ(project->describe_poses()["actors"][0]["joints"][1], Json::parse("[0, 0, 0]"));
  project->commit(pose);
  EXPECT_EQ(text("pip.json"), kPip);
  EXPECT_EQ(project->describe()["undo"], Json());
  project->commit(step("model set head --limits y -30 20"));
  EXPECT_EQ(project->describe_poses()["actors"][0]["joints"][1], Json::parse("[0, 20, 0]"));
}

TEST_F(ModelSteps, NodesNeedTheFilmAgainWhereSegmentsChangeOnly) {
  const auto project = open("pip.json");
  const auto revision = project->shapes_revision();
  project->commit(step("model set --material red --color 0 1 0"));
  project->commit(step("model set hip --sbb -1 -1 0 1 1 2"));
  EXPECT_EQ(project->shapes_revision(), revision);
  project->preview(step("model set hip --shape sphere"));
  EXPECT_GT(project->shapes_revision(), revision);
}

TEST_F(ModelSteps, ADerivedModelSaysWhoseJointsItHas) {
  write("kid.json", R"({"from": "pip.json", "proportions": {"scale": 0.5}})");
  const auto project = open("kid.json");
  EXPECT_TRUE(holds(refusal([&] { project->commit(step("model set hip --place 0 0 2")); }), "pip.json"));
  project->commit(step("model scale 1.5 --branch head"));
  EXPECT_TRUE(holds(text("kid.json"), R"("branches": {"head": 1.5})"));
}

TEST_F(ModelSteps, ThePageSeesAllThatCanBeChanged) {
  const Json json = open("pip.json")->describe();
  EXPECT_EQ(json["kind"], "model");
  const Json& leg = json["actors"][0]["joints"][2];
  EXPECT_EQ(leg["options"], Json::parse(R"({"ends": 0.2})"));
  EXPECT_EQ(leg["sbb"], Json::parse("[[-0.1, -0.2, -1], [0.1, 0.3, 0]]"));
  EXPECT_EQ(leg["limb"], "left.knee");
  EXPECT_EQ(json["materials"][0]["name"], "red");
  for (const Json& shape : json["shapes"])
    if (shape["name"] == "torus") {
      EXPECT_EQ(shape["options"][0]["range"], Json::parse("[0.001, 0.2499]"));
    }
}

}  // namespace
}  // namespace mars::studio
