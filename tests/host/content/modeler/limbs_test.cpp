#include "host/content/modeler/limbs.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "host/content/modeler/read_model.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::modeler {
namespace {

Model model_with(const std::string& limbs) {
  const document::Document document(R"({"joints": [{"name": "thigh", "parent": "hips"}, {"name": "hips"},
                                         {"name": "shin", "parent": "thigh"}], "limbs": )" +
                                        limbs + "}",
                                    "m.json");
  return read_model(document.root());
}

TEST(Limbs, NameJointsAsTheModelKeepsThem) {
  const Model model = model_with(R"({"pelvis": "hips", "left": {"hip": "thigh", "knee": "shin"}})");
  EXPECT_EQ(model.joints[model.limbs.of(Trunk::pelvis)].name, "hips");
  EXPECT_EQ(model.joints[model.limbs.of(Limb::knee, Side::left)].name, "shin");
  EXPECT_EQ(model.limbs.of(Limb::knee, Side::right), kNone);
  EXPECT_EQ(model.limbs.of(Trunk::head), kNone);
}

TEST(Limbs, RefuseWhatIsNoJointOrTwiceOrOutOfOrder) {
  EXPECT_EQ(document::failure_of([] { model_with(R"({"left": {"hip": "tigh"}})"); }),
            "m.json:2: limbs.left.hip: is 'tigh', which is no joint of this model (did you mean 'thigh'?)");
  EXPECT_EQ(document::failure_of([] { model_with(R"({"left": {"hip": "thigh"}, "right": {"hip": "thigh"}})"); }),
            "m.json:2: limbs.right.hip: is 'thigh', which is another limb already (name each joint once)");
  EXPECT_EQ(document::failure_of([] { model_with(R"({"left": {"hip": "shin", "knee": "thigh"}})"); }),
            "m.json:2: limbs.left.knee: is 'thigh', which does not hang below the hip 'shin' "
            "(name joints from the body outwards; mars model MODEL set JOINT --reset limb makes a joint no limb)");
}

TEST(Limbs, TheExamplesManHasThemAllButFingersAndTheHorseAllButASpine) {
  const Model horse = load_model(std::filesystem::path(MARS_SOURCE_DIR) / "examples/models/horse.json");
  for (const auto& side : horse.limbs.sides)
    for (const std::size_t joint : side) EXPECT_NE(joint, kNone);
  const Model man = load_model(std::filesystem::path(MARS_SOURCE_DIR) / "examples/models/human.json");
  for (const std::size_t joint : man.limbs.trunk) EXPECT_NE(joint, kNone);
  for (const auto& side : man.limbs.sides)
    for (std::size_t limb = 0; limb < side.size(); ++limb)
      EXPECT_EQ(side[limb] == kNone, limb == static_cast<std::size_t>(Limb::fingers)) << kLimbNames[limb];
}

}  // namespace
}  // namespace mars::modeler
