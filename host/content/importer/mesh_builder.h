// Puts a mesh file's faces together: vertices that agree in place and normal become one, faces of one colour one part.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host/content/importer/imported_mesh.h"

namespace mars::importer {

class MeshBuilder {
 public:
  using Color = std::optional<std::array<double, 3>>;

  // `file` is what failures name. Without normals those given to vertex() are passed over.
  MeshBuilder(std::string file, const MeshOptions& options, bool has_normals)
      : file_(std::move(file)),
        options_(options),
        has_normals_(has_normals),
        takes_normals_(has_normals && !options.crease) {}

  // The number of the part of this colour.
  std::size_t part_of(const Color& color);

  // The number, within its part, of a vertex given in the file's axes and units.
  std::uint32_t vertex(std::size_t part_number, const glm::dvec3& place, const glm::dvec3& normal);

  // Changes `face`: a corner twice in a row is one.
  void add_face(std::size_t part_number, std::vector<std::uint32_t>& face);

  // All but the file's vertices; as not read, what was given here and left out. Refuses a file without faces.
  MeshFile finish(double default_crease);

 private:
  struct Vertex {
    glm::dvec3 place, normal;
  };
  struct Hash {
    std::size_t operator()(const std::array<double, 6>& key) const;
  };
  struct Part {
    Color color;
    std::vector<Vertex> vertices;
    std::unordered_map<std::array<double, 6>, std::uint32_t, Hash> numbers;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> ends;
  };

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
  Vertex placed(const glm::dvec3& place, const glm::dvec3& normal) const;
  modeler::Box bounds() const;  // round what lies on faces
  modeler::Mesh mesh_of(const Part& part, const modeler::Box& bounds, double crease) const;

  std::string file_;
  MeshOptions options_;
  bool has_normals_, takes_normals_;
  std::vector<Part> parts_;
  std::size_t faces_left_out_ = 0;
};

}  // namespace mars::importer
