// Small GLB files with known contents: JSON as it is written, with accessors over numbers that are added one by one.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace mars::test {

class Glb {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};

  // The number of a new accessor of `type`, such as "VEC3".
  int floats(const char* type, const std::vector<float>& numbers) { return add(type, 5126, numbers, numbers.size()); }
  int bytes(const char* type, const std::vector<std::uint8_t>& numbers) {
    return add(type, 5121, numbers, numbers.size());
  }
  int shorts(const char* type, const std::vector<std::int16_t>& numbers) {
    return add(type, 5122, numbers, numbers.size());
  }

  // Adds a channel of animation `number`, such as of "rotation"; `way` is its interpolation.
  void channel(std::size_t number, int node, const char* path, const char* way, const std::vector<float>& times,
               int values) {
    auto& animation = json["animations"][number];
    animation["samplers"].push_back({{"input", floats("SCALAR", times)}, {"output", values}, {"interpolation", way}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  // The number of a new bufferView.
  int view(std::string_view content) {
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", content.size()}});
    buffer_ += content;
    buffer_.append((4 - buffer_.size() % 4) % 4, '\0');
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  // The number of a new mesh of one triangle, with such further attributes.
  int triangle(const std::vector<float>& places, nlohmann::json attributes = nlohmann::json::object()) {
    attributes["POSITION"] = floats("VEC3", places);
    json["meshes"].push_back({{"primitives", {{{"attributes", attributes}}}}});
    return static_cast<int>(json["meshes"].size()) - 1;
  }

  std::string file() {
    json["buffers"] = {{{"byteLength", buffer_.size()}}};
    std::string text = json.dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    return "glTF" + number(2) + number(28 + text.size() + buffer_.size()) + number(text.size()) + "JSON" + text +
           number(buffer_.size()) + std::string("BIN\0", 4) + buffer_;
  }

 private:
  static std::string number(std::size_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift);
    return bytes;
  }

  template <typename Number>
  int add(const std::string& type, int component, const std::vector<Number>& numbers, std::size_t count) {
    const std::size_t width = type == "MAT4" ? 16 : type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    const std::string_view content(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
    json["accessors"].push_back(
        {{"bufferView", view(content)}, {"componentType", component}, {"count", count / width}, {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  std::string buffer_;
};

}  // namespace mars::test
