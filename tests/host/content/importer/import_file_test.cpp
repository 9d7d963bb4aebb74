// mars import: files of other programs become models that can be read, bad ones one clear failure.
#include "host/content/importer/import_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "host/content/importer/mesh_file.h"
#include "host/content/importer/promised.h"
#include "host/content/modeler/meshlets.h"
#include "host/content/modeler/patch_file.h"
#include "host/content/modeler/read_model.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/importer/import_folder.h"
#include "tests/sanitizers/sanitized.h"

namespace mars::importer {
namespace {

namespace fs = std::filesystem;

// A box of 2 x 4 x 6, its six faces as quads, outward.
constexpr double kCorners[8][3] = {{1, 1, 1}, {3, 1, 1}, {1, 5, 1}, {3, 5, 1},
                                   {1, 1, 7}, {3, 1, 7}, {1, 5, 7}, {3, 5, 7}};
constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

std::string row(const char* word, const double* v) {
  return std::string(word) + " " + std::to_string(v[0]) + " " + std::to_string(v[1]) + " " + std::to_string(v[2]) +
         "\n";
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

// A triangle with all that a model cannot have: a skin of two bones and its motion, a texture, colours, a target.
std::string gltf_figure() {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 3]}],
"extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
"nodes": [{"mesh": 0, "skin": 0}, {"name": "hip", "children": [2]}, {"name": "knee"},
          {"camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2, "COLOR_0": 3, "TEXCOORD_0": 4},
            "material": 0, "targets": [{"POSITION": 0}]}]},
           {"primitives": [{"attributes": {"POSITION": 0}}]}],
