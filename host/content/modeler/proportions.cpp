#include "host/content/modeler/proportions.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "hal/failure/failure.h"
#include "host/content/modeler/frames.h"

namespace mars::modeler {
namespace {

// The joints that the pattern fits, and those below if asked.
std::vector<bool> chosen(const Scaling& scaling, const std::vector<Joint>& joints) {
  std::vector<bool> some(joints.size());
  bool any = false;
  for (std::size_t number = 0; number < joints.size(); ++number) {
    const std::size_t parent = joints[number].parent;
    some[number] = fits(scaling.pattern, joints[number].name) || (scaling.branch && parent != kNone && some[parent]);
    any = any || some[number];
  }
  if (any) return some;
  std::vector<std::string_view> names;
  for (const Joint& joint : joints) names.push_back(joint.name);
  throw Failure("is no joint of the model", "joint '" + scaling.pattern + "'",
                document::did_you_mean(scaling.pattern, names, "name a joint, or several: *-leg"));
}

// Of what a joint moves, along its own axes.
Affine scaling_of(const Joint& joint, const glm::dvec3& factors) {
  glm::dmat3 scaled = segment_axes(joint);
  for (int axis = 0; axis < 3; ++axis) scaled[axis] *= factors[axis];
  return {scaled * glm::inverse(segment_axes(joint)), glm::dvec3(0)};
}

// What follows a bone is scaled as the bone's joint is.
void scale_skins(Model& model, const std::vector<glm::dvec3>& factors) {
  for (std::size_t number = 0; number < factors.size(); ++number) {
    const Joint& joint = model.joints[number];
    if (!joint.segment) continue;
    const Affine back = inverse(scaling_of(joint, factors[number]));
    for (Bone& bone : model.joints[number].segment->bones)
      bone.bind = product(product(scaling_of(model.joints[bone.joint], factors[bone.joint]), bone.bind), back);
  }
}

// factors[i]: of joint i. Joints that hang on nothing are carried by `whole`.
void scale_joints(Model& model, const std::vector<glm::dvec3>& factors, const glm::dvec3& whole) {
  scale_skins(model, factors);
  for (std::size_t number = 0; number < factors.size(); ++number) {
    Joint& joint = model.joints[number];
    if (joint.segment) {
      joint.segment->sbb.min *= factors[number];
      joint.segment->sbb.max *= factors[number];
    }
    if (joint.parent == kNone) {
      joint.place *= whole;
    } else if (factors[joint.parent] != glm::dvec3(1)) {
      const glm::dmat3 axes = segment_axes(model.joints[joint.parent]);
      joint.place = axes * (factors[joint.parent] * (glm::inverse(axes) * joint.place));
    }
  }
}

void scale_all(Model& model, const glm::dvec3& factors) {
  scale_joints(model, std::vector<glm::dvec3>(model.joints.size(), factors), factors);
}

void scale_to_height(Model& model, double height) {
  const auto bounds = rest_bounds(model);
  if (!bounds || bounds->max.z <= bounds->min.z)
    throw Failure("has no height", "", "give it segments, or scale it by a factor");
  scale_all(model, glm::dvec3(height / (bounds->max.z - bounds->min.z)));
}

void keep_ground(Model& model, double ground) {
  const double lowest = rest_bounds(model)->min.z;
  for (Joint& joint : model.joints)
    if (joint.parent == kNone) joint.place.z += ground - lowest;
}

// One number, or one for each axis.
glm::dvec3 read_factors(const document::Element& element) {
  const document::Range& range = keys::range_of("proportions", "scale");
  return element.kind() == document::Kind::list ? document::read_vector(element, range)
                                                : glm::dvec3(document::read_number(element, range));
}

}  // namespace

bool fits(std::string_view pattern, std::string_view name) {
  std::size_t at = 0, in = 0, star = std::string_view::npos, after = 0;
  while (in < name.size()) {
    if (at < pattern.size() && pattern[at] == '*') {
      star = at++;
      after = in;
    } else if (at < pattern.size() && pattern[at] == name[in]) {
      ++at, ++in;
    } else if (star != std::string_view::npos) {
      at = star + 1;
      in = ++after;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', at) == std::string_view::npos;
}

void apply(const Proportions& proportions, Model& model) {
  const auto before = rest_bounds(model);
  std::vector<glm::dvec3> factors(model.joints.size(), proportions.scale);
  for (const Scaling& scaling : proportions.joints) {
    const std::vector<bool> some = chosen(scaling, model.joints);
    for (std::size_t number = 0; number < factors.size(); ++number)
      if (some[number]) factors[number] *= scaling.factors;
  }
  scale_joints(model, factors, proportions.scale);
  if (proportions.height) scale_to_height(model, *proportions.height);
  if (proportions.ground && before) keep_ground(model, before->min.z);
}

Proportions read_proportions(const document::Element& element) {
  const document::Fields fields(element, keys::object("proportions"));
  Proportions proportions;
  for (const bool branch : {false, true}) {
    const auto list = fields.find(branch ? "branches" : "joints");
    if (!list) continue;
    document::require_kind(*list, document::Kind::object);
    for (const document::Element item : *list)
      proportions.joints.push_back({std::string(item.key()), branch, read_factors(item)});
  }
  proportions.scale = read_factors(fields.value("scale"));
  if (const auto height = fields.find("height"))
    proportions.height = document::read_number(*height, fields.key("height"));
  proportions.ground = fields.flag("ground");
  return proportions;
}

}  // namespace mars::modeler
