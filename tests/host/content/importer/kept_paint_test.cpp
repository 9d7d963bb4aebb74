// What imports keep for the day when surfaces show it: places in images, colours of vertices, images. And that keeping
// them changes no vertex and no face.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "host/content/modeler/read_model.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/importer/glb.h"
#include "tests/host/content/importer/import_folder.h"

namespace mars::importer {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kPng = "\x89PNG\r\n\x1a\n and what else a picture has";
const std::string kJpeg = "\xff\xd8\xff and what else a photograph has";

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class KeptPaintTest : public ImportFolder {
 protected:
  // The model file's JSON, which is a sound model's.
  json import(const fs::path& from, bool force = true) const {
    ImportOptions options = options_for(from);
    options.force = force;
    printed_ = import_model(options);
    modeler::load_model(options.to);
    return json::parse(bytes_of(options.to));
  }
  std::string failure(const fs::path& from, bool force) const {
    return document::failure_of([&] { import(from, force); });
  }
  // Two triangles with one colour and two places in the image at one of their vertices.
  fs::path square(bool with_places) const {
    write("wall.mtl", "newmtl wall\nKd 1 1 1\nmap_Kd stone wall.png\n");
    std::string text = "mtllib wall.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nusemtl wall\n";
    if (with_places) text += "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\n";
    return write("square.obj", text + (with_places ? "f 1/1 2/2 3/3\nf 1/5 3/3 4/4\n" : "f 1 2 3\nf 1 3 4\n"));
  }

  mutable std::string printed_;
};

TEST_F(KeptPaintTest, PlacesInImagesSplitNoVertex) {
  write("stone wall.png", kPng);
  const json plain = import(square(false)).at("shapes").at("imported").at("mesh");
  EXPECT_FALSE(plain.contains("uv"));
  EXPECT_FALSE(plain.contains("paint_faces")) << "each vertex has one colour";
  const json model = import(square(true)), mesh = model.at("shapes").at("imported").at("mesh");
  EXPECT_EQ(mesh.at("vertices"), plain.at("vertices"));
  EXPECT_EQ(mesh.at("faces"), plain.at("faces"));
  EXPECT_EQ(mesh.at("uv"), json::parse("[[0, 0], [1, 0], [1, 1], [0.5, 0.5], [0, 1]]"));
  EXPECT_EQ(mesh.at("colors"), json::parse("[[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0], [1, 1, 1]]"));
  EXPECT_EQ(mesh.at("paint_faces"), json::parse("[[0, 1, 2], [3, 2, 4]]"));
  EXPECT_EQ(model.at("materials").at("color").at("images"), json({{"color", "model-images/stone-wall.png"}}));
  EXPECT_EQ(bytes_of(folder_ / "model-images" / "stone-wall.png"), kPng);
  EXPECT_TRUE(document::holds(
      printed_, "kept       5 places u,v in images, 5 vertices' colours, 1 image in model-images (no picture shows"))
      << printed_;
}

TEST_F(KeptPaintTest, OnlyForceReplacesAnotherImage) {
  write("stone wall.png", kPng);
  fs::create_directory(folder_ / "model-images");
  write("model-images/stone-wall.png", "somebody's own");
  EXPECT_TRUE(document::holds(failure(square(true), false), "stone-wall.png: is there already, with another image"));
  EXPECT_EQ(bytes_of(folder_ / "model-images" / "stone-wall.png"), "somebody's own");
  EXPECT_FALSE(fs::exists(folder_ / "model.json")) << "a model whose images are not there";
  import(square(true));
  EXPECT_EQ(bytes_of(folder_ / "model-images" / "stone-wall.png"), kPng);
  fs::remove(folder_ / "model.json");
  import(square(true), false);  // the same image may be there
  fs::remove(folder_ / "model.json");
  fs::remove_all(folder_ / "model-images");
  write("model-images", "no folder");
  EXPECT_TRUE(document::holds(failure(square(true), false), "model-images: is no folder"));
}

// The second of two images cannot be written.
TEST_F(KeptPaintTest, AnImportThatFailsLeavesNoImage) {
  write("stone.png", kPng);
  write("bumps.png", kPng);
  fs::create_directory(folder_ / "model-images");
  write("model-images/bumps.png", "somebody's own");
  test::Glb glb;
  glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0});
  glb.json["nodes"] = {{{"mesh", 0}}};
  glb.json["meshes"][0]["primitives"][0]["material"] = 0;
  glb.json["materials"] =
      json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 1}}])");
  glb.json["textures"] = json::parse(R"([{"source": 0}, {"source": 1}])");
  glb.json["images"] = json::parse(R"([{"uri": "stone.png"}, {"uri": "bumps.png"}])");
  const std::string problem = failure(write("a.glb", glb.file()), false);
  EXPECT_TRUE(document::holds(problem, "bumps.png: is there already, with another image")) << problem;
  EXPECT_FALSE(fs::exists(folder_ / "model-images" / "stone.png"));
  EXPECT_EQ(bytes_of(folder_ / "model-images" / "bumps.png"), "somebody's own");
  EXPECT_FALSE(fs::exists(folder_ / "model.json"));
}