"skins": [{"joints": [1, 2], "inverseBindMatrices": 7}],
"materials": [{"name": "skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
"textures": [{"source": 0}], "images": [{"uri": "skin.png"}],
"animations": [{"samplers": [{"input": 5, "output": 6}], "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
              {"bufferView": 1, "componentType": 5121, "count": 3, "type": "VEC4"},
              {"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC4"},
              {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
              {"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC2"},
              {"bufferView": 4, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
              {"bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3"},
              {"bufferView": 5, "componentType": 5126, "count": 2, "type": "MAT4"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12},
                {"buffer": 0, "byteOffset": 48, "byteLength": 48}, {"buffer": 0, "byteOffset": 96, "byteLength": 24},
                {"buffer": 0, "byteOffset": 120, "byteLength": 8}, {"buffer": 0, "byteOffset": 128, "byteLength": 128}],
"buffers": [{"uri": "figure.bin", "byteLength": 256}]})";
}

std::string gltf_numbers() {
  std::vector<float> numbers(64);
  numbers[3] = numbers[7] = 1;  // places; then joints, all 0
  for (const std::size_t weight : {12, 13, 16, 17, 20, 21}) numbers[weight] = 0.5f;
  numbers[31] = 1;                                                         // after places in a texture, times
  for (std::size_t i = 0; i < 32; ++i) numbers[32 + i] = i % 16 % 5 == 0;  // matrices
  std::string bytes(numbers.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

class ImportTest : public ImportFolder {
 protected:
  modeler::Model import(const ImportOptions& options) const {
    told_ = import_model(options);
    return modeler::load_model(options.to);
  }
  modeler::Model import(const fs::path& from) const { return import(options_for(from)); }
  modeler::Model import_upright(const fs::path& from, const std::string& up) const {
    ImportOptions options = options_for(from);
    options.up = up;
    return import(options);
  }
  // The list at the report's end.
  std::vector<std::string> not_read() const {
    std::vector<std::string> lines;
    std::istringstream list(told_.substr(told_.find("not read")));
    for (std::string line; std::getline(list, line);) lines.push_back(line.substr(lines.empty() ? 11 : 13));
    return lines;
  }
  std::string failure(const std::string& name, const std::string& text) const {
    ImportOptions options = options_for(write(name, text));
    options.to = folder_ / "none.json";
    const std::string reported = document::failure_of([&] { import_model(options); });
    EXPECT_FALSE(fs::exists(options.to));
    EXPECT_TRUE(document::holds(reported, name)) << reported;
    return reported;
  }

  // Six times the volume of what the mesh encloses, in the unit cube: its faces run outward.
  static double volume(const modeler::Mesh& mesh) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.ends.size(); ++f) {
      const auto area = modeler::area_vector(mesh, mesh.face(f));
      for (std::size_t axis = 0; axis < 3; ++axis) sum += area[axis] * (mesh.vertices[mesh.face(f)[0]][axis] - 0.5);
    }
    return sum;
  }

  mutable std::string told_;
};

TEST_F(ImportTest, ABoxIsABoxInEveryFormat) {
  for (const auto& [name, text] :
       std::map<std::string, std::string>{{"box.obj", obj_box()}, {"box.STL", stl_box()}, {"box.ply", ply_box()}}) {
    const modeler::Model model = import_upright(write(name, text), "z");
    ASSERT_EQ(model.joints.size(), 1u) << name;
    EXPECT_EQ(model.joints[0].name, "box");
    EXPECT_EQ(model.joints[0].segment->sbb.min, glm::dvec3(1, 1, 1));
    EXPECT_EQ(model.joints[0].segment->sbb.max, glm::dvec3(3, 5, 7));
    EXPECT_TRUE(model.joints[0].segment->material.empty());
    const modeler::Mesh& mesh = model.shapes[0].mesh.value();
    EXPECT_EQ(mesh.vertices.size(), 8u) << name << ": vertices at one place are one";
    EXPECT_EQ(mesh.ends.size(), name == "box.STL" ? 12u : 6u);
    EXPECT_EQ(mesh.crease, 30);
    EXPECT_NEAR(volume(mesh), 6, 1e-6) << name;
    EXPECT_EQ(modeler::cut_meshlets(mesh).places.size(), 24u) << name << ": a box has sharp edges";
    EXPECT_TRUE(document::holds(
        told_, "model.json: model of one joint 'box'\n  box        2 x 4 x 6 units, the file's z upward\n"))
        << told_;
    EXPECT_TRUE(document::holds(told_, "  read       8 vertices")) << told_;
    EXPECT_EQ(not_read(), std::vector<std::string>{"nothing: all of the file was read"});
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
  const modeler::Model model = import_upright(write("round.obj", text), "z");
  const modeler::Mesh& mesh = model.shapes[0].mesh.value();
  ASSERT_EQ(mesh.normals.size(), 8u);
  EXPECT_NEAR(volume(mesh), 6, 1e-6);
  // In the cube, (x - 2, y - 3, z - 4) of a box 2 x 4 x 6 goes by the extents: (2, 8, 18) at the far corner.
  const auto& far = mesh.normals[static_cast<std::size_t>(
      std::find(mesh.vertices.begin(), mesh.vertices.end(), modeler::Mesh::Place{1, 1, 1}) - mesh.vertices.begin())];
  EXPECT_NEAR(far[1] / far[0], 4, 1e-5);
  EXPECT_NEAR(far[2] / far[0], 9, 1e-5);
}

TEST_F(ImportTest, ColoursAreJointsOfOneBox) {
  write("two.mtl", "newmtl red\nKd 0.8 0.1 0.2\nnewmtl blue\nKd 0.1 0.2 0.9\n");
  std::string text = "mtllib two.mtl\n" + obj_box();
  text.insert(text.find("\nf ") + 1, "usemtl red\n");
  text.insert(text.rfind("f "), "usemtl blue\n");
  const modeler::Model model = import(write("two.obj", text));
  ASSERT_EQ(model.joints.size(), 2u);
  ASSERT_EQ(model.materials.size(), 2u);
  EXPECT_EQ(model.joints[1].name, "two-2");
  EXPECT_EQ(model.joints[1].parent, 0u);
  EXPECT_EQ(model.joints[1].freedoms(), 0);
  EXPECT_EQ(model.joints[0].segment->sbb.max, model.joints[1].segment->sbb.max)
      << "one box: shared vertices stay shared";
  EXPECT_EQ(model.joints[0].segment->sbb.min, model.joints[1].segment->sbb.min);
  EXPECT_EQ(model.materials[0].material.color, (std::array<float, 3>{0.8f, 0.1f, 0.2f}));
  EXPECT_EQ(model.shapes[0].mesh->ends.size(), 5u);
  EXPECT_EQ(model.shapes[1].mesh->ends.size(), 1u);
}

TEST_F(ImportTest, ColoursBeyondOneAreCutAndTold) {
  write("bytes.mtl", "newmtl red\nKd 255 20 0\n");
  const modeler::Model model = import(write("two words.obj", "mtllib bytes.mtl\nusemtl red\n" + obj_box()));
  EXPECT_EQ(model.materials[0].material.color, (std::array<float, 3>{1, 1, 0}));
  EXPECT_EQ(not_read(), std::vector<std::string>{"1 colour beyond 0 to 1: cut to that (another: mars model " +
                                                 (folder_ / "model.json").string() +
                                                 " set 'two words' --material color --color 0.8 0.6 0.4)"});
}

TEST_F(ImportTest, FacesThatCannotBeReadAsTheyStandAreMended) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nf 1 2 2\nf 1 3 2 4\nf 1 2 5\n";
  const modeler::Mesh mesh = import(write("odd.obj", text)).shapes[0].mesh.value();
  EXPECT_EQ(mesh.face(0).size(), 4u);
  EXPECT_EQ(mesh.ends.size(), 4u) << "a quad, a bow tie in two triangles, one without area; the line is left out";
}

TEST_F(ImportTest, AFlatMeshHasABoxAllTheSame) {
  const modeler::Model model = import_upright(write("flat.obj", "v 0 0 3\nv 2 0 3\nv 0 2 3\nf 1 2 3\n"), "z");
  EXPECT_EQ(model.joints[0].segment->sbb.max, glm::dvec3(2, 2, 4));
  EXPECT_TRUE(document::holds(told_, "  box        2 x 2 x 0 units, the file's z upward\n")) << told_;
}

TEST_F(ImportTest, BadFilesAreOneClearFailure) {
  EXPECT_TRUE(document::holds(failure("a.obj", ""), "a.obj: is empty ("));
  EXPECT_TRUE(document::holds(failure("a.stl", "solid x\nfacet"), "mesh file"));
  EXPECT_TRUE(document::holds(failure("a.glb", "glTF and then nothing"), "is no sound mesh file"));
  EXPECT_TRUE(document::holds(failure("a.gltf", "{\"asset\": "), "is no sound mesh file"));
  EXPECT_TRUE(document::holds(failure("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "has no faces"));
  EXPECT_TRUE(document::holds(failure("a.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n"), "within 1e9"));
  for (const std::string number : {"nan", "1e999"}) {
    const std::string reported = failure("a.obj", "v 0 0 0\nv " + number + " 3 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_TRUE(
        document::holds(reported, "has a vertex that is not at numbers, or at too large ones (the file may be damaged"))
        << reported;
  }
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options_for(folder_ / "no.obj")); }), "no.obj"));
  ImportOptions options = options_for(write("b.obj", obj_box()));
  options.joint = "a/b";
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }), "'/'"));
  options.joint = "caf\xe9";
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }), "'caf?': cannot name a joint"))
      << "no UTF-8";
  const fs::path lines = write("a b\nc.obj", obj_box());
  EXPECT_TRUE(document::holds(
      document::failure_of([&] { import_model(options_for(lines)); }),
      "a b?c.obj: its name, 'a b?c', cannot name a joint (give the joint a name with --joint: one of 1"));
  options.to = folder_ / "x/m.json";
  options.joint = "";
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }), "m.json"));
}

