#include "node/shadow/shadow_plan.h"

#include <algorithm>
#include <array>

#include "node/shading/kernels.h"
#include "node/shadow/casters.h"
#include "node/shadow/pairs.h"
#include "node/shadow/points.h"
#include "node/simd/vector_slack.h"

namespace mars::shadow {
namespace {

constexpr std::size_t kMostBand = std::size_t{32} << 20, kMostPoints = std::size_t{144} << 20;
constexpr std::size_t kGrain = 64;          // of the band's arena
constexpr std::size_t kVectorPlace = 64;    // beside a vector's points: where they come from, boxes round them
constexpr std::size_t kTables = 6u << 20;   // a dicer, grids, batches of triangles, views of lights, lists of squares
constexpr std::uint32_t kLinesOfLeast = 2;  // of a band

std::size_t squares_of_row(const ShadowNeeds& needs) { return (std::size_t{needs.width} + kTile - 1) / kTile; }

// For a light that has a size: shafts have what one without has, and each of its points a vector more. Twice, because
// faces of a light keep the memory that faces of another light took.
std::size_t bytes_of_square(const ShadowNeeds& needs) {
  const std::size_t vectors = std::size_t{kTile} * kTile * needs.samples / kPointLanes + 1;
  return 2 * (vectors + vectors / 2) * (sizeof(PointVector) + kVectorPlace);
}

// Of the line that is put: shares of light, pixel groups, depths and ids; and places of diced surfaces by number.
std::size_t fixed_bytes(const ShadowNeeds& needs) {
  constexpr std::size_t kGroup =
      sizeof(shading::Fragment) + 2 * sizeof(std::uint32_t) + 3 * sizeof(float) + sizeof(wire::StillGroup);
  const std::size_t samples = (std::size_t{needs.width} + 2 * simd::kVectorSlack) * needs.samples;
  return samples * (needs.casting * sizeof(float) + kGroup + sizeof(float) + sizeof(std::uint32_t)) +
         needs.patches * sizeof(const Caster*) + kTables;
}

ShadowPlan least(const ShadowNeeds& needs) {
  ShadowPlan plan;
  plan.band = kLinesOfLeast * band_bytes_of_line(needs);
  plan.points = squares_of_row(needs) * bytes_of_square(needs);
  plan.chunk = CasterStore::kLeastBytes;
  plan.fixed = fixed_bytes(needs);
  return plan;
}

ShadowPlan most(const ShadowNeeds& needs) {
  ShadowPlan plan = least(needs);
  plan.band = std::max(plan.band, kMostBand);
  plan.points = std::max(plan.points, kMostPoints);
  plan.chunk = kMostChunk;
  plan.diced = kMostDiced;
  return plan;
}

}  // namespace

ShadowNeeds shadow_needs(const wire::PackedFilm& film, bool has_layers) {
  return {film.settings().width, film.settings().samples, film.casting_count(), film.patch_instances(), has_layers};
}

// Each kind gets the same part of what is of use beyond what it needs.
ShadowPlan plan_shadows(const ShadowNeeds& needs, std::uint64_t bytes) {
  if (needs.casting == 0) return {};
  ShadowPlan plan = least(needs);
  const ShadowPlan all = most(needs);
  const std::uint64_t more = std::clamp<std::uint64_t>(bytes, plan.bytes(), all.bytes()) - plan.bytes();
  const double part = static_cast<double>(more) / static_cast<double>(all.bytes() - plan.bytes());
  for (const auto kind : {&ShadowPlan::band, &ShadowPlan::points, &ShadowPlan::chunk, &ShadowPlan::diced})
    plan.*kind += static_cast<std::size_t>(static_cast<double>(all.*kind - plan.*kind) * part);
  return plan;
}

std::size_t least_shadow_bytes(const ShadowNeeds& needs) { return plan_shadows(needs, 0).bytes(); }

std::size_t most_shadow_bytes(const ShadowNeeds& needs) { return plan_shadows(needs, ~std::uint64_t{0}).bytes(); }

// Of both kinds: groups with their light and, of still ones, a record; depths; pairs, and what movers block.
std::size_t band_bytes_of_line(const ShadowNeeds& needs) {
  const std::size_t casting = needs.casting;
  const std::size_t samples = std::size_t{needs.width} * needs.samples + 2 * simd::kVectorSlack;
  const std::size_t light = (4 + 3 * casting) * sizeof(float);
  const std::size_t group = sizeof(shading::Fragment) + 2 * sizeof(std::uint32_t) + light;
  const std::size_t arrays = 2 * (12 + 3 * casting) * kGrain;
  const std::size_t column = sizeof(std::uint32_t) + casting * 2 * (sizeof(wire::StillPairs) + sizeof(std::uint16_t));
  const std::size_t record = wire::still_group_bytes(needs.casting) + wire::surface_bytes(needs.has_layers);
  return samples * (2 * group + record + 2 * sizeof(float)) + needs.width * column + arrays +
         (needs.has_layers ? kGrain : 0);
}

std::size_t squares_of_points(const ShadowNeeds& needs, std::size_t bytes) {
  return std::max(bytes / bytes_of_square(needs), squares_of_row(needs));
}

std::uint32_t lines_of_points(const ShadowNeeds& needs, std::size_t bytes) {
  const std::size_t rows = squares_of_points(needs, bytes) / squares_of_row(needs);
  return static_cast<std::uint32_t>(std::min<std::size_t>(rows * kTile, wire::kMaxSide));
}

}  // namespace mars::shadow
