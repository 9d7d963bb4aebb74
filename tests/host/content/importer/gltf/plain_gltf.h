// A GLB file as glTF 2.0's formulas have it at a time, plainly and in doubles: where its nodes and its vertices are.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mars::test {

class PlainGltf {
 public:
  explicit PlainGltf(const std::string& bytes);

  // Of each node, from its axes to the file's, at `time` of an animation.
  std::vector<glm::dmat4> nodes(double time, std::size_t animation = 0) const;

  // Of all nodes' meshes, one after the other.
  std::vector<glm::dvec3> vertices(double time, std::size_t animation = 0) const;

 private:
  using Numbers = std::vector<std::vector<double>>;  // by element

  Numbers numbers(const nlohmann::json& accessor) const;
  std::vector<double> value(const nlohmann::json& sampler, double time, bool turns) const;
  nlohmann::json moved(double time, std::size_t animation) const;
  void add_skinned(const nlohmann::json& node, const Numbers& places, const nlohmann::json& attributes,
                   const std::vector<glm::dmat4>& worlds, std::vector<glm::dvec3>& vertices) const;

  nlohmann::json json_;
  std::string buffer_;
};

}  // namespace mars::test
