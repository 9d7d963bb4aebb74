// glTF whose numbers are packed: KHR_mesh_quantization and EXT_meshopt_compression become what plain floats become.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "host/content/modeler/read_model.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/host/content/importer/glb.h"
#include "tests/host/content/importer/import_folder.h"

namespace mars::importer {
namespace {

using nlohmann::json;

class PackedGltfTest : public ImportFolder {
 protected:
  std::string import(test::Glb& glb) const {
    import_model(options_for(write("file.glb", glb.file())));
    modeler::load_model(folder_ / "model.json");
    std::ifstream stream(folder_ / "model.json");
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::string failure(test::Glb& glb) const {
    return document::failure_of([&] { import(glb); });
  }
};

// A square in a node that puts it where it belongs.
test::Glb square(int places, int normals, int uv, int indices, test::Glb glb) {
  glb.json["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", places}, {"NORMAL", normals}, {"TEXCOORD_0", uv}}}, {"indices", indices}}}}}};
  glb.json["nodes"] = {{{"mesh", 0}, {"scale", {2, 3, 4}}, {"translation", {1, 0, 0}}}};
  return glb;
}

const std::vector<std::uint8_t> kSquareCorners{0, 1, 2, 0, 2, 3};
const std::vector<float> kSquareNormals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, kSquareUv{0, 0, 1, 0, 1, 1, 0, 1};

test::Glb plain_square(float side) {
  test::Glb glb;
  const int places = glb.floats("VEC3", {0, 0, 0, side, 0, 0, side, side, 0, 0, side, 0}),
            normals = glb.floats("VEC3", kSquareNormals), uv = glb.floats("VEC2", kSquareUv);
  const int corners = glb.bytes("SCALAR", kSquareCorners);
  return square(places, normals, uv, corners, std::move(glb));
}

// Of shorts of places, in rows of 8 bytes, bytes of normals, in rows of 4, and shorts of u,v.
test::Glb quantized_square(std::int16_t side, bool normalized) {
  test::Glb glb;
  const int places = glb.shorts("VEC4", {0, 0, 0, 0, side, 0, 0, 0, side, side, 0, 0, 0, side, 0, 0}),
            normals = glb.bytes("VEC4", {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}),
            uv = glb.shorts("VEC2", {0, 0, 32767, 0, 32767, 32767, 0, 32767});
  const int corners = glb.bytes("SCALAR", kSquareCorners);
  json& accessors = glb.json["accessors"];
  for (const int each : {places, normals}) {
    accessors[each]["type"] = "VEC3";
    glb.json["bufferViews"][accessors[each]["bufferView"].get<std::size_t>()]["byteStride"] = each == places ? 8 : 4;
  }
  accessors[normals]["componentType"] = 5120;
  accessors[places]["normalized"] = normalized;
  accessors[normals]["normalized"] = accessors[uv]["normalized"] = true;
  glb.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  return square(places, normals, uv, corners, std::move(glb));
}

TEST_F(PackedGltfTest, QuantizedNumbersAreTheirFloats) {
  test::Glb plain = plain_square(1), packed = quantized_square(32767, true);
  EXPECT_EQ(import(packed), import(plain));
  plain = plain_square(500), packed = quantized_square(500, false);
  EXPECT_EQ(import(packed), import(plain));
}

struct Packed {
  const char* mode;
  const char* filter;
  std::size_t count, stride;
  std::string bytes;
};

std::string packed_vertices(const void* vertices, std::size_t count, std::size_t stride) {
  std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
  bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), vertices, count,
                                          stride));
  return bytes;
}

// The number of an accessor whose view has no bytes but in the extension: its own are a fallback's, which has none.
int packed_accessor(test::Glb& glb, const Packed& packed, json accessor) {
  const int view = glb.view(packed.bytes);
  json& made = glb.json["bufferViews"][view];
  const json extension = {{"buffer", 0},
                          {"byteOffset", made["byteOffset"]},
                          {"byteLength", packed.bytes.size()},
                          {"mode", packed.mode},
                          {"filter", packed.filter},
                          {"count", packed.count},
                          {"byteStride", packed.stride}};
  made = {{"buffer", 1},
          {"byteOffset", 0},
          {"byteLength", packed.count * packed.stride},
          {"extensions", {{"EXT_meshopt_compression", extension}}}};
  accessor["bufferView"] = view;
  glb.json["accessors"].push_back(accessor);
  return static_cast<int>(glb.json["accessors"].size()) - 1;
}

