#include "host/content/animator/keys/written.h"

#include <cmath>

namespace mars::animator {
document::Json written(double number) {
  if (number == std::floor(number) && std::abs(number) < 1e15) return static_cast<std::int64_t>(number);
  return number;
}

document::Json written(const glm::dvec2& v) { return document::Json::array({written(v.x), written(v.y)}); }

document::Json written(const glm::dvec3& v) {
  return document::Json::array({written(v.x), written(v.y), written(v.z)});
}

document::Json written(const Point& point, const Film& film) {
  if (point.actor == modeler::kNone) return written(point.offset);
  const Actor& actor = film.actors[point.actor];
  document::Json json{{"actor", actor.name}};
  if (point.joint != modeler::kNone) json["joint"] = film.models[actor.model].joints[point.joint].name;
  if (point.offset != glm::dvec3(0)) json["offset"] = written(point.offset);
  if (point.joint_axes) json["axes"] = "joint";
  if (point.level) json["level"] = true;
  return json;
}

document::Json written(const Ease& ease) {
  for (const auto& [name, known] : kNamedEases)
    if (ease == known) return name;
  return document::Json::array({written(ease.x1), written(ease.y1), written(ease.x2), written(ease.y2)});
}

Ease ease_of(const document::Json& key) {
  const auto found = key.find("ease");
  if (found == key.end()) return kLinear;
  if (found->is_array()) return {found->at(0), found->at(1), found->at(2), found->at(3)};
  for (const auto& [name, known] : kNamedEases)
    if (*found == name) return known;
  return kLinear;
}

glm::dvec3 vector_of(const document::Json& array) { return {array.at(0), array.at(1), array.at(2)}; }

}  // namespace mars::animator