TEST_F(ImportTest, WhatIsNoFileIsRefusedAtOnce) {
  for (const char* name : {"pipe.obj", "pipe.ply", "pipe.glb", "pipe.gltf", "pipe.bpt"}) {
    ASSERT_EQ(mkfifo((folder_ / name).c_str(), 0600), 0);
    EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options_for(folder_ / name)); }),
                                "is not a regular file"));
  }
}

// Nobody writes into the pipe, the device has no end.
TEST_F(ImportTest, WhatAMeshNamesMustBeAFile) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  fs::create_directory(folder_ / "folder");
  fs::create_symlink("/dev/zero", folder_ / "device");
  for (const std::string name : {"pipe", "folder", "device"}) {
    const std::string says = name == "pipe"     ? "pipe: is not a regular file"
                             : name == "folder" ? "folder: is a directory, not a file"
                                                : "names 'device', a link that leads out of its folder";
    const std::string obj = failure("names.obj", "mtllib " + name + "\n" + obj_box());
    EXPECT_TRUE(document::holds(obj, says)) << obj;
    std::string text = gltf_figure();
    text.replace(text.find("figure.bin"), 10, name);
    const std::string gltf = failure("names.gltf", text);
    EXPECT_TRUE(document::holds(gltf, says)) << gltf;
  }
  EXPECT_TRUE(document::holds(failure("lost.gltf", gltf_figure()), "figure.bin: cannot be read ("));
}

