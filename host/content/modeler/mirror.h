// A figure's limbs of one side put on the other: mirrored at the plane y = 0 of the model's frame. With M that
// mirror, a joint's axes become M X and -M Y, so that Z = X x Y becomes M Z and turns about x and z change their sign;
// a box changes the sign of its y. On the JSON of a model, as the steps of edit.h.
#pragma once

#include <string>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/content/modeler/model.h"

namespace mars::modeler {

struct Mirrored {
  std::vector<std::string> changed, added;  // joints of the other side
};

// All joints of side `from`, or the branch that begins with `joint` if that is not "". Joints that have no counterpart
// (sides.h) get one. `meaning` is what `model` is read as. Throws where there is nothing to mirror.
Mirrored mirror(document::Json& model, const Model& meaning, Side from, const std::string& joint);

// The patches, B-spline or mesh of an own shape as a mirror shows them, y to 1 - y.
document::Json mirrored_shape(const document::Json& shape);

}  // namespace mars::modeler
