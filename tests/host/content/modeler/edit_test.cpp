#include "host/content/modeler/edit.h"

#include <gtest/gtest.h>

#include "tests/host/content/document/failure_of.h"

namespace mars::modeler {
namespace {

document::Json dog() {
  return document::Json::parse(R"({"joints": [
      {"name": "body", "segment": {"shape": "sphere", "material": "fur"}},
      {"name": "leg", "parent": "body", "limits": {"y": [-30, 30]}, "segment": {"shape": "cone", "top": 0.5}},
      {"name": "paw", "parent": "leg"}],
    "materials": {"fur": {"color": [1, 0, 0]}},
    "limbs": {"pelvis": "body", "left": {"hip": "leg"}}})");
}

std::string failure(const std::function<void(document::Json&)>& change) {
  document::Json model = dog();
  return document::failure_of([&] { change(model); });
}

document::Json changed(const std::string& joint, const JointChange& change) {
  document::Json model = dog();
  set_joint(model, joint, change);
  for (document::Json& each : model["joints"])
    if (each["name"] == joint) return each;
  return nullptr;
}

TEST(Edit, AJointIsWrittenAsAPersonWould) {
  document::Json model = dog();
  JointChange change;
  change.segment =
      document::Json::parse(R"({"sbb": [[-1, -1, -0.5], [1, 1, 0]], "shape": "cone", "top": 0.25, "material": "fur"})");
  change.joint = document::Json::parse(R"({"place": [0, 0, -0.1], "parent": "body"})");
  change.limits = {{'z', {0, 10}}, {'y', {-30, 60}}};
  add_joint(model, "tail", change);
  EXPECT_EQ(model["joints"][3].dump(),
            R"({"name":"tail","parent":"body","place":[0,0,-0.1],"limits":{"y":[-30,60],"z":[0,10]},)"
            R"("segment":{"shape":"cone","sbb":[[-1,-1,-0.5],[1,1,0]],"material":"fur","top":0.25}})");
}

TEST(Edit, WithoutLimitsAJointIsFree) {
  document::Json model = dog();
  add_joint(model, "tail", {});
  EXPECT_EQ(model["joints"][3].dump(), R"({"name":"tail"})");
}

TEST(Edit, LimitsAreSetAxisByAxis) {
  JointChange change;
  change.limits = {{'x', {5, 5}}};
  EXPECT_EQ(changed("leg", change)["limits"].dump(), R"({"x":[5,5],"y":[-30,30]})");
  EXPECT_EQ(changed("paw", change)["limits"].dump(), R"({"x":[5,5],"y":[-180,180],"z":[-180,180]})");
  change.freedom = Freedom::fixed;
  EXPECT_EQ(changed("leg", change)["limits"].dump(), R"({"x":[5,5]})");
  change = {};
  change.freedom = Freedom::free;
  EXPECT_FALSE(changed("leg", change).contains("limits"));
}

TEST(Edit, AnotherShapeLosesTheOptionsOfTheOneBefore) {
  JointChange change;
  change.segment["shape"] = "box";
  EXPECT_EQ(changed("leg", change)["segment"].dump(), R"({"shape":"box"})");
  change.segment["shape"] = "cone";
  EXPECT_EQ(changed("leg", change)["segment"].dump(), R"({"shape":"cone","top":0.5})");
  change.segment = {{"top", 0.25}};
  EXPECT_EQ(changed("leg", change)["segment"].dump(), R"({"shape":"cone","top":0.25})");
  EXPECT_TRUE(document::holds(failure([&](document::Json& model) { set_joint(model, "paw", change); }),
                              "has no segment (give it a shape"));
}

TEST(Edit, ResetGoesBackToWhatAFileNeedNotTell) {
  JointChange change;
  change.joint["x_axis"] = {1, 1, 0};
  change.reset = {"parent", "limits"};
  document::Json leg = changed("leg", change);
  EXPECT_EQ(leg["x_axis"].dump(), "[1,1,0]");
  EXPECT_FALSE(leg.contains("parent"));
  EXPECT_FALSE(leg.contains("limits"));
  change = {};
  change.reset = {"segment"};
  EXPECT_FALSE(changed("leg", change).contains("segment"));
}

TEST(Edit, ANewNameIsPutWhereOthersNameTheJoint) {
  document::Json model = dog();
  JointChange change;
  change.name = "thigh";
  set_joint(model, "leg", change);
  EXPECT_EQ(model["joints"][1]["name"], "thigh");
  EXPECT_EQ(model["joints"][2]["parent"], "thigh");
  EXPECT_EQ(model["limbs"]["left"]["hip"], "thigh");
  EXPECT_EQ(model["limbs"]["pelvis"], "body");
  change.name = "paw";
  EXPECT_TRUE(document::holds(failure([&](document::Json& other) { set_joint(other, "leg", change); }),
                              "joint 'paw': is in the model already"));
}