TEST_F(ImportTest, WhyAMeshIsNotSoundIsSaidInOurWords) {
  const std::string lines = failure("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\n");
  EXPECT_TRUE(document::holds(lines, "is no sound mesh file: a face has two corners (export it again")) << lines;
  const std::string points = failure("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n# no more\n");
  EXPECT_TRUE(document::holds(points, "is no sound mesh file: a mesh has no faces (")) << points;
  const std::string empty = failure("a.gltf", R"({"asset": {"version": "2.0"}})");
  EXPECT_TRUE(document::holds(empty, "is no sound mesh file: it has no scene (")) << empty;
  for (const std::string& text : {std::string("v 0 0 0\nf 1 2 9\n"), std::string("{"), std::string(9, '\xff')}) {
    for (const char* name : {"b.obj", "b.stl", "b.gltf", "b.glb"}) {
      if (text == "{" && document::holds(name, "glb")) continue;  // its name is reported to be wrong
      const std::string reported = failure(name, text);
      for (const char* theirs :
           {"aiMesh", "aiScene", "suitable reader", "Validation", "OBJ:", "GLTF:", "STL:", "JSON parse"})
        EXPECT_FALSE(document::holds(reported.substr(reported.find(": ")), theirs)) << reported;
    }
  }
}

TEST_F(ImportTest, AFileThatWasReadBesidesIsNotOverwritten) {
  ImportOptions options = options_for(write("wedge.obj", "mtllib wedge.mtl\n" + obj_box()));
  options.to = write("wedge.mtl", "newmtl a\n");
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }),
                              "wedge.mtl: is the file that is read (write to another)"));
  EXPECT_EQ(document::read_file(options.to).size(), 9u);
}

TEST_F(ImportTest, OutputsAreNotNamedAsOtherProgramsFiles) {
  ImportOptions options = options_for(write("wedge.obj", obj_box()));
  options.to = folder_ / "wedge.glb";
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }),
                              "wedge.glb: has the ending of another program's file (end its name in .json"));
  EXPECT_FALSE(fs::exists(options.to));
}

TEST_F(ImportTest, GltfOfVersion1IsOneClearFailure) {
  ImportOptions options = options_for(write("one.gltf", R"({"asset": {"version": "1.0.2"}, "nodes": {"a": {}}})"));
  for (const ImportAs as : {ImportAs::model, ImportAs::film}) {
    options.as = as;
    EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }),
                                "one.gltf: is glTF of version 1 (export it as glTF 2.0)"));
  }
}

// Both bones stand for the joint of the box, so neither can be a limb.
TEST_F(ImportTest, BonesOfOneJointAreNoLimbs) {
  const std::string vrm = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
      "nodes": [{"mesh": 0, "children": [1, 2]}, {"name": "a"}, {"name": "b"}],
      "extensions": {"VRMC_vrm": {"humanoid": {"humanBones": {"leftUpperArm": {"node": 1}, "leftLowerArm": {"node": 2}}}}},
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const ImportOptions options = options_for(write("figure.gltf", vrm));
  import_model(options);
  EXPECT_EQ(modeler::load_model(options.to).joints.size(), 1u);
}

