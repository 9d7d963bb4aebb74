// Materials of a film file: those of a model file (host/content/modeler/material.h), with keys.
#pragma once

#include <string_view>
#include <vector>

#include "host/content/animator/film.h"
#include "host/content/document/fields.h"

namespace mars::animator {

inline constexpr std::string_view kFilmMaterialNames[] = {"color",      "ambient",       "diffuse",  "specular",
                                                          "exponent",   "roughness",     "metallic", "refraction",
                                                          "reflection", "interpolation", "sides",    "keys"};
inline constexpr std::string_view kMaterialKeyNames[] = {"frame",    "color",     "ambient",  "diffuse",    "specular",
                                                         "exponent", "roughness", "metallic", "refraction", "ease"};
inline constexpr document::Keys kFilmMaterialKeys{"film_material", kFilmMaterialNames};
inline constexpr document::Keys kMaterialKeyKeys{"material_key", kMaterialKeyNames};

std::vector<MaterialMotion> read_materials(const document::Element& materials);

// The material that never changes.
MaterialMotion still_material(const std::string& name, const wire::Material& material);

}  // namespace mars::animator
