// Bicubic Bezier patches of a scene of another program, as its readers give them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mars::importer {

using PatchColor = std::array<double, 3>;  // as shown, 0 to 1

struct ScenePatch {
  std::array<glm::dvec3, 16> points;  // along u first
  std::optional<PatchColor> color;    // none: the file gives it none
};

struct PatchScene {
  std::vector<ScenePatch> patches;
  std::map<std::string, std::size_t> skipped;  // what else the file has: "sphere" twice, ...
  bool is_left_handed = false;                 // x, y, z are right, up, and away from who looks
};

// A scene with more patches, or with deeper nesting, is refused, while it takes less than half a gigabyte: to make a
// model of a patch takes as many bytes, most of them text.
inline constexpr std::size_t kMostScenePatches = 500'000, kBytesOfPatch = 2'500, kDeepestScene = 200;
// The most numbers in brackets: those of a mesh of kMostScenePatches patches that share only points on their edges.
inline constexpr std::size_t kMostSceneNumbers = std::size_t{1} << 24;
inline constexpr std::uintmax_t kLargestPatchScene = std::uintmax_t{1} << 28;

// The problem of a scene with more than kMostScenePatches patches, for a Failure.
std::string too_many_patches();

void transform(std::vector<ScenePatch>& patches, const glm::dmat4& by);

// Cut to 0 to 1; what is no number becomes 0.
inline PatchColor cut_color(const glm::dvec3& color) {
  const auto cut = [](double part) { return part > 0 ? std::min(part, 1.0) : 0.0; };
  return {cut(color.x), cut(color.y), cut(color.z)};
}

// bicubic_patch of POV-Ray, with numbers, vectors and objects that #declare names, and what moves and colours the
// objects around it; other objects are skipped, as are macros, loops, conditions and included files that are not there.
// Failures are at FILE:LINE.
PatchScene read_pov(const std::filesystem::path& path);

// Patch and PatchMesh of RenderMan's RIB in text, bicubic in any basis or bilinear, with transformations and colours.
// Failures are at FILE:LINE.
PatchScene read_rib(const std::filesystem::path& path);

}  // namespace mars::importer