TEST_F(ImportTest, FilesOutsideOfTheFolderAreNotRead) {
  const auto gltf = [](const std::string& uri) {
    return R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes":
      [{"primitives": [{"attributes": {"POSITION": 0}}]}], "accessors": [{"bufferView": 0, "componentType": 5126,
      "count": 3, "type": "VEC3"}], "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36,
      "uri": ")" +
           uri + "\"}]}";
  };
  const std::string path = write("beside.bin", std::string(36, '\0')).string();
  for (const std::string& uri : {std::string("../beside.bin"), std::string("a/%2e%2e/../beside.bin"), path})
    EXPECT_TRUE(document::holds(failure("far.gltf", gltf(uri)), "which is outside of its folder (put that file beside"))
        << uri;
  EXPECT_TRUE(document::holds(failure("far.obj", "mtllib ../far.mtl\n" + obj_box()), "is outside of its folder"));
  EXPECT_TRUE(document::holds(failure("far.obj", "mtllib /etc/far.mtl\n" + obj_box()),
                              "names '/etc/far.mtl', which is outside of its folder"));
  const test::TemporaryFolder other;
  std::ofstream(other / "far.bin") << std::string(36, '\0');
  std::ofstream(other / "far.mtl") << "newmtl a\n";
  std::filesystem::create_symlink(other / "far.bin", folder_ / "link.bin");
  std::filesystem::create_symlink(other / "far.mtl", folder_ / "link.mtl");
  std::filesystem::create_directory_symlink(other.path(), folder_ / "links");
  for (const char* uri : {"link.bin", "links/far.bin"})
    EXPECT_TRUE(document::holds(failure("far.gltf", gltf(uri)), "a link that leads out of its folder")) << uri;
  EXPECT_TRUE(
      document::holds(failure("far.obj", "mtllib link.mtl\n" + obj_box()), "names 'link.mtl', a link that leads"));
  std::filesystem::create_symlink("beside.bin", folder_ / "near.bin");
  EXPECT_FALSE(document::holds(failure("near.gltf", gltf("near.bin")), "near.bin")) << "which stays inside";
}

TEST_F(ImportTest, OtherEndingsAreRefusedByName) {
  EXPECT_TRUE(document::holds(failure("a.BLEND", "x"),
                              "is a Blender scene, which cannot be imported (open it in Blender and export glTF)"));
  EXPECT_TRUE(document::holds(failure("a.usd", "x"), "USD"));
  EXPECT_TRUE(document::holds(failure("a.xyz", "x"), "has an ending that is not known, .xyz (mesh files end in .obj"));
  EXPECT_TRUE(document::holds(failure("teapot", "x"), "has no ending"));
}

TEST_F(ImportTest, AFileOfAnotherKindThanItsNameSaysIsToldSo) {
  EXPECT_TRUE(document::holds(failure("a.obj", ply_box()),
                              "is PLY, though its name does not say so (let its name end in .ply)"));
  EXPECT_TRUE(document::holds(failure("a.gltf", "glTF\2"), "let its name end in .glb"));
  EXPECT_TRUE(document::holds(failure("a.glb", "{}"), "let its name end in .gltf"));
}

TEST_F(ImportTest, NamesAreEscaped) {
  ImportOptions options = options_for(write("b.obj", obj_box()));
  options.joint = "a \"b\" \\ c\xc3\xa9";
  EXPECT_EQ(import(options).joints[0].name, options.joint);
}

// Without normals that would turn faces: a file that is not mirrored keeps its volume's sign.
TEST_F(ImportTest, TheAxisThatPointsUpBecomesZ) {
  const fs::path obj = write("box.obj", obj_box()), ply = write("box.ply", ply_box());
  const auto box = [&](const modeler::Model& model) {
    EXPECT_NEAR(volume(model.shapes[0].mesh.value()), 6, 1e-6);
    return std::pair(model.joints[0].segment->sbb.min, model.joints[0].segment->sbb.max);
  };
  const auto y_up = std::pair(glm::dvec3(1, -7, 1), glm::dvec3(3, -1, 5));
  EXPECT_EQ(box(import(obj)), y_up) << "OBJ stands upright";
  EXPECT_EQ(box(import_upright(ply, "y")), y_up);
  EXPECT_EQ(box(import(ply)), std::pair(glm::dvec3(1, 1, 1), glm::dvec3(3, 5, 7)));
  EXPECT_EQ(box(import_upright(obj, "x")), std::pair(glm::dvec3(-5, -7, 1), glm::dvec3(-1, -1, 3)));
}

TEST_F(ImportTest, ScaleIsTheBoxes) {
  ImportOptions options = options_for(write("box.ply", ply_box()));
  options.size.scale = 0.5;
  const modeler::Model model = import(options);
  EXPECT_EQ(model.joints[0].segment->sbb.max, glm::dvec3(1.5, 2.5, 3.5));
  EXPECT_EQ(model.shapes[0].mesh, import(write("box.ply", ply_box())).shapes[0].mesh);
  options.size.scale = 1e9;
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }), "with a smaller --scale"));
}

