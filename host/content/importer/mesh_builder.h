// Puts the faces of one joint together: vertices that agree in place, normal and bones become one, faces of one
// material one part. Places in images and colours split no vertex: corners keep theirs beside the mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host/content/importer/imported_mesh.h"
#include "host/content/importer/paint.h"

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

  // Which bones a vertex of a skin follows, and where these put it while the model rests.
  struct Follows {
    modeler::VertexBones bones;
    glm::dvec3 at_rest;
  };

  // What add_face() calls a corner of the part: at a vertex given in the joint's axes and the file's units. Either all
  // of the joint's vertices follow bones or none does.
  std::uint32_t corner(std::size_t part_number, const glm::dvec3& place, const glm::dvec3& normal,
                       const Follows* follows = nullptr, const CornerPaint& paint = {});

  // Changes `face`: a vertex twice in a row is one corner.
  void add_face(std::size_t part_number, std::vector<std::uint32_t>& face);

  // Gives bones their numbers in another order.
  void renumber_bones(std::span<const std::uint32_t> numbers);
  bool has_skin() const { return !follows_.empty(); }

  // Makes `box` reach round what lies on faces while the model rests, seen from where the joint's origin is at `origin`
  // and its axes are `axes`.
  void widen(modeler::Box& box, const glm::dvec3& origin, const glm::dmat3& axes) const;

  // All parts with faces, `factor` times as large.
  std::vector<MeshPart> finish(double factor);

  std::size_t faces_left_out() const { return faces_left_out_; }

 private:
  static constexpr std::uint32_t kNoRow = std::numeric_limits<std::uint32_t>::max();

  struct Vertex {
    glm::dvec3 place, normal, at_rest;
    std::uint32_t follows;       // a number in follows_
    std::uint32_t row = kNoRow;  // the newest of its rows
  };
  // A vertex as some corners have it.
  struct Row {
    std::uint32_t vertex;
    std::uint32_t older;  // of the same vertex
    std::array<float, 2> uv{};
    std::array<float, 4> color{1, 1, 1, 1};
  };
  using Key = std::array<double, 7>;
  struct Hash {
    std::size_t operator()(const Key& key) const;
  };
  struct Part {
    Material material;
    std::vector<Vertex> vertices;
    std::unordered_map<Key, std::uint32_t, Hash> numbers;
    std::vector<Row> rows;               // from the first corner on that has paint; none: corners are vertices
    std::vector<std::uint32_t> corners;  // numbers of rows, or of vertices
    std::vector<std::uint32_t> ends;
    bool has_uv = false, has_colors = false;

    std::uint32_t vertex_of(std::uint32_t corner) const { return rows.empty() ? corner : rows[corner].vertex; }
  };

  Vertex checked(const glm::dvec3& place, const glm::dvec3& normal) const;
  std::uint32_t number_of(const modeler::VertexBones& bones);
  std::uint32_t vertex(Part& part, const glm::dvec3& place, const glm::dvec3& normal, const Follows* follows);
  static std::uint32_t row_of(Part& part, std::uint32_t vertex, const CornerPaint& paint);
  static std::uint32_t add_row(Part& part, const Row& row);
  void widen(modeler::Box& box, const auto& place_of) const;
  modeler::Mesh vertices_of(const Part& part, const modeler::Box& bounds, double factor) const;
  MeshPart finished(const Part& part, const modeler::Box& bounds, double factor) const;

  std::string file_;
  MeshStyle style_;
  std::vector<Part> parts_;
  std::vector<modeler::VertexBones> follows_;  // each once
  std::map<modeler::VertexBones, std::uint32_t> follows_numbers_;
  std::size_t faces_left_out_ = 0;
};

}  // namespace mars::importer