test::Glb meshopt_square() {
  test::Glb glb;
  const std::array<float, 12> places{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::array<std::uint32_t, 12> exponents{};
  meshopt_encodeFilterExp(exponents.data(), 4, 12, 15, places.data());
  const std::array<float, 16> up{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::array<std::int8_t, 16> octahedral{};
  meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, up.data());
  const std::array<std::uint16_t, 6> corners{0, 1, 2, 0, 2, 3};
  std::string triangles(meshopt_encodeIndexBufferBound(6, 4), '\0');
  triangles.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(triangles.data()), triangles.size(),
                                             corners.data(), corners.size()));
  const int at = packed_accessor(glb, {"ATTRIBUTES", "EXPONENTIAL", 4, 12, packed_vertices(exponents.data(), 4, 12)},
                                 {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}}),
            normal = packed_accessor(glb, {"ATTRIBUTES", "OCTAHEDRAL", 4, 4, packed_vertices(octahedral.data(), 4, 4)},
                                     {{"componentType", 5120}, {"normalized", true}, {"count", 4}, {"type", "VEC3"}}),
            uv = packed_accessor(glb, {"ATTRIBUTES", "NONE", 4, 8, packed_vertices(kSquareUv.data(), 4, 8)},
                                 {{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}}),
            indices = packed_accessor(glb, {"TRIANGLES", "NONE", 6, 2, triangles},
                                      {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
  glb.json["bufferViews"][1]["byteStride"] = 4;
  glb.json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  return square(at, normal, uv, indices, std::move(glb));
}

// The GLB's own buffer, and a fallback's.
std::string with_fallback(test::Glb& glb) {
  std::string file = glb.file();
  json two = glb.json["buffers"];
  two.push_back({{"byteLength", 100}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  json whole = glb.json;
  whole["buffers"] = two;
  std::string text = whole.dump();
  text.append((4 - text.size() % 4) % 4, ' ');
  std::uint32_t length = 0;
  std::memcpy(&length, file.data() + 12, 4);
  const std::string blob = file.substr(20 + length);
  const auto word = [](std::size_t number) {
    const auto bits = static_cast<std::uint32_t>(number);
    return std::string(reinterpret_cast<const char*>(&bits), 4);
  };
  return "glTF" + word(2) + word(20 + text.size() + blob.size()) + word(text.size()) + "JSON" + text + blob;
}

TEST_F(PackedGltfTest, MeshoptsViewsAreWhatWasPacked) {
  test::Glb plain = plain_square(1), packed = meshopt_square();
  const std::string wanted = import(plain);
  write("file.glb", with_fallback(packed));
  import_model(options_for(folder_ / "file.glb"));
  std::ifstream stream(folder_ / "model.json");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), wanted);
}

TEST_F(PackedGltfTest, DamagedViewsAreOneClearFailure) {
  const auto failure_with = [&](const char* key, const json& value) {
    test::Glb glb = meshopt_square();
    glb.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
    write("file.glb", with_fallback(glb));
    return document::failure_of([&] { import_model(options_for(folder_ / "file.glb")); });
  };
  EXPECT_TRUE(document::holds(failure_with("count", 5), "that do not fit their view"));
  EXPECT_TRUE(document::holds(failure_with("byteStride", 13), "that do not fit their view"));
  EXPECT_TRUE(document::holds(failure_with("byteLength", 7), "has damaged numbers, packed as EXT_meshopt_compression"));
  EXPECT_TRUE(document::holds(failure_with("byteLength", 1 << 20), "beyond the end of its buffer"));
  EXPECT_TRUE(document::holds(failure_with("filter", "OCTAHEDRAL"), "that do not fit their view"));
  EXPECT_TRUE(document::holds(failure_with("mode", "WORDS"), "in a way that is not known"));
  test::Glb odd = meshopt_square();
  odd.json["bufferViews"].push_back(5);
  write("file.glb", with_fallback(odd));
  EXPECT_TRUE(document::holds(document::failure_of([&] { import_model(options_for(folder_ / "file.glb")); }),
                              "has a buffer view that is no object"));
}

}  // namespace
}  // namespace mars::importer