TEST_F(ImportTest, CreaseStandsInPlaceOfNormals) {
  std::string text = obj_box() + "vn 0 0 1\n";
  for (std::size_t at = text.find("\nf"); (at = text.find(' ', at)) != std::string::npos && at < text.find("\nvn");)
    text.insert(text.find_first_of(" \n", at + 1), "//1"), ++at;
  ImportOptions options = options_for(write("box.obj", text));
  EXPECT_FALSE(import(options).shapes[0].mesh->normals.empty());
  EXPECT_TRUE(document::holds(told_, ", normals")) << told_;
  options.crease = 95;
  const modeler::Model smooth = import(options);
  EXPECT_TRUE(smooth.shapes[0].mesh->normals.empty());
  EXPECT_EQ(smooth.shapes[0].mesh->crease, 95);
  EXPECT_EQ(not_read(), std::vector<std::string>{"normals (--crease makes others)"});
}

TEST_F(ImportTest, AFileThatIsThereIsReplacedOnlyByForce) {
  ImportOptions options = options_for(write("box.obj", obj_box()));
  options.force = false;
  import_model(options);
  std::ofstream(options.to) << "mine";
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }),
                              "model.json: is there already (choose another name, or replace it with --force)"));
  EXPECT_EQ(document::read_file(options.to).size(), 4u);
  options.force = true;
  EXPECT_EQ(import(options).joints.size(), 1u);
}

// Scanned models that programs of old wrote: Assimp made one triangle of them.
TEST_F(ImportTest, AModelInStripsKeepsItsBody) {
  constexpr int kRows = 40;
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(2 * kRows) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
                     "property list int int vertex_indices\nend_header\n",
              strip;
  for (int i = 0; i < 2 * kRows; ++i) {
    text += std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0\n";
    strip += " " + std::to_string(i);
  }
  import(write("strip.ply", text + std::to_string(2 * kRows) + strip + "\n"));
  EXPECT_TRUE(document::holds(told_, "80 vertices, 78 faces")) << told_;
}

TEST_F(ImportTest, BuffersBesideAFileCountAsItsSize) {
  const fs::path gltf = write("figure.gltf", gltf_figure());
  EXPECT_EQ(bytes_of_buffers(gltf), 0u);
  write("figure.bin", gltf_numbers());
  EXPECT_EQ(bytes_of_buffers(gltf), 256u);
  write("a figure.bin", gltf_numbers());
  EXPECT_EQ(bytes_of_buffers(write("spaced.gltf", R"({"buffers": [{"uri": "a%20figure.bin"}, {"uri": "%zz"}]})")),
            256u);
}

TEST_F(ImportTest, WhatIsNotReadIsListed) {
  write("figure.bin", gltf_numbers());
  import(write("figure.gltf", gltf_figure()));
  EXPECT_TRUE(document::holds(told_, "  read       3 vertices, 1 face, 1 colour\n")) << told_;
  const std::vector<std::string> list = not_read();
  for (const char* part : {"1 animation", "1 morph target", "1 texture (", "texture skin.png (no such file", "1 camera",
                           "1 light", "1 mesh outside the scene"})
    EXPECT_EQ(
        std::count_if(list.begin(), list.end(), [&](const std::string& line) { return line.rfind(part, 0) == 0; }), 1)
        << part << " in\n"
        << told_;
  EXPECT_EQ(list.size(), 7u) << told_;
  EXPECT_TRUE(document::holds(told_, "kept       3 places u,v in images, 3 vertices' colours (no picture")) << told_;
}

TEST_F(ImportTest, ColoursOfAFileThatIsMissingAreTold) {
  import(write("box.obj", "mtllib " + std::string(300, 'x') + "\n" + obj_box()));
  EXPECT_TRUE(document::holds(told_, "no such file beside the mesh")) << "a name that is too long for any file";
  import(write("box.obj", "mtllib lost.mtl\n" + obj_box() + "l 1 2\n"));
  EXPECT_EQ(not_read(), (std::vector<std::string>{"1 line", "colours of lost.mtl (no such file beside the mesh)"}));
}

