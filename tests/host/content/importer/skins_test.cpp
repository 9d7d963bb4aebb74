// Skins of glTF files: whatever pose the joints of the model are given, its vertices stand where glTF's formula puts
// them (section 3.7.3), in doubles, when the file's nodes are turned alike.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "host/content/modeler/bent_skin.h"
#include "host/content/modeler/frames.h"
#include "host/content/modeler/read_model.h"
#include "tests/host/content/importer/glb.h"
#include "tests/host/content/importer/import_folder.h"

namespace mars::importer {
namespace {

using nlohmann::json;
using Places = std::vector<glm::dvec3>;
using Poses = std::map<std::string, glm::dvec3>;  // of joints by name, degrees

// A GLB file by glTF's rules, read plainly: one mesh with one skin.
class PlainSkin {
 public:
  explicit PlainSkin(const std::string& bytes) {
    std::uint32_t length;
    std::memcpy(&length, &bytes[12], 4);
    json_ = json::parse(bytes.substr(20, length));
    buffer_ = bytes.substr(28 + length);
  }

  // With nodes turned about their own axes, in metres, y up.
  Places places(const Poses& poses) const {
    std::size_t skinned = 0;
    while (!json_["nodes"][skinned].contains("skin")) ++skinned;
    const json& node = json_["nodes"][skinned];
    const json& skin = json_["skins"][node["skin"].get<std::size_t>()];
    const json& attributes = json_["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0]["attributes"];
    const auto inverse = numbers(skin["inverseBindMatrices"]), at = numbers(attributes["POSITION"]),
               joints = numbers(attributes["JOINTS_0"]), weights = numbers(attributes["WEIGHTS_0"]);
    std::vector<glm::dmat4> bones;
    for (std::size_t i = 0; i < skin["joints"].size(); ++i) {
      glm::dmat4 bind;
      for (int k = 0; k < 16; ++k) bind[k / 4][k % 4] = inverse[16 * i + static_cast<std::size_t>(k)];
      bones.push_back(global(skin["joints"][i].get<std::size_t>(), poses) * bind);
    }
    Places places;
    for (std::size_t v = 0; v < at.size() / 3; ++v) {
      glm::dvec4 sum(0);
      double all = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const double weight = weights[4 * v + k];
        all += weight;
        sum += weight * (bones[static_cast<std::size_t>(joints[4 * v + k])] *
                         glm::dvec4(at[3 * v], at[3 * v + 1], at[3 * v + 2], 1));
      }
      places.emplace_back(sum / all);
    }
    return places;
  }

  // The axes of a node at rest, as a joint has them that is no limb: x, -z and y of the file's.
  glm::dmat3 axes_of(const std::string& name) const {
    std::size_t number = 0;
    while (json_["nodes"][number].value("name", "") != name) ++number;
    const glm::dmat4 node = global(number, {});
    const auto upright = [](const glm::dvec4& axis) { return glm::normalize(glm::dvec3(axis.x, -axis.z, axis.y)); };
    return {upright(node[0]), upright(-node[2]), upright(node[1])};
  }

 private:
  std::vector<double> numbers(const json& number) const {
    const json& accessor = json_["accessors"][number.get<std::size_t>()];
    const json& view = json_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const std::map<int, std::size_t> sizes = {{5121, 1}, {5123, 2}, {5126, 4}};
    const std::size_t width = widths.at(accessor["type"]), size = sizes.at(accessor["componentType"]);
    const std::size_t stride = view.value("byteStride", width * size);
    const std::size_t first = view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
    std::vector<double> numbers;
    for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i)
      for (std::size_t k = 0; k < width; ++k)
        numbers.push_back(number_at(&buffer_[first + i * stride + k * size], size));
    return numbers;
  }

  static double number_at(const char* bytes, std::size_t size) {
    if (size == 4) {
      float number;
      std::memcpy(&number, bytes, 4);
      return number;
    }
    std::uint16_t number = 0;
    std::memcpy(&number, bytes, size);
    return number;
  }

  glm::dmat4 local(const json& node, const Poses& poses) const {
    glm::dmat4 matrix(1);
    if (node.contains("matrix"))
      for (int k = 0; k < 16; ++k) matrix[k / 4][k % 4] = node["matrix"][static_cast<std::size_t>(k)];
    if (node.contains("translation"))
      for (int k = 0; k < 3; ++k) matrix[3][k] = node["translation"][static_cast<std::size_t>(k)];
    if (node.contains("rotation")) {
      const json& q = node["rotation"];
      matrix = matrix * glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
    }
    if (const auto pose = poses.find(node.value("name", "")); pose != poses.end())
      for (int axis = 0; axis < 3; ++axis) {
        // A joint's x, y and z are the file's x, -z and y, for z is up in MARS.
        const glm::dvec3 about = axis == 0   ? glm::dvec3(1, 0, 0)
                                 : axis == 1 ? glm::dvec3(0, 0, -1)
                                             : glm::dvec3(0, 1, 0);
        matrix = matrix * glm::mat4_cast(glm::angleAxis(glm::radians(pose->second[axis]), about));
      }
    if (node.contains("scale"))
      for (int k = 0; k < 3; ++k) matrix[k] *= node["scale"][static_cast<std::size_t>(k)].get<double>();
    return matrix;
  }

