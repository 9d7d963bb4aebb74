// Which joints are a figure's limbs, so that commands like walk and sit can drive it (model file: "limbs").
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "host/content/document/fields.h"
#include "host/content/modeler/joint.h"

namespace mars::modeler {

enum class Side : std::size_t { left, right };
enum class Trunk : std::size_t { pelvis, spine, chest, neck, head };
enum class Limb : std::size_t { hip, knee, ankle, toes, shoulder, elbow, wrist, fingers };  // of either side

inline constexpr std::string_view kTrunkNames[] = {"pelvis", "spine", "chest", "neck", "head"};
inline constexpr std::string_view kLimbNames[] = {"hip",      "knee",  "ankle", "toes",
                                                  "shoulder", "elbow", "wrist", "fingers"};

// Indices of the model's joints; those that are not named are kNone. A joint is a limb at its upper end: the
// hip is the joint that turns the thigh.
struct Limbs {
  std::array<std::size_t, std::size(kTrunkNames)> trunk;
  std::array<std::array<std::size_t, std::size(kLimbNames)>, 2> sides;

  Limbs();
  std::size_t of(Trunk part) const { return trunk[static_cast<std::size_t>(part)]; }
  std::size_t of(Limb limb, Side side) const {
    return sides[static_cast<std::size_t>(side)][static_cast<std::size_t>(limb)];
  }
  bool has(std::size_t joint) const;
};

// A name must be one of the joints', none named twice, and each limb hang below the one before it.
Limbs read_limbs(const document::Element& element, std::span<const Joint> joints);

}  // namespace mars::modeler
