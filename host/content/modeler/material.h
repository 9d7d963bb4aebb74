// A material of a model or film file, read by the table of its keys (host/content/keys/material_keys.h). Colours are as
// shown: compiling a film makes light of them.
#pragma once

#include <string_view>

#include "host/content/document/fields.h"
#include "host/content/keys/material_keys.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

using keys::kInterpolations;
using keys::kMaterialFlags;
using keys::kMaterialNumbers;
using keys::kReflections;
using keys::MaterialFlag;
using keys::MaterialNumber;
using keys::uses;

constexpr std::string_view word_of(wire::Interpolation interpolation) {
  return kInterpolations[static_cast<unsigned>(interpolation)];
}
constexpr std::string_view word_of(wire::Reflection reflection) {
  return kReflections[static_cast<unsigned>(reflection)];
}

// One of whose keys none is written.
const wire::Material& default_material();

// The object under its material keys; others than those of `fields` are refused.
wire::Material read_material(const document::Fields& fields);

// The same, of what has no keys over time: all but colour and numbers.
wire::Material read_shading(const document::Fields& fields);

// Numbers that the reflection model does not use.
void refuse_unused(const document::Fields& fields, wire::Reflection reflection);

}  // namespace mars::modeler
