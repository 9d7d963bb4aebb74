// The library of shapes that every model can name: primitives, Newell's teapot, parts of the human body. One
// table for those who read models, list shapes, and check the published schema.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/content/keys/shape_options.h"
#include "node/wire/film.h"

namespace mars::modeler {

inline constexpr std::size_t kMostNumbers = 3;  // of an option

// As many as the option's count, then zeros.
using OptionValues = std::array<double, kMostNumbers>;

struct LibraryShape {
  std::string_view name;
  std::string_view what;
  const keys::Key* option;  // null: there is nothing to vary
  std::vector<wire::Patch> (*make)(const OptionValues& values);
};

// In the order in which a person would list them.
std::span<const LibraryShape> shape_library();

// Null if there is none of this name.
const LibraryShape* find_library_shape(std::string_view name);

// The remedy for a name that is neither of the library nor of the model's `own` shapes.
std::string likely_shape(std::string_view wanted, std::span<const std::string_view> own = {});

}  // namespace mars::modeler
