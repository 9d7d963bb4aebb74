// Whole figures that a model may begin as: people made of the same segments (thesis, figure 2.5), a dog and a horse.
// And objects for films with them. All are of one size: 2.9 units a metre.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/content/document/json_file.h"

namespace mars::modeler {

struct LibraryFigure {
  std::string_view name;
  std::string_view what;
  std::string_view model;        // a model file's text
  std::string_view proportions;  // the text of a model file that is derived from it; "": none
  bool centred = false;          // its frame is its middle, not where it stands
};

std::span<const LibraryFigure> figure_library();
std::span<const LibraryFigure> object_library();
// A figure or an object; null if there is none of this name.
const LibraryFigure* find_in_library(std::string_view name);

// The figure or object of this name, with joints of its own, scaled to the height at rest where one is given. Throws
// Failure where there is none of this name.
document::Json library_figure(const std::string& name, const std::optional<double>& height = {});

}  // namespace mars::modeler
