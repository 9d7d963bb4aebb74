// The numbers of a glTF file's accessors, read without Assimp, which keeps single precision and passes over much.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/content/importer/gltf/gltf_json.h"

namespace mars::importer {

// Elements of `width` numbers each.
struct GltfNumbers {
  std::size_t width = 1;
  std::vector<double> numbers;

  std::size_t count() const { return numbers.size() / width; }
  const double* element(std::size_t index) const { return numbers.data() + index * width; }
};

class GltfBuffers {
 public:
  // Of a file with these bytes and this JSON.
  GltfBuffers(const std::filesystem::path& path, std::string_view bytes, const Tree& gltf);

  // Accessor `index`: floats, or whole numbers that stand for -1 to 1 (glTF 2.0, 3.6.2.2). Refuses what is not within
  // its buffer, in a failure that names the file and the accessor. Sparse ones come with what replaces their numbers.
  GltfNumbers read(const Tree& index) const;

 private:
  struct Run;  // of elements of one kind

  std::string_view buffer(const Tree& index) const;
  Run run(const Tree& part, std::size_t count, std::size_t component, std::size_t width) const;
  void replace_sparse(const Tree& sparse, std::size_t component, GltfNumbers& read) const;

  std::filesystem::path path_;
  const Tree& gltf_;
  std::string_view own_;  // a GLB's chunk
  std::vector<std::string> buffers_;
};

}  // namespace mars::importer
