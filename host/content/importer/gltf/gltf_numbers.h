// The numbers of a glTF file's accessors, read without Assimp, which keeps single precision and passes over much.
#pragma once

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
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
  // Of a file with these bytes and this JSON. `whose` numbers failures speak of.
  GltfBuffers(const std::filesystem::path& path, std::string_view bytes, const Tree& gltf,
              std::string whose = "an animation");
  GltfBuffers(auto&&, auto&&, const Tree&&, auto&&...) = delete;
  GltfBuffers(auto&&, std::same_as<std::string> auto&&, auto&&...) = delete;

  // Accessor `index`: floats, or whole numbers that stand for -1 to 1 (glTF 2.0, 3.6.2.2). Refuses what is not within
  // its buffer, in a failure that names the file and the accessor. Sparse ones come with what replaces their numbers.
  GltfNumbers read(const Tree& index) const { return read(index, true); }

  // The same of what KHR_mesh_quantization packs: whole numbers stand for themselves where the accessor does not say
  // that they are normalized.
  GltfNumbers read_quantized(const Tree& index) const;

  // The bytes from `place`, as a view or an extension has it, to its end. Refuses what is not within its buffer.
  std::string_view bytes_at(const Tree& place) const;

 private:
  struct Run;  // of elements of one kind

  GltfNumbers read(const Tree& index, bool normalized) const;
  std::string_view buffer(const Tree& index) const;
  Run run(const Tree& part, std::size_t count, std::size_t component, std::size_t width) const;
  void replace_sparse(const Tree& sparse, std::size_t component, bool normalized, GltfNumbers& read) const;

  std::filesystem::path path_;
  const Tree& gltf_;
  std::string whose_;
  std::string_view own_;  // a GLB's chunk
  std::vector<std::string> buffers_;
};

}  // namespace mars::importer
