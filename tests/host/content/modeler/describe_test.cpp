#include "host/content/modeler/describe.h"

#include <gtest/gtest.h>

#include "host/content/modeler/read_model.h"

namespace mars::modeler {
namespace {

Model described_model(const std::string& joints) {
  const document::Document document(
      "{\"joints\": [" + joints + "], \"materials\": {\"fur\": {\"color\": [1, 0.5, 0]}}}", "m.json");
  return read_model(document.root());
}

TEST(Describe, ATreeWithFreedomsAndSegments) {
  const Model model = described_model(R"(
      {"name": "paw", "parent": "leg", "limits": {}},
      {"name": "body", "segment": {"shape": "box", "sbb": [[-1, -1, 1], [1, 1, 2]], "material": "fur"}},
      {"name": "leg", "parent": "body", "limits": {"y": [-30, 60.5], "z": [20, 20]}, "segment": {"shape": "box"}})");
  EXPECT_EQ(describe_model(model), R"(joints    3 with 4 freedoms
segments  2 of 1 shapes
patches   12, 6 of them stored
at rest   2 x 2.282 x 2, z from 0 to 2

joint    turns                 axes  shape  patches  sbb        material
body     free                  -     box    6        2 x 2 x 1  fur
  leg    y -30..60.5, z at 20  -     box    6        1 x 1 x 1  -
    paw  fixed                 -     -      -        -          -

material  color    ambient  diffuse  specular  exponent  sides
fur       1 0.5 0  0.1      0.65     0.45      32        2
)");
}

TEST(Describe, MaterialsHaveTheNumbersThatTheyUse) {
  const document::Document document(R"({"joints": [{"name": "hip"}], "materials": {"fur": {"interpolation": "flat"},
      "tin": {"reflection": "metallic-roughness", "metallic": 1}}})",
                                    "m.json");
  const std::string text = describe_model(read_model(document.root()));
  EXPECT_EQ(
      text.substr(text.find("material  ")),
      R"(material  color        reflection          ambient  diffuse  specular  exponent  roughness  metallic  interpolation  sides
fur       0.8 0.8 0.8  phong               0.1      0.65     0.45      32                             flat           2
tin       0.8 0.8 0.8  metallic-roughness  0.1                                   0.5        1         phong          2
)");
}

TEST(Describe, MaterialsSayWhatTheyDoWithShadowsIfOneDoesWhatIsUnusual) {
  const document::Document document(
      R"({"joints": [{"name": "hip"}], "materials": {"fur": {}, "glass": {"casts": false}}})", "m.json");
  const std::string text = describe_model(read_model(document.root()));
  EXPECT_EQ(text.substr(text.find("material  ")),
            R"(material  color        ambient  diffuse  specular  exponent  sides  casts
fur       0.8 0.8 0.8  0.1      0.65     0.45      32        2      true
glass     0.8 0.8 0.8  0.1      0.65     0.45      32        2      false
)");
}

TEST(Describe, TellsLimbsWhereAModelHasThem) {
  const document::Document document(R"({"joints": [{"name": "hip"}, {"name": "calf", "parent": "hip"}],
                              "limbs": {"left": {"knee": "calf"}}})",
                                    "m.json");
  const std::string text = describe_model(read_model(document.root()));
  EXPECT_NE(text.find("hip     free   -     -          -"), std::string::npos) << text;
  EXPECT_NE(text.find("calf  free   -     left.knee  -"), std::string::npos) << text;
}

TEST(Describe, MeshesHaveFacesAndASizeAtRest) {
  const document::Document document(
      R"({"shapes": {"tip": {"mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]],
      "faces": [[0, 1, 2], [0, 2, 3]]}}}, "joints": [{"name": "a", "segment": {"shape": "tip", "sbb": [[0, 0, 0], [2, 3, 4]]}},
      {"name": "b", "parent": "a", "place": [2, 0, 0], "segment": {"shape": "tip"}}]})",
      "m.json");
  const std::string text = describe_model(read_model(document.root()));
  EXPECT_NE(text.find("faces     4, 2 of them stored"), std::string::npos) << text;
  EXPECT_NE(text.find("tip    2 faces"), std::string::npos) << text;
  EXPECT_NE(text.find("at rest   3 x 3 x 2"), std::string::npos) << text;
}

TEST(Describe, TellsSkewedAxes) {
  const Model model =
      described_model(R"({"name": "a", "y_axis": [0.5, 0.8660254037844386, 0], "segment": {"shape": "box"}},
                                  {"name": "b", "x_axis": [0, 1, 0], "y_axis": [-1, 0, 0]})");
  EXPECT_NEAR(skew_of(model.joints[0]), 60, 1e-9);
  EXPECT_EQ(skew_of(model.joints[1]), 0);
  const std::string text = describe_model(model);
  EXPECT_NE(text.find("skewed, 60 degrees"), std::string::npos);
  EXPECT_NE(text.find("its own"), std::string::npos);
}

}  // namespace
}  // namespace mars::modeler
