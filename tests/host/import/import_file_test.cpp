// mars import: files of other programs become models that can be read, bad ones one clear failure.
#include "host/import/import_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "host/document/whole_file.h"
#include "host/import/mesh_file.h"
#include "host/modeler/meshlets.h"
#include "host/modeler/patch_file.h"
#include "host/modeler/read_model.h"
#include "tests/host/document/failure_of.h"

namespace mars::host {
namespace {

namespace fs = std::filesystem;

// A box of 2 x 4 x 6, its six faces as quads, outward.
constexpr double kCorners[8][3] = {{1, 1, 1}, {3, 1, 1}, {1, 5, 1}, {3, 5, 1}, {1, 1, 7}, {3, 1, 7}, {1, 5, 7}, {3, 5, 7}};
constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

std::string row(const char* word, const double* v) {
  return std::string(word) + " " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) + "\n";
}

std::string obj_box() {
  std::string text;
  for (const auto& corner : kCorners) text += row("v", corner);
  for (const auto& face : kFaces) {
    text += "f";
    for (const int corner : face) text += " " + std::to_string(corner + 1);
    text += "\n";
  }
  return text;
}

std::string stl_box() {
  std::string text = "solid box\n";
  for (const auto& face : kFaces)
    for (const int second : {1, 2}) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int corner : {face[0], face[second], face[second + 1]}) text += row("vertex", kCorners[corner]);
      text += "endloop\nendfacet\n";
    }
  return text + "endsolid box\n";
}

std::string ply_box() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& corner : kCorners) text += row("", corner);
  for (const auto& face : kFaces) {
    text += "4";
    for (const int corner : face) text += " " + std::to_string(corner);
    text += "\n";
  }
  return text;
}

class ImportTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  Model import(const fs::path& from) const {
    told_ = import_model(from, folder_ / "model.json", "");
    return load_model(folder_ / "model.json");
  }
  std::string failure(const std::string& name, const std::string& text) const {
    const fs::path from = write(name, text), to = folder_ / "none.json";
    const std::string told = failure_of([&] { import_model(from, to, "j"); });
    EXPECT_FALSE(fs::exists(to));
    EXPECT_TRUE(holds(told, name)) << told;
    return told;
  }

  // Six times the volume of what the mesh encloses, in the unit cube: its faces run outward.
  static double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.ends.size(); ++f) {
      const auto area = area_vector(mesh, mesh.face(f));
      for (std::size_t axis = 0; axis < 3; ++axis) sum += area[axis] * (mesh.vertices[mesh.face(f)[0]][axis] - 0.5);
    }
    return sum;
  }

  fs::path folder_ = fs::temp_directory_path() / "mars_import_test";
  mutable std::string told_;
};

TEST_F(ImportTest, ABoxIsABoxInEveryFormat) {
  for (const auto& [name, text] : std::map<std::string, std::string>{
           {"box.obj", obj_box()}, {"box.STL", stl_box()}, {"box.ply", ply_box()}}) {
    const Model model = import(write(name, text));
    ASSERT_EQ(model.joints.size(), 1u) << name;
    EXPECT_EQ(model.joints[0].name, "box");
    EXPECT_EQ(model.joints[0].segment->sbb.min, glm::dvec3(1, 1, 1));
    EXPECT_EQ(model.joints[0].segment->sbb.max, glm::dvec3(3, 5, 7));
    EXPECT_TRUE(model.joints[0].segment->material.empty());
    const Mesh& mesh = model.shapes[0].mesh.value();
    EXPECT_EQ(mesh.vertices.size(), 8u) << name << ": vertices at one place are one";
    EXPECT_EQ(mesh.ends.size(), name == "box.STL" ? 12u : 6u);
    EXPECT_EQ(mesh.crease, 30);
    EXPECT_NEAR(volume(mesh), 6, 1e-6) << name;
    EXPECT_EQ(cut_meshlets(mesh).places.size(), 24u) << name << ": a box has sharp edges";
    EXPECT_TRUE(holds(told_, "one joint 'box', 8 vertices")) << told_;
  }
}

TEST_F(ImportTest, NormalsOfTheFileAreTakenAndTurnFaces) {
  std::string text = obj_box();
  for (const auto& c : kCorners) {
    const double normal[] = {c[0] - 2, c[1] - 3, c[2] - 4};
    text += row("vn", normal);
  }
  const auto faces = text.find("\nf ");
  text.replace(faces, text.find("\nvn") - faces, "");
  for (const auto& face : kFaces) {  // inward, as some programs write them
    text += "f";
    for (int k = 4; k-- > 0;) text += " " + std::to_string(face[k] + 1) + "//" + std::to_string(face[k] + 1);
    text += "\n";
  }
  const Model model = import(write("round.obj", text));
  const Mesh& mesh = model.shapes[0].mesh.value();
  ASSERT_EQ(mesh.normals.size(), 8u);
  EXPECT_NEAR(volume(mesh), 6, 1e-6);
  // In the cube, (x - 2, y - 3, z - 4) of a box 2 x 4 x 6 goes by the extents: (2, 8, 18) at the far corner.
  const auto& far = mesh.normals[static_cast<std::size_t>(
      std::find(mesh.vertices.begin(), mesh.vertices.end(), Mesh::Place{1, 1, 1}) - mesh.vertices.begin())];
  EXPECT_NEAR(far[1] / far[0], 4, 1e-5);
  EXPECT_NEAR(far[2] / far[0], 9, 1e-5);
}

