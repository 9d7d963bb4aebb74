// A material's keys in model and film files: its colour and numbers, how it is shaded, and which of them a reflection
// model uses. Colours are as shown: compiling a film makes light of them.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "host/content/document/fields.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

constexpr unsigned bit_of(wire::Reflection reflection) { return 1u << static_cast<unsigned>(reflection); }

inline constexpr unsigned kWithHighlights = bit_of(wire::Reflection::phong) | bit_of(wire::Reflection::blinn_phong);
inline constexpr unsigned kCookTorrance = bit_of(wire::Reflection::cook_torrance);
inline constexpr unsigned kMetallicRoughness = bit_of(wire::Reflection::metallic_roughness);

struct MaterialNumber {
  std::string_view key;
  float wire::Material::*member;
  double otherwise;  // if a file does not give it
  document::Range range;
  unsigned used_by;  // bits of reflection models
};

inline constexpr std::array<MaterialNumber, 7> kMaterialNumbers{
    {{"ambient", &wire::Material::ambient, 0.10, {0, 10}, kWithHighlights | kCookTorrance | kMetallicRoughness},
     {"diffuse", &wire::Material::diffuse, 0.65, {0, 10}, kWithHighlights | kCookTorrance},
     {"specular", &wire::Material::specular, 0.45, {0, 10}, kWithHighlights | kCookTorrance},
     {"exponent", &wire::Material::exponent, 32, {0, 10000}, kWithHighlights},
     {"roughness", &wire::Material::roughness, 0.5, {0, 1}, kCookTorrance | kMetallicRoughness},
     {"metallic", &wire::Material::metallic, 0, {0, 1}, kMetallicRoughness},
     {"refraction", &wire::Material::refraction, 1.5, {1.01, 100}, kCookTorrance}}};

inline constexpr std::string_view kInterpolations[] = {"phong", "gouraud", "flat"};
inline constexpr std::string_view kReflections[] = {"phong", "blinn-phong", "cook-torrance", "metallic-roughness"};

inline constexpr std::string_view kMaterialKeys[] = {"color",      "ambient",       "diffuse",  "specular",
                                                     "exponent",   "roughness",     "metallic", "refraction",
                                                     "reflection", "interpolation", "sides"};

constexpr std::string_view word_of(wire::Interpolation interpolation) {
  return kInterpolations[static_cast<unsigned>(interpolation)];
}
constexpr std::string_view word_of(wire::Reflection reflection) {
  return kReflections[static_cast<unsigned>(reflection)];
}

constexpr wire::Material default_material() {
  wire::Material material{{0.8f, 0.8f, 0.8f}, 0, 0, 0, 0, 2};
  for (const MaterialNumber& number : kMaterialNumbers) material.*number.member = static_cast<float>(number.otherwise);
  return material;
}

inline constexpr wire::Material kDefaultMaterial = default_material();

constexpr bool uses(wire::Reflection reflection, const MaterialNumber& number) {
  return (number.used_by & bit_of(reflection)) != 0;
}

// The object under its material keys; others than those of `fields` are refused.
wire::Material read_material(const document::Fields& fields);

// The same, of what has no keys over time: reflection, interpolation and sides.
wire::Material read_shading(const document::Fields& fields);

// Numbers that the reflection model does not use.
void refuse_unused(const document::Fields& fields, wire::Reflection reflection);

}  // namespace mars::modeler
