// Undo and redo: over any steps, back to the first byte and forward again, over a restart, shared by two.
#include <random>

#include "tests/host/studio/project/open_files.h"

namespace mars::studio {
namespace {

using Histories = OpenFiles;

Json random_film_step(std::mt19937& random, std::uint32_t frame) {
  const auto number = [&](int least, int most) { return std::uniform_int_distribution(least, most)(random); };
  const char* const actors[] = {"one", "two"};
  const char* const joints[] = {"hip", "head", "left-leg", "left-foot"};
  std::string vector = std::to_string(number(-60, 60));
  for (int axis = 1; axis < 3; ++axis) vector += "," + std::to_string(number(-60, 60));
  const char* const actor = actors[number(0, 1)];
  switch (number(0, 3)) {
    case 0: return pose(actor, "place=" + vector, frame);
    case 1: return pose(actor, "turn=" + vector, frame);
    case 2: return pose("camera", "fov=" + std::to_string(number(10, 90)), frame);
    default: return pose(actor, std::string(joints[number(0, 3)]) + "=" + vector, frame);
  }
}

Json random_model_step(std::mt19937& random) {
  const auto number = [&](int least, int most) {
    return std::to_string(std::uniform_int_distribution(least, most)(random));
  };
  const char* const joints[] = {"hip", "head", "left-leg", "left-foot"};
  const char* const shapes[] = {"box", "sphere", "cone"};
  const std::string joint = joints[random() % 4];
  switch (random() % 6) {
    case 0: return step("model set " + joint + " --place " + number(0, 9) + " " + number(0, 9) + " 1");
    case 1: return step("model set " + joint + " --shape " + shapes[random() % 3]);
    case 2: return step("model set " + joint + " --limits x " + number(-90, 0) + " 90");
    case 3: return step("model set --material red --color 0." + number(0, 9) + " 0 1");
    case 4: return step("model mirror left");
    default: return step("model add j" + std::to_string(random()) + " --parent " + joint);
  }
}

TEST_F(Histories, TwoHundredStepsGoBackToTheFirstByteAndForwardAgain) {
  std::mt19937 random(17);
  for (const char* name : {"film.json", "pip.json"}) {
    auto project = open(name);
    std::vector<std::string> texts{text(name)};
    while (texts.size() <= 200) {
      if (!project->is_model()) project->set_frame(static_cast<std::uint32_t>(random() % 48));
      project->commit(project->is_model() ? random_model_step(random) : random_film_step(random, project->frame()));
      if (text(name) != texts.back()) texts.push_back(text(name));
    }
    for (std::size_t i = texts.size() - 1; i-- > 0;) {
      if (i % 50 == 0) project = open(name);  // a restart
      project->undo();
      ASSERT_EQ(text(name), texts[i]);
    }
    EXPECT_EQ(project->describe()["undo"], Json());
    project->undo();
    for (std::size_t i = 1; i < texts.size(); ++i) {
      if (i % 50 == 0) project = open(name);
      project->redo();
      ASSERT_EQ(text(name), texts[i]);
    }
    EXPECT_EQ(project->describe()["redo"], Json());
    project->redo();
    EXPECT_EQ(text(name), texts.back());
  }
}

TEST_F(Histories, AfterAnUndoAnotherStepCutsWhatCouldBeRedone) {
  const auto project = open("pip.json");
  project->commit(step("model set hip --place 1 0 0"));
  project->undo();
  EXPECT_EQ(text("pip.json"), kPip);
  EXPECT_EQ(project->describe()["redo"], "change hip's place");
  project->commit(step("model remove head"));
  EXPECT_EQ(project->describe()["redo"], Json());
  EXPECT_EQ(project->describe()["undo"], "remove head");
  EXPECT_EQ(open("pip.json")->describe()["undo"], "remove head");
}

TEST_F(Histories, UndoDuringAGestureGivesTheGestureUp) {
  const auto project = open("pip.json");
  project->commit(step("model remove head"));
  project->preview(step("model set hip --place 1 0 0"));
  project->undo();
  EXPECT_FALSE(project->in_gesture());
  EXPECT_EQ(text("pip.json"), kPip);
  EXPECT_EQ(project->film().models[0].joints.size(), 4u);
}

TEST_F(Histories, TwoStudiosShareOne) {
  const auto here = open("pip.json"), there = open("pip.json");
  here->commit(step("model remove head"));
  EXPECT_TRUE(look(*there));
  EXPECT_EQ(there->describe()["undo"], "remove head");
  there->commit(step("model set hip --place 1 0 0"));
  here->commit(step("model set hip --name pelvis"));  // without a look
  EXPECT_TRUE(holds(text("pip.json"), R"("name": "pelvis",)"));
  EXPECT_TRUE(holds(text("pip.json"), R"("place": [1, 0, 0])"));
  look(*there);
  for (int i = 0; i < 3; ++i) there->undo();
  EXPECT_EQ(text("pip.json"), kPip);
  look(*here);
  EXPECT_EQ(here->describe()["redo"], "remove head");
}

TEST_F(Histories, AnUnwritableFolderRefusesStepsAndLeavesAllAsItWas) {
  const auto project = open("pip.json");
  std::filesystem::remove(path("pip.json"));
  std::filesystem::create_directory(path("pip.json"));
  refusal([&] { project->commit(step("model remove head")); });
  EXPECT_EQ(project->film().models[0].joints.size(), 4u);
  EXPECT_TRUE(project->problem());
}

}  // namespace
}  // namespace mars::studio
