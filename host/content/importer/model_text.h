// The model file that `mars import` writes. Its numbers are many, so they go straight into text.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/content/modeler/mesh.h"
#include "host/content/modeler/model.h"
#include "node/wire/film.h"

namespace mars::importer {

// What one joint shows.
struct ImportedPart {
  std::string shape;  // JSON
  std::optional<std::array<double, 3>> color;
};

// Of part 0, 1, ...
std::string material_name(std::size_t part);

// A shape as JSON.
std::string shape_text(const std::vector<wire::Patch>& patches);
std::string shape_text(const modeler::Mesh& mesh);

// `joint`, in UTF-8, is the first's name; the others hang on it and cannot turn. `bounds` are the sbb of all.
std::string model_text(const std::vector<ImportedPart>& parts, const modeler::Box& bounds, const std::string& joint);

}  // namespace mars::importer