// v runs down in glTF, and its colours are amounts of light: 0.214041 is shown as 0.5.
TEST_F(KeptPaintTest, GltfsImagesAreWrittenAsTheyAre) {
  test::Glb glb;
  const int uv = glb.floats("VEC2", {0, 0, 1, 0.25, 0.5, 1});
  const int colors = glb.floats("VEC4", {1, 0.214041f, 0, 1, 0, 0, 0, 0.5f, 1, 1, 1, 1});
  glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0}, {{"TEXCOORD_0", uv}, {"COLOR_0", colors}});
  glb.json["nodes"] = {{{"mesh", 0}}};
  glb.json["meshes"][0]["primitives"][0]["material"] = 0;
  glb.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                            {"normalTexture", {{"index", 1}}},
                            {"emissiveTexture", {{"index", 2}}}}};
  glb.json["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 0}}};
  glb.json["images"] = {{{"bufferView", glb.view(kJpeg)}, {"mimeType", "image/jpeg"}}, {{"uri", "bumps.png"}}};
  write("bumps.png", kPng);
  const json model = import(write("a.glb", glb.file())), mesh = model.at("shapes").at("imported").at("mesh");
  EXPECT_EQ(mesh.at("uv"), json::parse("[[0, 1], [1, 0.75], [0.5, 0]]"));
  EXPECT_EQ(mesh.at("colors"), json::parse("[[1, 0.5, 0], [0, 0, 0, 0.5], [1, 1, 1]]"));
  const json images = model.at("materials").at("color").at("images");
  EXPECT_EQ(images.at("glow"), images.at("color")) << "one image is one file";
  EXPECT_EQ(images.at("normal"), "model-images/bumps.png");
  EXPECT_EQ(bytes_of(folder_ / images.at("color").get<std::string>()), kJpeg);
  EXPECT_TRUE(images.at("color").get<std::string>().ends_with(".jpg"));
  EXPECT_EQ(bytes_of(folder_ / "model-images" / "bumps.png"), kPng);
}

TEST_F(KeptPaintTest, PlysVerticesHavePlacesAndColours) {
  const json model = import(write("a.ply",
                                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                  "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                                  "property float s\nproperty float t\nelement face 1\n"
                                  "property list uchar int vertex_indices\nend_header\n"
                                  "0 0 0 255 0 51 0 0.5\n1 0 0 0 0 0 1 2\n0 1 0 255 255 255 nan 0\n3 0 1 2\n"));
  const json mesh = model.at("shapes").at("imported").at("mesh");
  EXPECT_EQ(mesh.at("uv"), json::parse("[[0, 0.5], [1, 2], [0, 0]]")) << "what is no number is 0";
  EXPECT_EQ(mesh.at("colors"), json::parse("[[1, 0, 0.2], [0, 0, 0], [1, 1, 1]]"));
  EXPECT_TRUE(document::holds(printed_, "not read   nothing")) << printed_;
}

}  // namespace
}  // namespace mars::importer