  glm::dmat4 global(std::size_t number, const Poses& poses) const {
    for (std::size_t above = 0; above < json_["nodes"].size(); ++above)
      for (const json& child : json_["nodes"][above].value("children", json::array()))
        if (child == number) return global(above, poses) * local(json_["nodes"][number], poses);
    return local(json_["nodes"][number], poses);
  }

  json json_;
  std::string buffer_;
};

// Of the model's skin, which its first joint has.
Places posed(const modeler::Model& model, const Poses& poses) {
  std::vector<modeler::Axes> frames;
  for (const modeler::Joint& joint : model.joints) {
    const modeler::Axes parent = joint.parent == modeler::kNone ? modeler::Axes{} : frames[joint.parent];
    const auto pose = poses.find(joint.name);
    const glm::dmat3 turn = modeler::orientation(joint, pose == poses.end() ? joint.rest() : pose->second);
    frames.push_back({parent.turn * turn, parent.turn * joint.place + parent.place});
  }
  const modeler::Joint& skinned = model.joints.front();
  std::vector<wire::Matrix> bones;
  for (const modeler::Bone& bone : skinned.segment->bones)
    bones.push_back(modeler::bone_matrix(frames[bone.joint], bone, skinned));
  const modeler::Mesh& mesh = *model.shapes[skinned.segment->shape].mesh;
  Places places;
  const modeler::BentSkin skin(bones, skinned.segment->blend);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    places.push_back(skin.place_of(mesh.vertices[v], mesh.bones[v]));
  return places;
}

// The file with names for all of its nodes: "n0", ...
std::string with_names(const std::string& glb) {
  std::uint32_t length;
  std::memcpy(&length, &glb[12], 4);
  json file = json::parse(glb.substr(20, length));
  for (std::size_t node = 0; node < file["nodes"].size(); ++node)
    file["nodes"][node]["name"] = "n" + std::to_string(node);
  std::string text = file.dump();
  text.append((4 - text.size() % 4) % 4, ' ');
  const auto size = [](std::size_t number) {
    const auto little = static_cast<std::uint32_t>(number);
    return std::string(reinterpret_cast<const char*>(&little), 4);
  };
  const std::string rest = glb.substr(20 + length);
  return glb.substr(0, 8) + size(20 + text.size() + rest.size()) + size(text.size()) + "JSON" + text + rest;
}

// The numbers of joints that turn as nodes do: limbs have axes of their own.
Poses for_joints(const modeler::Model& model, const PlainSkin& file, const Poses& poses) {
  Poses turned;
  for (const auto& [name, pose] : poses) {
    const auto joint = std::ranges::find(model.joints, name, &modeler::Joint::name);
    const glm::dmat3 node = file.axes_of(name), own = modeler::segment_axes(*joint);
    turned[name] = pose;
    if (glm::distance(node[0], own[0]) + glm::distance(node[1], own[1]) < 1e-4) continue;
    const glm::dmat3 m =
        glm::transpose(own) * node * modeler::orientation({}, pose) * glm::transpose(node) * own;  // Rx Ry Rz
    turned[name] = glm::degrees(glm::dvec3(std::atan2(-m[2][1], m[2][2]), std::asin(std::clamp(m[2][0], -1.0, 1.0)),
                                           std::atan2(-m[1][0], m[0][0])));
  }
  return turned;
}

class SkinsTest : public ImportFolder {
 protected:
  // That each vertex of the file is one of the model's, within 1e-5 of the height; MARS has z up.
  void expect_as_in_the_file(const std::string& bytes, const std::vector<Poses>& all) const {
    ImportOptions options = options_for(write("file.glb", bytes));
    options.front = "x";
    printed_ = import_model(options);
    const modeler::Model model = modeler::load_model(options.to);
    const modeler::Box box = *modeler::rest_bounds(model);
    const double height = box.max.z - box.min.z;
    for (const Poses& poses : all) {
      const PlainSkin file(bytes);
      const Places found = posed(model, for_joints(model, file, poses));
      double worst = 0;
      for (const glm::dvec3& place : file.places(poses)) {
        const glm::dvec3 upright(place.x, -place.z, place.y);
        double nearest = 1e9;
        for (const glm::dvec3& other : found) nearest = std::min(nearest, glm::distance(upright, other));
        worst = std::max(worst, nearest);
      }
      EXPECT_LT(worst, 1e-5 * height) << poses.size() << " joints turned";
    }
  }