TEST_F(ImportTest, ColoursAreJointsOfOneBox) {
  write("two.mtl", "newmtl red\nKd 0.8 0.1 0.2\nnewmtl blue\nKd 0.1 0.2 0.9\n");
  std::string text = "mtllib two.mtl\n" + obj_box();
  text.insert(text.find("\nf ") + 1, "usemtl red\n");
  text.insert(text.rfind("f "), "usemtl blue\n");
  const Model model = import(write("two.obj", text));
  ASSERT_EQ(model.joints.size(), 2u);
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.joints[1].name, "two-2");
  EXPECT_EQ(model.joints[1].parent, 0u);
  EXPECT_EQ(model.joints[1].freedoms(), 0);
  EXPECT_EQ(model.joints[0].segment->sbb.max, model.joints[1].segment->sbb.max) << "one box: shared vertices stay shared";
  EXPECT_EQ(model.joints[0].segment->sbb.min, model.joints[1].segment->sbb.min);
  EXPECT_EQ(model.materials[0].material.color, (std::array<float, 3>{0.8f, 0.1f, 0.2f}));
  EXPECT_EQ(model.shapes[0].mesh->ends.size(), 5u);
  EXPECT_EQ(model.shapes[1].mesh->ends.size(), 1u);
}

TEST_F(ImportTest, FacesThatCannotBeReadAsTheyStandAreMended) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nf 1 2 2\nf 1 3 2 4\nf 1 2 5\n";
  const Mesh mesh = import(write("odd.obj", text)).shapes[0].mesh.value();
  EXPECT_EQ(mesh.face(0).size(), 4u);
  EXPECT_EQ(mesh.ends.size(), 4u) << "a quad, a bow tie in two triangles, one without area; the line is left out";
}

TEST_F(ImportTest, AFlatMeshHasABoxAllTheSame) {
  const Model model = import(write("flat.obj", "v 0 0 3\nv 2 0 3\nv 0 2 3\nf 1 2 3\n"));
  EXPECT_EQ(model.joints[0].segment->sbb.max, glm::dvec3(2, 2, 4));
}

TEST_F(ImportTest, BadFilesAreOneClearFailure) {
  EXPECT_TRUE(holds(failure("a.obj", ""), "is no sound mesh file"));
  EXPECT_TRUE(holds(failure("a.stl", "solid x\nfacet"), "mesh file"));
  EXPECT_TRUE(holds(failure("a.glb", "glTF and then nothing"), "is no sound mesh file"));
  EXPECT_TRUE(holds(failure("a.gltf", "{\"asset\": "), "is no sound mesh file"));
  EXPECT_TRUE(holds(failure("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "has no faces"));
  EXPECT_TRUE(holds(failure("a.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n"), "within 1e9"));
  EXPECT_TRUE(holds(failure("a.fbx", "x"), "the number of patches"));
  EXPECT_TRUE(holds(failure_of([&] { import_model(folder_ / "no.obj", folder_ / "m.json", ""); }), "no.obj"));
  EXPECT_TRUE(holds(failure_of([&] { import_model(write("b.obj", obj_box()), folder_ / "x/m.json", ""); }), "m.json"));
  EXPECT_TRUE(holds(failure_of([&] { import_model(write("b.obj", obj_box()), folder_ / "x.json", "a/b"); }), "'/'"));
}

// Assimp never comes back from this one.
TEST_F(ImportTest, AFileThatTheReaderLoopsOverIsOneClearFailure) {
  std::string text = ply_box();
  text.replace(text.find("end_header"), 5, "end_9");
  EXPECT_TRUE(holds(failure("loop.ply", text), "does not end well"));
}

TEST_F(ImportTest, PatchFilesAreModelsToo) {
  std::string text = "1\n3 3\n";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) text += std::to_string(10 + 2 * i) + " " + std::to_string(-j) + " 7\n";
  const fs::path from = write("in.bpt", text);
  const Model model = import(from);
  ASSERT_EQ(model.joints.size(), 1u);
  EXPECT_EQ(model.joints[0].name, "in");
  EXPECT_EQ(model.joints[0].segment->sbb.min, glm::dvec3(10, -3, 7));
  EXPECT_EQ(model.shapes[0].patches[0].points, read_patch_file(from).patches[0].points);
}

TEST_F(ImportTest, TheFileItselfIsNotOverwritten) {
  const fs::path from = write("in.bpt", "1\n");
  EXPECT_NE(failure_of([&] { import_model(from, from, "a"); }).find("is the file that is read (write to another)"),
            std::string::npos);
  EXPECT_EQ(read_whole_file(from).size(), 2u);
}

// Files of others, where they lie beside the project.
TEST_F(ImportTest, GltfFilesOfOthers) {
  const fs::path data = fs::path(MARS_SOURCE_DIR) / "../shared/data";
  if (!fs::exists(data / "BoxAnimated.glb") || !fs::exists(data / "RiggedFigure.glb")) GTEST_SKIP() << "no files in " << data;
  const Model box = import(data / "BoxAnimated.glb");
  EXPECT_EQ(box.joints.size(), 2u) << "of two colours";
  EXPECT_EQ(box.shapes[0].mesh->normals.size(), box.shapes[0].mesh->vertices.size());
  const Model figure = import(data / "RiggedFigure.glb");
  const glm::dvec3 extent = figure.joints[0].segment->sbb.max - figure.joints[0].segment->sbb.min;
  EXPECT_GT(extent.z, extent.x) << "it stands upright";
  EXPECT_GT(extent.x, extent.y);
  EXPECT_GT(volume(figure.shapes[0].mesh.value()), 0);
}

}  // namespace
}  // namespace mars::host
