// The part of a model's JSON that names its limbs (limbs.h), for the steps of edit.h. A limb is written "pelvis" or
// "left.knee".
#pragma once

#include <string>

#include "host/content/document/json_file.h"

namespace mars::modeler {

// The joint is this limb from now on, no other, and no other joint is. Throws Failure where there is no such limb.
void name_limb(document::Json& model, const std::string& joint, const std::string& limb);
// It is no limb any more, if it was one.
void forget_limb(document::Json& model, const std::string& joint);
// The joint has another name now.
void rename_limb(document::Json& model, const std::string& from, const std::string& to);
// "left.knee", or "" if it is none.
std::string limb_of(const document::Json& model, const std::string& joint);
// The other way round.
std::string joint_that_is(const document::Json& model, const std::string& limb);

}  // namespace mars::modeler
