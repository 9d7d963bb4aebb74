#include "host/content/modeler/scale_model.h"

#include <algorithm>
#include <string>

#include "host/content/modeler/edit.h"

namespace mars::modeler {
namespace {

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
    if (to.segment && !(to.segment->sbb == from.segment->sbb))
      joint["segment"]["sbb"] = {plain_vector(to.segment->sbb.min), plain_vector(to.segment->sbb.max)};
  }
}

}  // namespace mars::modeler
