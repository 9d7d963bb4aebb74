// Steps by which commands, and later the studio, change a model: each on the JSON of a model that read_model() took
// (model_file.h reads and writes it), so that what a person wrote stays as written. What read_model() finds, such as
// an unknown shape, is refused when the file is written. Failures name the joint or material.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/content/modeler/model.h"

namespace mars::modeler {

enum class Freedom { as_it_was, fixed, free };

// Of one joint; what is not there stays as it was.
struct JointChange {
  std::vector<std::string> reset;  // of kResets, to their defaults
  std::optional<std::string> name;
  document::Json joint = document::Json::object();    // values of its keys, as a file writes them: place, x_axis ...
  document::Json segment = document::Json::object();  // the same; another shape loses the options of that before
  Freedom freedom = Freedom::as_it_was;
  std::vector<std::pair<char, Limits>> limits;  // of x, y or z; after `freedom`
  std::optional<std::string> limb;              // it becomes the figure's "pelvis", "left.knee", ...
};

inline constexpr std::string_view kResets[] = {"parent",  "place", "axes",     "limits",
                                               "segment", "sbb",   "material", "limb"};

// A model without joints, to which the first is added at once.
document::Json empty_model();
// A model that is made from another file by proportions.
document::Json derived_model(const std::string& from);

// A new joint with limits of some axes turns about no other; without any it is free.
void add_joint(document::Json& model, const std::string& name, const JointChange& change);
// A new name is also put where others name the joint.
void set_joint(document::Json& model, const std::string& name, const JointChange& change);
// Joints that hang on it are removed too if `branch`, else they are in the way.
void remove_joint(document::Json& model, const std::string& name, bool branch);

// With these values (edit_material.h). One that is there already must look the same.
void add_material(document::Json& model, const std::string& name, const document::Json& values);
// `new_name` is also put into the segments made of it.
void set_material(document::Json& model, const std::string& name, const document::Json& values,
                  const std::optional<std::string>& new_name);
void remove_material(document::Json& model, const std::string& name);

// The keys of a joint in the order in which people read them.
void put_in_order(document::Json& joint);

using document::plain_number;
document::Json plain_vector(const glm::dvec3& vector);

}  // namespace mars::modeler
