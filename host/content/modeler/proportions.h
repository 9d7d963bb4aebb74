// Other bodies of the same segments (thesis 2.3): joints made larger or smaller along their own axes. A joint's factors
// move all that is fixed to it alike - its sbb, and the places of the joints it carries - by A = [X Y Z] S [X Y Z]^-1,
// so each child stays where it was on its parent's surface, and limbs stay together. Turns and limits stay.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/content/document/fields.h"
#include "host/content/document/json_file.h"
#include "host/content/modeler/model.h"

namespace mars::modeler {

// Of joints whose names fit the pattern, in which * stands for any text; `branch`: with all that hangs on them.
struct Scaling {
  std::string pattern;
  bool branch = false;
  glm::dvec3 factors{1, 1, 1};  // along x, y, z of each joint
};

// The key "proportions" of a model file, in the order in which it is done.
struct Proportions {
  std::vector<Scaling> joints;   // factors of several that fit one joint are multiplied
  glm::dvec3 scale{1, 1, 1};     // of all joints
  std::optional<double> height;  // at rest, from the lowest to the highest point; all is scaled alike to it
  bool ground = true;            // the lowest point at rest stays as high as it was
};

bool fits(std::string_view pattern, std::string_view name);

// Throws a Failure where a pattern fits no joint, or a height is asked of a model without segments.
void apply(const Proportions& proportions, Model& model);

Proportions read_proportions(const document::Element& element);

}  // namespace mars::modeler
