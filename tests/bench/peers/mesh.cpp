#include "tests/bench/peers/mesh.h"

#include <fstream>
#include <stdexcept>

namespace mars::bench {
namespace {

template <typename T>
void write_all(std::ofstream& file, const std::vector<T>& values) {
  file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

template <typename T>
void read_all(std::ifstream& file, std::vector<T>& values, std::uint32_t count) {
  values.resize(count);
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

}  // namespace

std::uint32_t Mesh::first_moving_triangle() const {
  for (const MeshPatch& patch : patches)
    if (patch.moves == 1) return patch.first_triangle;
  return head.triangles;
}

void write_mesh(const Mesh& mesh, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(&mesh.head), sizeof mesh.head);
  write_all(file, mesh.looks);
  write_all(file, mesh.patches);
  write_all(file, mesh.vertices);
  write_all(file, mesh.triangles);
  write_all(file, mesh.motion);
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

Mesh read_mesh(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Mesh mesh{};
  file.read(reinterpret_cast<char*>(&mesh.head), sizeof mesh.head);
  if (!file || mesh.head.magic != kMeshMagic) throw std::runtime_error(path + ": not a mesh of the benchmark");
  read_all(file, mesh.looks, mesh.head.looks);
  read_all(file, mesh.patches, mesh.head.patches);
  read_all(file, mesh.vertices, mesh.head.vertices);
  read_all(file, mesh.triangles, mesh.head.triangles);
  read_all(file, mesh.motion, mesh.head.frames);
  if (!file) throw std::runtime_error(path + ": cut short");
  return mesh;
}

}  // namespace mars::bench
