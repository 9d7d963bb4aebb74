// What a material is: its numbers, how they lie in the compiled film, and which reflection models use them. A new
// number of a material is a row here, a member of wire::Material, and its use in a kernel (node/shading/kernels).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "host/content/keys/key.h"
#include "node/wire/film_parts.h"

namespace mars::keys {

constexpr unsigned bit_of(wire::Reflection reflection) { return 1u << static_cast<unsigned>(reflection); }

inline constexpr unsigned kWithHighlights = bit_of(wire::Reflection::phong) | bit_of(wire::Reflection::blinn_phong);
inline constexpr unsigned kCookTorrance = bit_of(wire::Reflection::cook_torrance);
inline constexpr unsigned kMetallicRoughness = bit_of(wire::Reflection::metallic_roughness);

inline constexpr std::string_view kReflections[] = {"phong", "blinn-phong", "cook-torrance", "metallic-roughness"};
inline constexpr std::string_view kInterpolations[] = {"phong", "gouraud", "flat"};

struct MaterialNumber {
  float wire::Material::*member;
  unsigned used_by;  // bits of reflection models
  Key key;           // of a number with a default
  Range slider;      // of the studio, whose hand needs less than all
};

inline constexpr std::array kMaterialNumbers{
    MaterialNumber{&wire::Material::ambient,
                   kWithHighlights | kCookTorrance | kMetallicRoughness,
                   {.name = "ambient",
                    .meaning = "share of the film's ambient light that it reflects",
                    .number = 0.1,
                    .range = {0, 10},
                    .keyed = true},
                   {0, 2}},
    MaterialNumber{&wire::Material::diffuse,
                   kWithHighlights | kCookTorrance,
                   {.name = "diffuse",
                    .meaning = "share of a light's light that it scatters",
                    .number = 0.65,
                    .range = {0, 10},
                    .keyed = true},
                   {0, 2}},
    MaterialNumber{
        &wire::Material::specular,
        kWithHighlights | kCookTorrance,
        {.name = "specular", .meaning = "strength of its highlights", .number = 0.45, .range = {0, 10}, .keyed = true},
        {0, 4}},
    MaterialNumber{&wire::Material::exponent,
                   kWithHighlights,
                   {.name = "exponent",
                    .meaning = "narrowness of its highlights",
                    .number = 32,
                    .range = {0, 10000},
                    .keyed = true},
                   {0, 400}},
    MaterialNumber{&wire::Material::roughness,
                   kCookTorrance | kMetallicRoughness,
                   {.name = "roughness",
                    .meaning = "how rough it is: 0 a mirror, 1 rough",
                    .number = 0.5,
                    .range = {0, 1},
                    .keyed = true},
                   {0, 1}},
    MaterialNumber{&wire::Material::metallic,
                   kMetallicRoughness,
                   {.name = "metallic",
                    .meaning = "how much it is a metal: 0 none, 1 all",
                    .number = 0,
                    .range = {0, 1},
                    .keyed = true,
                    .example = "1"},
                   {0, 1}},
    MaterialNumber{
        &wire::Material::refraction,
        kCookTorrance,
        {.name = "refraction", .meaning = "index of refraction", .number = 1.5, .range = {1.01, 100}, .keyed = true},
        {1.01, 4}}};

// What a material is or is not, of all reflection models.
struct MaterialFlag {
  std::uint32_t wire::Material::*member;  // 0 or 1
  Key key;
};

inline constexpr std::array kMaterialFlags{
    MaterialFlag{
        &wire::Material::casts,
        {.name = "casts", .type = "flag", .meaning = "whether it casts shadows", .json = "true", .example = "false"}},
    MaterialFlag{&wire::Material::receives,
                 {.name = "receives",
                  .type = "flag",
                  .meaning = "whether shadows fall on it",
                  .json = "true",
                  .example = "false"}}};

constexpr bool uses(wire::Reflection reflection, const MaterialNumber& number) {
  return (number.used_by & bit_of(reflection)) != 0;
}

}  // namespace mars::keys
