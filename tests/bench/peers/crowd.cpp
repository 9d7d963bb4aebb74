#include "tests/bench/peers/crowd.h"

#include <fstream>
#include <stdexcept>

namespace mars::bench {
namespace {

template <typename T>
void read_all(std::ifstream& file, std::vector<T>& values, std::size_t count) {
  values.resize(count);
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

template <typename T>
void write_all(std::ofstream& file, const std::vector<T>& values) {
  file.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

}  // namespace

void write_crowd(const Crowd& crowd, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(&crowd.head), sizeof crowd.head);
  file.write(reinterpret_cast<const char*>(&crowd.look), sizeof crowd.look);
  write_all(file, crowd.vertices);
  write_all(file, crowd.triangles);
  write_all(file, crowd.bones);
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

Crowd read_crowd(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  Crowd crowd{};
  file.read(reinterpret_cast<char*>(&crowd.head), sizeof crowd.head);
  file.read(reinterpret_cast<char*>(&crowd.look), sizeof crowd.look);
  const MeshHead& head = crowd.head.mesh;
  read_all(file, crowd.vertices, head.vertices);
  read_all(file, crowd.triangles, head.triangles);
  read_all(file, crowd.bones, std::size_t{head.frames} * head.patches * crowd.head.bones);
  if (!file) throw std::runtime_error(path + ": cut short");
  return crowd;
}

}  // namespace mars::bench