// Assimp leaves out faces without a word: one that names a vertex beyond the last, one after a space.
TEST_F(ImportTest, FacesThatAreLostAreAFailure) {
  EXPECT_TRUE(document::holds(failure("a.obj", obj_box() + " f 1 2 3\n"), "promises 7 faces, 6 were read"));
  std::string numbers = gltf_numbers();
  numbers[36] = 7;
  write("figure.bin", numbers);
  std::string text = gltf_figure();
  text.insert(text.find("\"material\": 0"), "\"indices\": 8, ");
  text.insert(text.find("],\n\"bufferViews\""),
              ",\n{\"bufferView\": 1, \"componentType\": 5121, \"count\": 6, \"type\": \"SCALAR\"}");
  EXPECT_TRUE(document::holds(failure("a.gltf", text), "faces, 1 was read")) << text;
}

TEST_F(ImportTest, PackedShapesAreRefused) {
  std::string text = gltf_figure();
  text.insert(1, "\"extensionsRequired\": [\"KHR_meshopt_compression\"], ");
  EXPECT_TRUE(
      document::holds(failure("a.gltf", text), "has its shapes packed as KHR_meshopt_compression (export it with"));
}

// glTF's colours are amounts of light, a model's are sRGB as people pick them: light of 0.214 is shown as 0.5.
TEST_F(ImportTest, ColorsOfGltfAreEncoded) {
  write("figure.bin", gltf_numbers());
  std::string text = gltf_figure();
  const std::string texture = R"("baseColorTexture": {"index": 0})";
  text.replace(text.find(texture), texture.size(), R"("baseColorFactor": [0.214041, 0.002, 1, 1])");
  const modeler::Model model = import(write("figure.gltf", text));
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].material.color, (std::array<float, 3>{0.5f, 0.026f, 1}));
}

// A file of half a kilobyte that promises 200 million vertices, all but one of them at the origin.
TEST_F(ImportTest, AFileThatTakesAllMemoryIsOneClearFailure) {
  if (sanitizers::kSanitized) GTEST_SKIP() << "a sanitizer ends a process that gets no memory";
  write("figure.bin", gltf_numbers());
  std::string text = gltf_figure();
  const std::string others = R"(, "JOINTS_0": 1, "WEIGHTS_0": 2, "COLOR_0": 3, "TEXCOORD_0": 4)";
  text.erase(text.find(others), others.size());
  const std::string count = "\"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\", \"min\"";
  text.replace(
      text.find("\"bufferView\": 0, " + count), 17 + count.size(),
      "\"componentType\": 5126, \"count\": 200000000, \"type\": \"VEC3\", \"sparse\": {\"count\": 1, \"indices\": "
      "{\"bufferView\": 1, \"componentType\": 5121}, \"values\": {\"bufferView\": 0}}, \"min\"");
  EXPECT_TRUE(document::holds(failure("a.gltf", text), "takes more than 1024 MiB of memory to read"));
}

TEST_F(ImportTest, PatchFilesAreModelsToo) {
  std::string text = "1\n3 3\n";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) text += std::to_string(10 + 2 * i) + " " + std::to_string(-j) + " 7\n";
  const fs::path from = write("in.bpt", text);
  const modeler::Model model = import(from);
  ASSERT_EQ(model.joints.size(), 1u);
  EXPECT_EQ(model.joints[0].name, "in");
  EXPECT_EQ(model.joints[0].segment->sbb.min, glm::dvec3(10, -3, 7));
  EXPECT_EQ(model.shapes[0].patches[0].points, modeler::read_patch_file(from).patches[0].points);
  EXPECT_TRUE(document::holds(told_, "  read       1 patch\n  not read   nothing")) << told_;
  ImportOptions options = options_for(from);
  options.up = "y";
  options.size.scale = 2;
  const modeler::Box box = import(options).joints[0].segment->sbb;
  EXPECT_EQ(box.min, glm::dvec3(20, -14, -6));
  EXPECT_EQ(box.max, glm::dvec3(32, -13, 0)) << "flat: one unit thick";
  EXPECT_TRUE(document::holds(told_, "  box        12 x 0 x 6 units, the file's y upward\n")) << told_;
  options.crease = 30;
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }), "leave out --crease"));
}

TEST_F(ImportTest, TheFileItselfIsNotOverwritten) {
  const fs::path from = write("in.bpt", "1\n");
  ImportOptions options = options_for(from);
  options.to = from;
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options); }),
                              "is the file that is read (write to another)"));
  EXPECT_EQ(document::read_file(from).size(), 2u);
}

}  // namespace
}  // namespace mars::importer