  mutable std::string printed_;
};

// A chain of three bones under a node that scales and turns, bound in another pose than the file's nodes stand in; the
// middle one scaled, and the last weights of one vertex too many.
std::string handmade() {
  test::Glb glb;
  const int joints = glb.bytes("VEC4", {0, 1, 2, 0, 0, 1, 0, 0, 1, 2, 0, 0}),
            weights = glb.floats("VEC4", {0.2f, 0.3f, 0.5f, 0, 0.9f, 0.1f, 0, 0, 0.4f, 0.6f, 0, 0});
  const int mesh = glb.triangle({0.3f, 0, 0.1f, 0.2f, 0.1f, 1.8f, -0.2f, 0.3f, 0.9f},
                                {{"JOINTS_0", joints}, {"WEIGHTS_0", weights}});
  const int inverse = glb.floats("MAT4", {1, 0, 0, 0, 0,  1, 0, 0, 0, 0, 1, 0, 0,    0,    -1,    1,  //
                                          0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0,    0.1f, -1.5f, 1,  //
                                          1, 0, 0, 0, 0,  1, 0, 0, 0, 0, 1, 0, 0.2f, 0,    -1.7f, 1});
  glb.json["nodes"] = {{{"name", "root"}, {"scale", {2, 2, 2}}, {"rotation", {-0.6, 0, 0, 0.8}}, {"children", {1, 2}}},
                       {{"name", "body"}, {"mesh", mesh}, {"skin", 0}, {"translation", {7, 8, 9}}},
                       {{"name", "hip"}, {"translation", {0, 0, 1}}, {"children", {3}}},
                       {{"name", "chest"},
                        {"translation", {0.1, 0, 0.5}},
                        {"rotation", {0, 0.6, 0, 0.8}},
                        {"scale", {0.5, 0.5, 0.5}},
                        {"children", {4}}},
                       {{"name", "head"}, {"translation", {0, 0.2, 0.8}}}};
  glb.json["skins"] = {{{"joints", {2, 3, 4}}, {"inverseBindMatrices", inverse}}};
  return glb.file();
}

TEST_F(SkinsTest, AHandmadeFileInSeveralPoses) {
  expect_as_in_the_file(
      handmade(),
      {{}, {{"chest", {40, 0, 0}}}, {{"hip", {10, -70, 30}}, {"chest", {0, 90, -20}}, {"head", {-30, 5, 120}}}});
  EXPECT_NE(printed_.find("a skin, which 3 joints move, of 1 mesh"), std::string::npos) << printed_;
}

TEST_F(SkinsTest, TheKhronosFigureInSeveralPoses) {
  const auto data = std::filesystem::path(MARS_SOURCE_DIR) / "../shared/data";
  if (!std::filesystem::exists(data / "RiggedFigure.glb")) GTEST_SKIP() << "no files in " << data;
  std::ifstream file(data / "RiggedFigure.glb", std::ios::binary);
  const std::string bytes = with_names({std::istreambuf_iterator<char>(file), {}});
  expect_as_in_the_file(bytes, {{},
                                {{"n4", {0, 80, 0}}, {"n14", {30, 20, 100}}, {"n18", {0, 0, -60}}},
                                {{"n11", {20, 10, 0}}, {"n19", {0, 45, 30}}, {"n8", {-90, 0, 15}}}});
}

// Five bones at a vertex: the four heaviest count, and the report has the fifth.
TEST_F(SkinsTest, MoreThanFourBonesAreCounted) {
  test::Glb glb;
  const int four = glb.bytes("VEC4", {0, 1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0}),
            more = glb.bytes("VEC4", {4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}),
            heavy = glb.floats("VEC4", {0.3f, 0.2f, 0.2f, 0.2f, 1, 0, 0, 0, 1, 0, 0, 0}),
            light = glb.floats("VEC4", {0.1f, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  const int mesh = glb.triangle({0, 0, 0, 1, 0, 0, 0, 1, 0},
                                {{"JOINTS_0", four}, {"WEIGHTS_0", heavy}, {"JOINTS_1", more}, {"WEIGHTS_1", light}});
  std::vector<float> inverse;
  for (int bone = 0; bone < 5; ++bone)
    for (int k = 0; k < 16; ++k) inverse.push_back(k % 5 == 0 ? 1 : 0);
  const int binds = glb.floats("MAT4", inverse);
  glb.json["nodes"] = {{{"name", "body"}, {"mesh", mesh}, {"skin", 0}, {"children", {1, 2, 3, 4, 5}}}};
  for (int bone = 0; bone < 5; ++bone) glb.json["nodes"].push_back({{"name", "bone" + std::to_string(bone)}});
  glb.json["skins"] = {{{"joints", {1, 2, 3, 4, 5}}, {"inverseBindMatrices", binds}}};
  const std::string printed = import_model(options_for(write("file.glb", glb.file())));
  EXPECT_NE(printed.find("1 weight of vertices that follow more than 4 bones"), std::string::npos) << printed;
}

}  // namespace
}  // namespace mars::importer
