#include "host/content/modeler/scale_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "host/content/modeler/edit.h"
#include "host/content/modeler/frames.h"

namespace mars::modeler {
namespace {

constexpr double kSameBind = 1e-9;

document::Json written(const glm::dvec3& factors) {
  return factors.x == factors.y && factors.y == factors.z ? plain_number(factors.x) : plain_vector(factors);
}

glm::dvec3 factors_in(const document::Json& json) {
  if (json.is_array()) return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
  return glm::dvec3(json.get<double>());
}

void multiply(document::Json& object, const std::string& key, const glm::dvec3& factors) {
  object[key] = written(object.contains(key) ? factors * factors_in(object[key]) : factors);
}

// Proportions over those that a derived model has.
void add_to(document::Json& json, const Proportions& more) {
  if (json.is_null()) json = document::Json::object();
  for (const Scaling& scaling : more.joints)
    multiply(json[scaling.branch ? "branches" : "joints"], scaling.pattern, scaling.factors);
  if (more.scale != glm::dvec3(1)) multiply(json, "scale", more.scale);
  if (more.height)
    json["height"] = plain_number(*more.height);
  else if (json.contains("height"))
    json["height"] = plain_number(json["height"].get<double>() * more.scale.z);
  if (!more.ground) json["ground"] = false;
}

// Where it differs from what leaves the mesh where it is at rest.
void write_binds(const Model& model, const Joint& joint, document::Json& skin) {
  const std::vector<Axes> frames = rest_frames(model);
  const Axes& own = frames[static_cast<std::size_t>(&joint - model.joints.data())];
  skin.erase("bind");
  document::Json binds = document::Json::array();
  bool differ = false;
  for (const Bone& bone : joint.segment->bones) {
    const Affine usual = bind_at_rest(frames[bone.joint], own);
    document::Json rows = document::Json::array();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        rows.push_back(plain_number(bone.bind.turn[c][r]));
        differ = differ || std::abs(bone.bind.turn[c][r] - usual.turn[c][r]) > kSameBind;
      }
      rows.push_back(plain_number(bone.bind.place[r]));
      const double size = glm::length(joint.segment->sbb.max - joint.segment->sbb.min);
      differ = differ || std::abs(bone.bind.place[r] - usual.place[r]) > kSameBind * size;
    }
    binds.push_back(rows);
  }
  if (differ) skin["bind"] = binds;
}

void write_segment(const Model& model, const Joint& joint, document::Json& segment) {
  segment["sbb"] = {plain_vector(joint.segment->sbb.min), plain_vector(joint.segment->sbb.max)};
  if (joint.segment->bones.empty()) return;
  document::Json names = document::Json::array();
  for (const Bone& bone : joint.segment->bones) names.push_back(model.joints[bone.joint].name);
  segment["skin"]["joints"] = names;
  write_binds(model, joint, segment["skin"]);
}

bool same_segments(const Segment& a, const Segment& b) {
  return a.sbb == b.sbb && std::ranges::equal(a.bones, b.bones, {}, &Bone::bind, &Bone::bind);
}

}  // namespace

void scale_model(document::Json& json, const Model& model, const Proportions& proportions) {
  Model scaled = model;
  apply(proportions, scaled);
  if (!json.contains("joints")) return add_to(json["proportions"], proportions);
  for (document::Json& joint : json["joints"]) {
    const auto named = [&](const Joint& each) { return each.name == joint["name"]; };
    const auto number = static_cast<std::size_t>(std::ranges::find_if(model.joints, named) - model.joints.begin());
    const Joint &from = model.joints[number], &to = scaled.joints[number];
    if (to.place != from.place) joint["place"] = plain_vector(to.place);
    put_in_order(joint);
    if (to.segment && !same_segments(*to.segment, *from.segment)) write_segment(scaled, to, joint["segment"]);
  }
}

}  // namespace mars::modeler
