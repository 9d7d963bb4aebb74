// PLY files, as text or in bytes of either order, with their faces as lists or as triangle strips. Assimp 5.2 makes one
// triangle of all strips, loses bytes of files whose first number begins as a line ends, and takes faces for vertices
// where vertices are missing. What else Debian 12 has for PLY - VTK, PCL, CGAL - is far larger than this.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace mars::importer {

struct PlyFile {
  std::vector<glm::dvec3> places;
  std::vector<glm::dvec3> normals;           // one a vertex, or none
  std::vector<std::array<float, 2>> uv;      // one a vertex, or none
  std::vector<std::array<float, 4>> colors;  // one a vertex, as shown, and alpha; or none
  std::vector<std::uint32_t> corners;        // numbers of vertices, face after face
  std::vector<std::size_t> ends;             // of each face in corners
  std::vector<std::string> not_read;         // "properties red, green, blue of vertices", ...
};

// As many vertices and faces as the header promises; a file with fewer is refused.
PlyFile read_ply_file(const std::filesystem::path& path);

}  // namespace mars::importer
