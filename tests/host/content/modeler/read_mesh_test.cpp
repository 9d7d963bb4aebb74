// Meshes in model files: what is read, and that whatever is wrong is reported with its place and a remedy.
#include "host/content/modeler/read_mesh.h"

#include <gtest/gtest.h>

#include <string>

#include "host/content/modeler/mirror.h"
#include "host/content/modeler/read_model.h"
#include "tests/host/content/document/failure_of.h"

namespace mars::modeler {
namespace {

const std::string kVertices = "[[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0.5,0.5,1]]";

Model model_with_mesh(const std::string& mesh) {
  const document::Document document("{\"shapes\": {\"hut\": {\"mesh\": {" + mesh +
                                        "}}},\n\"joints\": [{\"name\": \"j\", " +
                                        "\"segment\": {\"shape\": \"hut\"}}]}",
                                    "hut.json");
  return read_model(document.root());
}

std::string mesh_failure(const std::string& mesh) {
  return document::failure_of([&] { model_with_mesh(mesh); });
}

// Whether the text holds both parts.
bool both(const std::string& text, const std::string& one, const std::string& other) {
  return document::holds(text, one) && document::holds(text, other);
}

std::string with_faces(const std::string& faces) { return "\"vertices\": " + kVertices + ", \"faces\": " + faces; }

TEST(ReadMesh, FacesAreThoseOfTheFile) {
  const Model model = model_with_mesh(with_faces("[[3,2,1,0], [0,1,4], [1,2,4]]") + ", \"crease\": 12.5");
  ASSERT_TRUE(model.shapes[0].mesh.has_value());
  const Mesh& mesh = *model.shapes[0].mesh;
  EXPECT_TRUE(model.shapes[0].patches.empty());
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[4], (Mesh::Place{0.5f, 0.5f, 1}));
  ASSERT_EQ(mesh.ends.size(), 3u);
  EXPECT_EQ(mesh.face(0).size(), 4u);
  EXPECT_EQ(mesh.face(2)[2], 4u);
  EXPECT_EQ(mesh.crease, 12.5);
  EXPECT_EQ(model_with_mesh(with_faces("[[0,1,4]]")).shapes[0].mesh->crease, 30);
}

TEST(ReadMesh, TellsWhereAFaceIsWrong) {
  EXPECT_TRUE(both(mesh_failure(with_faces("[[0,1,4], [0,1,5]]")), "shapes.hut.mesh.faces[1][2]: is 5", "from 0 to 4"));
  EXPECT_TRUE(both(mesh_failure(with_faces("[[0,1,-1]]")), "faces[0][2]: is -1", "from 0 to 4"));
  EXPECT_TRUE(both(mesh_failure(with_faces("[[0,1,1.5]]")), "faces[0][2]: is 1.5", "whole number"));
  EXPECT_TRUE(both(mesh_failure(with_faces("[[0,1]]")), "faces[0]: has 2 vertices", "3 to 4096"));
  EXPECT_TRUE(document::holds(mesh_failure(with_faces("[[0,1,1,4]]")), "faces[0]: names vertex 1 twice in a row"));
  EXPECT_TRUE(
      document::holds(mesh_failure(with_faces("[[0,1,0,1]]")), "faces[0]: has fewer than 3 different vertices"));
  EXPECT_TRUE(both(mesh_failure(with_faces("[[0,1,3,2]]")), "faces[0]: crosses itself", "outline"));
  EXPECT_TRUE(document::holds(mesh_failure(with_faces("[]")), "faces: has no faces"));
  EXPECT_TRUE(document::holds(mesh_failure(with_faces("[[0,1,4], 7]")), "faces[1]: is a number, not a list"));
}

TEST(ReadMesh, TellsWhatElseIsWrong) {
  EXPECT_TRUE(both(mesh_failure("\"vertices\": [[0,0,0],[1,0,0],[1,1,2]], \"faces\": [[0,1,2]]"),
                   "mesh.vertices[2][2]: is 2", "from 0 to 1"));
  EXPECT_TRUE(document::holds(mesh_failure("\"vertices\": [[0,0,0],[1,0,0],[1,1]], \"faces\": [[0,1,2]]"),
                              "vertices[2]: has 2 items"));
  EXPECT_TRUE(
      document::holds(mesh_failure("\"vertices\": [[0,0,0]], \"faces\": [[0,0,0]]"), "vertices: has fewer than 3"));
  EXPECT_TRUE(both(mesh_failure("\"vertices\": " + kVertices), "has no 'faces'", "a mesh needs it"));
  EXPECT_TRUE(both(mesh_failure(with_faces("[[0,1,4]]") + ", \"creese\": 3"), "creese", "did you mean 'crease'?"));
  EXPECT_TRUE(both(mesh_failure(with_faces("[[0,1,4]]") + ", \"crease\": 200"), "crease: is 200", "from 0 to 180"));
  EXPECT_TRUE(
      document::holds(mesh_failure(with_faces("[[0,1,4]]") + ", \"crease\": 0, \"normals\": []"), "beside a crease"));
  EXPECT_TRUE(
      both(mesh_failure(with_faces("[[0,1,4]]") + ", \"normals\": [[0,0,1]]"), "normals: has 1 items", "write 5"));
  const document::Document wrong(R"({"shapes": {"hut": {"mush": 1}}, "joints": [{"name": "j"}]})", "hut.json");
  EXPECT_TRUE(both(document::failure_of([&] { read_model(wrong.root()); }), "mush", "did you mean 'mesh'?"));
}

TEST(ReadMesh, NormalsMayNotPointInside) {
  const std::string normals = ", \"normals\": [[0,0,2],[0,0,1],[0,0,1],[0,0,1],[0,0,1]]";
  EXPECT_EQ(model_with_mesh(with_faces("[[0,1,2,3]]") + normals).shapes[0].mesh->normals[0], (Mesh::Place{0, 0, 2}));
  EXPECT_TRUE(both(mesh_failure(with_faces("[[0,1,2,3], [2,1,0]]") + normals),
                   "faces[1]: has normals that point to its inside", "counter-clockwise"));
}

const std::string kRoof = with_faces("[[3,2,1,0], [0,1,4]]");

// What is kept for textures changes nothing that is drawn.
TEST(ReadMesh, PaintIsReadAndIgnored) {
  const Mesh plain = *model_with_mesh(kRoof).shapes[0].mesh;
  const std::string rows = "[[0,0], [1,0], [1,1], [0,1], [0.5,-2]]";
  for (const std::string& paint :
       {", \"uv\": " + rows, std::string(", \"colors\": [[0,0,0], [1,1,1], [0,0.5,1,0.25], [0,0,0], [1,0,0]]"),
        ", \"uv\": " + rows + ", \"paint_faces\": [[4,3,2,1], [0,0,4]]",
        std::string(", \"uv\": [[7,8]], \"colors\": [[0,0,1]], \"paint_faces\": [[0,0,0,0], [0,0,0]]")})
    EXPECT_EQ(*model_with_mesh(kRoof + paint).shapes[0].mesh, plain) << paint;
}

TEST(ReadMesh, TellsWherePaintIsWrong) {
  const std::string five = ", \"uv\": [[0,0], [0,0], [0,0], [0,0], [0,0]]";
  EXPECT_TRUE(document::holds(mesh_failure(kRoof + ", \"uv\": [[0,0]]"), "mesh.uv: has 1 items"));
  EXPECT_TRUE(document::holds(mesh_failure(kRoof + ", \"colors\": [[0,0,0]]"), "mesh.colors: has 1 items"));
  EXPECT_TRUE(
      both(mesh_failure(kRoof + ", \"uv\": [[0,0], [0,0], [0,0], [0,0], [0]]"), "uv[4]: has 1 numbers", "write 2"));
  EXPECT_TRUE(document::holds(mesh_failure(kRoof + ", \"uv\": [[0,0], [0,0], [0,2e9], [0,0], [0,0]]"), "uv[2][1]: is"));
  EXPECT_TRUE(
      document::holds(mesh_failure(kRoof + five + ", \"colors\": [[0,0,0]], \"paint_faces\": []"), "colors: has 1"));
  EXPECT_TRUE(document::holds(mesh_failure(kRoof + five + ", \"paint_faces\": [[0,0,0]]"), "paint_faces: has 1 items"));
  EXPECT_TRUE(document::holds(mesh_failure(kRoof + five + ", \"paint_faces\": [[0,0,0], [0,0,0]]"),
                              "paint_faces[0]: has 3 items"));
  EXPECT_TRUE(both(mesh_failure(kRoof + five + ", \"paint_faces\": [[0,0,0,0], [0,0,5]]"), "paint_faces[1][2]: is 5",
                   "from 0 to 4"));
  EXPECT_TRUE(
      document::holds(mesh_failure(kRoof + ", \"paint_faces\": [[0,0,0,0], [0,0,0]]"), "has no rows to number"));
}

// Faces run the other way round in a mirror, and what belongs to their corners with them.
TEST(ReadMesh, PaintIsMirroredWithItsFaces) {
  const std::string mesh =
      kRoof + ", \"uv\": [[0,0], [1,0], [1,1], [0,1], [0.5,2]], \"paint_faces\": [[4,3,2,1], [0,2,4]]";
  const document::Json mirrored = mirrored_shape(document::Json::parse("{\"mesh\": {" + mesh + "}}"))["mesh"];
  EXPECT_EQ(mirrored["faces"].dump(), "[[0,1,2,3],[4,1,0]]");
  EXPECT_EQ(mirrored["paint_faces"].dump(), "[[1,2,3,4],[4,2,0]]");
  EXPECT_EQ(mirrored["uv"].dump(), "[[0,0],[1,0],[1,1],[0,1],[0.5,2]]");
}

}  // namespace
}  // namespace mars::modeler
