// Control points, and the Bezier points of patches that are means of these: what B-spline surfaces and Catmull-Clark
// cages have in common. Bones of a skin move the control points, so the surface stays as smooth as it was.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "host/content/modeler/skin_weights.h"
#include "node/wire/film_parts.h"

namespace mars::modeler {

struct Term {
  std::uint32_t point;
  double weight;
};

// A mean of control points: ascending by point, weights above 0 whose sum is 1.
using Mean = std::vector<Term>;

struct Share {
  const Mean& mean;
  double weight;
};

// The sum of means, each times its weight: the terms, ascending by point, whatever their weights are; and the mean that
// is left of them without those below 0.
std::vector<Term> terms_of(std::span<const Share> shares);
Mean sum_of(std::span<const Share> shares);

// Patches whose points are numbers of means; neighbours have the same.
struct MeanPatches {
  std::vector<Mean> means;
  std::vector<wire::PatchStencils> patches;
};

// With control points where they are here. As nodes hold them.
std::vector<wire::Patch> patches_of(const MeanPatches& means, std::span<const glm::dvec3> points);

// Of a skin, as nodes take it (wire::NetPoint, wire::Stencil).
struct ControlNet {
  std::vector<std::array<float, 3>> points;  // in the unit cube
  std::vector<VertexBones> bones;            // one a point
  std::size_t columns = 0;                   // points in a row of a B-spline surface; of a cage, all
  std::vector<wire::StencilTerm> terms;
  std::vector<wire::Stencil> stencils;
  std::vector<wire::PatchStencils> patches;

  std::span<const wire::StencilTerm> terms_of(const wire::Stencil& stencil) const {
    return std::span(terms).subspan(stencil.first_term, stencil.term_count);
  }
  bool operator==(const ControlNet&) const = default;
};

// One bones a point. Points that are at one place and follow the same count as one, so what is one point at rest, the
// pole of a loft, stays one, bit for bit.
ControlNet control_net(const MeanPatches& means, std::span<const glm::dvec3> points, std::vector<VertexBones> bones,
                       std::size_t columns);

// Where the means are if the net's points are at `moved`.
std::vector<glm::dvec3> means_of(const ControlNet& net, std::span<const glm::dvec3> moved);
// The same as patches.
std::vector<wire::Patch> patches_of(const ControlNet& net, std::span<const glm::dvec3> moved);

}  // namespace mars::modeler
