// Whole figures that a model may begin as: people made of the same segments (thesis, figure 2.5), a dog and a horse.
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
};

std::span<const LibraryFigure> figure_library();

// The model of this name, with joints of its own, scaled to the height at rest where one is given. Throws Failure where
// there is none of this name.
document::Json library_figure(const std::string& name, const std::optional<double>& height = {});

}  // namespace mars::modeler
