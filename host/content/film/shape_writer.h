// Shapes as a compiled film has them: each kind of patches or mesh once, however many models have it.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "host/content/modeler/model.h"
#include "node/wire/film.h"

namespace mars::film {

class ShapeWriter {
 public:
  // Appends to `film`'s shapes and what they are made of.
  explicit ShapeWriter(wire::FilmData& film) : film_(film) {}

  // The number of the shape with these patches or this mesh and its bones, bit for bit. `shape` must stay where it is.
  std::uint32_t add(const modeler::Shape& shape);

 private:
  std::uint32_t add_patches(const std::vector<wire::Patch>& patches);
  std::uint32_t add_mesh(const modeler::Mesh& mesh);
  std::uint32_t add_net(const modeler::Shape& shape);
  wire::Skin placed(wire::Skin skin) const;
  void append_lists(const modeler::SkinLists& lists);

  wire::FilmData& film_;
  std::unordered_map<std::string_view, std::uint32_t> of_patches_;  // by their bits
  std::vector<std::pair<const modeler::Mesh*, std::uint32_t>> of_meshes_;
  std::vector<std::pair<const modeler::ControlNet*, std::uint32_t>> of_nets_;
};

}  // namespace mars::film
