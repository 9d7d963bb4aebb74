// Puts the faces of one joint together: vertices that agree in place and normal become one, faces of one material one
// part.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host/content/importer/imported_mesh.h"

namespace mars::importer {

// One that nothing is in, to be widened.
inline const modeler::Box kEmptyBox{glm::dvec3(std::numeric_limits<double>::max()),
                                    glm::dvec3(std::numeric_limits<double>::lowest())};

// Where the crease and the normals of all meshes of a file come from.
struct MeshStyle {
  bool takes_normals = false;  // without, those given to vertex() are passed over
  double crease = modeler::kDefaultCrease;
};

class MeshBuilder {
 public:
  using Material = std::optional<std::size_t>;

  // `file` is what failures name.
  MeshBuilder(std::string file, const MeshStyle& style) : file_(std::move(file)), style_(style) {}

  // The number of the part of this material.
  std::size_t part_of(const Material& material);

  // The number, within its part, of a vertex given in the joint's axes and the file's units.
  std::uint32_t vertex(std::size_t part_number, const glm::dvec3& place, const glm::dvec3& normal);

  // Changes `face`: a corner twice in a row is one.
  void add_face(std::size_t part_number, std::vector<std::uint32_t>& face);

  // Makes `box` reach round what lies on faces, seen from where the joint's origin is at `origin` and its axes are
  // `axes`.
  void widen(modeler::Box& box, const glm::dvec3& origin, const glm::dmat3& axes) const;

  // All parts with faces, `factor` times as large.
  std::vector<MeshPart> finish(double factor);

  std::size_t faces_left_out() const { return faces_left_out_; }

 private:
  struct Vertex {
    glm::dvec3 place, normal;
  };
  struct Hash {
    std::size_t operator()(const std::array<double, 6>& key) const;
  };
  struct Part {
    Material material;
    std::vector<Vertex> vertices;
    std::unordered_map<std::array<double, 6>, std::uint32_t, Hash> numbers;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> ends;
  };

  Vertex checked(const glm::dvec3& place, const glm::dvec3& normal) const;
  modeler::Mesh mesh_of(const Part& part, const modeler::Box& bounds, double factor) const;

  std::string file_;
  MeshStyle style_;
  std::vector<Part> parts_;
  std::size_t faces_left_out_ = 0;
};

}  // namespace mars::importer
