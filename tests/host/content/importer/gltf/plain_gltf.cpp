#include "tests/host/content/importer/gltf/plain_gltf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

namespace mars::test {
namespace {

using nlohmann::json;
using Value = std::vector<double>;

// Section 3.6.2.2: what whole numbers stand for.
double number_at(const char* bytes, int component, bool normalized) {
  const auto read = [&](auto number) {
    std::memcpy(&number, bytes, sizeof number);
    return double(number);
  };
  switch (component) {
    case 5126: return read(float{});
    case 5122: return normalized ? std::max(read(std::int16_t{}) / 32767, -1.0) : read(std::int16_t{});
    default: return read(std::uint8_t{});
  }
}

Value of_length_1(Value q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& number : q) number /= length;
  return q;
}

// Appendix C.4.
Value slerp(const Value& from, const Value& to, double t) {
  const double d = from[0] * to[0] + from[1] * to[1] + from[2] * to[2] + from[3] * to[3];
  const double a = std::acos(std::min(std::abs(d), 1.0)), s = d < 0 ? -1 : 1;
  if (a < 1e-9) return from;
  Value between;
  for (int i = 0; i < 4; ++i)
    between.push_back(std::sin(a * (1 - t)) / std::sin(a) * from[i] + s * std::sin(a * t) / std::sin(a) * to[i]);
  return between;
}

glm::dmat4 matrix_of(const Value& q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0},
          {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0},
          {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0},
          {0, 0, 0, 1}};
}

glm::dmat4 local(const json& node) {
  glm::dmat4 matrix(1);
  if (node.contains("matrix")) {
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node["matrix"][static_cast<std::size_t>(i)];
    return matrix;
  }
  const Value t = node.value("translation", Value{0, 0, 0}), s = node.value("scale", Value{1, 1, 1});
  matrix = matrix_of(of_length_1(node.value("rotation", Value{0, 0, 0, 1})));
  for (int i = 0; i < 3; ++i) matrix[i] *= s[static_cast<std::size_t>(i)];
  matrix[3] = {t[0], t[1], t[2], 1};
  return matrix;
}

glm::dmat4 world(const json& nodes, std::size_t number) {
  for (std::size_t above = 0; above < nodes.size(); ++above)
    for (const json& child : nodes[above].value("children", json::array()))
      if (child == number) return world(nodes, above) * local(nodes[number]);
  return local(nodes[number]);
}

}  // namespace

PlainGltf::PlainGltf(const std::string& bytes) {
  std::uint32_t length;
  std::memcpy(&length, &bytes[12], 4);
  json_ = json::parse(bytes.substr(20, length));
  buffer_ = bytes.substr(28 + length);
}

PlainGltf::Numbers PlainGltf::numbers(const json& number) const {
  const json& accessor = json_["accessors"][number.get<std::size_t>()];
  const json& view = json_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const std::map<int, std::size_t> sizes = {{5121, 1}, {5122, 2}, {5126, 4}};
  const int component = accessor["componentType"];
  const std::size_t width = widths.at(accessor["type"]), size = sizes.at(component);
  const std::size_t first = view.value("byteOffset", std::size_t{0});
  Numbers numbers(accessor["count"].get<std::size_t>());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (std::size_t k = 0; k < width; ++k)
      numbers[i].push_back(
          number_at(&buffer_[first + (i * width + k) * size], component, accessor.value("normalized", false)));
  return numbers;
}

// Appendix C.
Value PlainGltf::value(const json& sampler, double time, bool turns) const {
  const Numbers times = numbers(sampler["input"]), values = numbers(sampler["output"]);
  const std::string way = sampler["interpolation"];
  const std::size_t each = way == "CUBICSPLINE" ? 3 : 1, middle = each / 2;
  if (time <= times.front()[0]) return values[middle];
  if (time >= times.back()[0]) return values[values.size() - 1 - middle];
  std::size_t k = 0;
  while (times[k + 1][0] <= time + 1e-7) ++k;
  const double length = times[k + 1][0] - times[k][0], t = std::max((time - times[k][0]) / length, 0.0);
  const Value &from = values[k * each + middle], &to = values[(k + 1) * each + middle];
  if (way == "STEP") return from;
  if (way == "LINEAR" && turns) return slerp(from, to, t);
  Value between;
  for (std::size_t i = 0; i < from.size(); ++i)
    between.push_back(way == "LINEAR" ? (1 - t) * from[i] + t * to[i]
                                      : (2 * t * t * t - 3 * t * t + 1) * from[i] +
                                            length * (t * t * t - 2 * t * t + t) * values[k * 3 + 2][i] +
                                            (-2 * t * t * t + 3 * t * t) * to[i] +
                                            length * (t * t * t - t * t) * values[(k + 1) * 3][i]);
  return turns ? of_length_1(between) : between;
}

json PlainGltf::moved(double time, std::size_t animation) const {
  json nodes = json_["nodes"];
  if (!json_.contains("animations")) return nodes;
  const json& all = json_["animations"][animation];
  for (const json& channel : all["channels"]) {
    const std::string path = channel["target"]["path"];
    json& node = nodes[channel["target"]["node"].get<std::size_t>()];
    if (path != "weights")
      node[path] = value(all["samplers"][channel["sampler"].get<std::size_t>()], time, path == "rotation");
  }
  return nodes;
}

std::vector<glm::dmat4> PlainGltf::nodes(double time, std::size_t animation) const {
  const json nodes = moved(time, animation);
  std::vector<glm::dmat4> worlds;
  for (std::size_t node = 0; node < nodes.size(); ++node) worlds.push_back(world(nodes, node));
  return worlds;
}

// Section 3.7.3.
void PlainGltf::add_skinned(const json& node, const Numbers& places, const json& attributes,
                            const std::vector<glm::dmat4>& worlds, std::vector<glm::dvec3>& vertices) const {
  const json& skin = json_["skins"][node["skin"].get<std::size_t>()];
  const Numbers joints = numbers(attributes["JOINTS_0"]), weights = numbers(attributes["WEIGHTS_0"]),
                inverse = numbers(skin["inverseBindMatrices"]);
  for (std::size_t v = 0; v < places.size(); ++v) {
    glm::dvec4 sum(0);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto joint = static_cast<std::size_t>(joints[v][k]);
      glm::dmat4 bind;
      for (int i = 0; i < 16; ++i) bind[i / 4][i % 4] = inverse[joint][static_cast<std::size_t>(i)];
      sum += weights[v][k] * (worlds[skin["joints"][joint].get<std::size_t>()] * bind *
                              glm::dvec4(places[v][0], places[v][1], places[v][2], 1));
    }
    vertices.emplace_back(sum);
  }
}

std::vector<glm::dvec3> PlainGltf::vertices(double time, std::size_t animation) const {
  const std::vector<glm::dmat4> worlds = nodes(time, animation);
  std::vector<glm::dvec3> vertices;
  for (std::size_t number = 0; number < worlds.size(); ++number) {
    const json& node = json_["nodes"][number];
    if (!node.contains("mesh")) continue;
    const json& attributes = json_["meshes"][node["mesh"].get<std::size_t>()]["primitives"][0]["attributes"];
    const Numbers places = numbers(attributes["POSITION"]);
    if (node.contains("skin"))
      add_skinned(node, places, attributes, worlds, vertices);
    else
      for (const Value& place : places)
        vertices.emplace_back(worlds[number] * glm::dvec4(place[0], place[1], place[2], 1));
  }
  return vertices;
}

}  // namespace mars::test