TEST(Edit, WhatCarriesOthersIsRemovedOnlyWithThem) {
  EXPECT_TRUE(document::holds(failure([](document::Json& model) { remove_joint(model, "leg", false); }),
                              "joint 'leg': carries 'paw'"));
  EXPECT_TRUE(document::holds(failure([](document::Json& model) { remove_joint(model, "leg", true); }),
                              "is one of the model's limbs: left.hip"));
  EXPECT_TRUE(document::holds(failure([](document::Json& model) { remove_joint(model, "body", true); }),
                              "a model has at least one joint"));
  document::Json model = dog();
  model.erase("limbs");
  remove_joint(model, "leg", true);
  EXPECT_EQ(model["joints"].size(), 1u);
}

TEST(Edit, NamesThatAreNotThereAreGuessed) {
  JointChange change;
  EXPECT_TRUE(
      document::holds(failure([&](document::Json& model) { add_joint(model, "leg", {}); }), "is in the model already"));
  EXPECT_TRUE(
      document::holds(failure([&](document::Json& model) { set_joint(model, "pwa", {}); }), "did you mean 'paw'?"));
  EXPECT_TRUE(document::holds(failure([&](document::Json& model) { remove_joint(model, "legg", true); }),
                              "did you mean 'leg'?"));
  change.segment["material"] = "furr";
  EXPECT_TRUE(
      document::holds(failure([&](document::Json& model) { set_joint(model, "leg", change); }), "did you mean 'fur'?"));
}

TEST(Edit, Materials) {
  document::Json model = dog();
  add_material(model, "nose", {{"color", {0.5, 0.25, 1}}, {"exponent", 16}});
  EXPECT_EQ(model["materials"]["nose"].dump(), R"({"color":[0.5,0.25,1],"exponent":16})");
  set_material(model, "fur", {{"ambient", 0.2}}, "coat");
  EXPECT_EQ(model["materials"].begin().key(), "coat");
  EXPECT_EQ(model["materials"]["coat"].dump(), R"({"color":[1,0,0],"ambient":0.2})");
  EXPECT_EQ(model["joints"][0]["segment"]["material"], "coat");
  set_material(model, "nose", {{"reflection", "cook-torrance"}, {"roughness", 0.25}}, {});
  EXPECT_EQ(model["materials"]["nose"].dump(),
            R"({"color":[0.5,0.25,1],"reflection":"cook-torrance","roughness":0.25})")
      << "it does not use an exponent";
  remove_material(model, "nose");
  EXPECT_FALSE(model["materials"].contains("nose"));
  EXPECT_TRUE(document::holds(failure([](document::Json& other) { remove_material(other, "fur"); }),
                              "is what 'body' is made of"));
  EXPECT_TRUE(
      document::holds(failure([](document::Json& other) { add_material(other, "fur", document::Json::object()); }),
                      "is in the model already"));
  EXPECT_TRUE(
      document::holds(failure([](document::Json& other) { set_material(other, "fru", document::Json::object(), {}); }),
                      "did you mean 'fur'?"));
}

TEST(Edit, NumbersAreShort) {
  EXPECT_EQ(plain_number(0.1 + 0.2).dump(), "0.3");
  EXPECT_EQ(plain_number(-2).dump(), "-2");
  EXPECT_EQ(plain_number(1e9).dump(), "1000000000");
  EXPECT_EQ(plain_number(-0.0).dump(), "0");
}

TEST(EditLimbs, AJointIsOneLimbAndALimbOneJoint) {
  document::Json model = document::Json::parse(R"({"joints": [{"name": "a"}, {"name": "b", "parent": "a"}]})");
  JointChange knee;
  knee.limb = "left.knee";
  set_joint(model, "b", knee);
  EXPECT_EQ(model["limbs"], document::Json::parse(R"({"left": {"knee": "b"}})"));
  set_joint(model, "a", knee);
  EXPECT_EQ(model["limbs"], document::Json::parse(R"({"left": {"knee": "a"}})"));
  JointChange pelvis;
  pelvis.limb = "pelvis";
  set_joint(model, "a", pelvis);
  EXPECT_EQ(model["limbs"], document::Json::parse(R"({"pelvis": "a"})"));
  JointChange none;
  none.reset = {"limb"};
  set_joint(model, "a", none);
  EXPECT_FALSE(model.contains("limbs"));
}

TEST(EditLimbs, ANewJointTakesNoLimbFromAnother) {
  document::Json model = document::Json::parse(R"({"joints": [{"name": "a"}], "limbs": {"head": "a"}})");
  JointChange change;
  change.limb = "head";
  EXPECT_TRUE(document::holds(document::failure_of([&] { add_joint(model, "b", change); }),
                              "joint 'b': cannot be head too: 'a' is"));
}

TEST(EditLimbs, RefuseWhatIsNoLimb) {
  document::Json model = document::Json::parse(R"({"joints": [{"name": "a"}]})");
  JointChange change;
  change.limb = "left.kne";
  EXPECT_EQ(document::failure_of([&] { set_joint(model, "a", change); }),
            "joint 'a': cannot be 'left.kne', which is no limb (did you mean 'left.knee'?)");
}

}  // namespace
}  // namespace mars::modeler
