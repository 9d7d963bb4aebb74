// What points of skins follow: the vertices of a mesh, or the control points of a net.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "node/wire/film_parts.h"

namespace mars::modeler {

inline constexpr std::size_t kMostBones = 65536;      // of a skin
inline constexpr std::size_t kMostBonesOfVertex = 4;  // as nodes take them

// Which bones a vertex of a skin follows, and how much each: numbers in the skin's list, ascending. Weights above 0,
// whose sum is 1, come first.
struct VertexBones {
  std::array<std::uint32_t, kMostBonesOfVertex> bone{};
  std::array<float, kMostBonesOfVertex> weight{};

  auto operator<=>(const VertexBones&) const = default;
};

struct BoneWeight {
  std::uint32_t bone;
  double weight;
};

// Of bones in any order, some of them perhaps several times: the heaviest, with weights that add up to 1. None where no
// weight is above 0.
std::optional<VertexBones> bones_of_vertex(std::vector<BoneWeight> bones);

// The bones that any of the points follows, ascending.
std::vector<std::uint32_t> all_bones(std::span<const VertexBones> points);

// 0 of a bone that the point does not follow.
float weight_of(const VertexBones& point, std::uint32_t bone);

// Skins as nodes read them (wire::FilmData::skin_bones and skin_weights).
struct SkinLists {
  std::vector<std::uint32_t> bones;
  std::vector<float> weights;

  wire::Skin add(std::span<const VertexBones> points);
  // A list alone.
  wire::Skin add_bones(std::span<const std::uint32_t> all);
};

}  // namespace mars::modeler
