#include "host/studio/project/same_shapes.h"

#include <algorithm>

namespace mars::studio {
namespace {

bool same_patch(const wire::Patch& one, const wire::Patch& two) { return one.points == two.points; }

bool same_model(const modeler::Model& one, const modeler::Model& two) {
  return same_segments(one, two) && std::ranges::equal(one.shapes, two.shapes, same_shape);
}

}  // namespace

bool same_shape(const modeler::Shape& one, const modeler::Shape& two) {
  return std::ranges::equal(one.patches, two.patches, same_patch) && one.mesh == two.mesh && one.net == two.net;
}

bool same_segments(const modeler::Model& one, const modeler::Model& two) {
  const auto shape_of = [](const modeler::Joint& joint) {
    return joint.segment ? joint.segment->shape : modeler::kNone;
  };
  return std::ranges::equal(one.joints, two.joints, {}, shape_of, shape_of);
}

bool same_actors(const animator::Film& one, const animator::Film& two) {
  const auto model_of = [](const animator::Actor& actor) { return actor.model; };
  return std::ranges::equal(one.actors, two.actors, {}, model_of, model_of);
}

bool same_shapes(const animator::Film& one, const animator::Film& two) {
  return same_actors(one, two) && std::ranges::equal(one.models, two.models, same_model);
}

std::optional<std::size_t> pulled_shape(const modeler::Model& one, const modeler::Model& two) {
  if (!same_segments(one, two) || one.shapes.size() != two.shapes.size()) return std::nullopt;
  std::optional<std::size_t> pulled;
  for (std::size_t shape = 0; shape < one.shapes.size(); ++shape) {
    if (same_shape(one.shapes[shape], two.shapes[shape])) continue;
    if (pulled || one.shapes[shape].mesh || one.shapes[shape].patches.size() != two.shapes[shape].patches.size() ||
        one.shapes[shape].net || two.shapes[shape].net)
      return std::nullopt;
    pulled = shape;
  }
  return pulled;
}

}  // namespace mars::studio
