#include "host/content/modeler/edit.h"

#include <algorithm>
#include <set>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/modeler/edit_limbs.h"
#include "host/content/modeler/edit_material.h"
#include "host/content/modeler/shape_library.h"

namespace mars::modeler {
namespace {

std::string joint_of(const std::string& name) { return "joint '" + name + "'"; }
std::string material_of(const std::string& name) { return "material '" + name + "'"; }

std::string near(const std::string& wanted, const std::vector<std::string>& names, const std::string& otherwise) {
  return document::did_you_mean(wanted, std::vector<std::string_view>(names.begin(), names.end()), otherwise);
}

document::Json& joints_of(document::Json& model) {
  if (!model.contains("joints"))
    throw Failure("has no joints of its own", "",
                  "change " + model.value("from", "the other file") +
                      ", or this one's proportions: mars model MODEL scale");
  return model["joints"];
}

std::vector<std::string> names_of(const document::Json& joints) {
  std::vector<std::string> names;
  for (const document::Json& joint : joints) names.push_back(joint.at("name"));
  return names;
}

document::Json* find_joint(document::Json& model, const std::string& name) {
  for (document::Json& joint : joints_of(model))
    if (joint.at("name") == name) return &joint;
  return nullptr;
}

document::Json& joint_named(document::Json& model, const std::string& name) {
  if (document::Json* joint = find_joint(model, name)) return *joint;
  const std::vector<std::string> names = names_of(joints_of(model));
  throw Failure("is not in the model", joint_of(name), near(name, names, "mars model MODEL show lists the joints"));
}

// As the table lists its keys, then any others.
void put_in_order(document::Json& object, std::string_view name) {
  document::Json sorted = document::Json::object();
  for (const std::string_view key : keys::object(name).names)
    if (const auto found = object.find(key); found != object.end()) sorted[std::string(key)] = *found;
  for (auto item = object.begin(); item != object.end(); ++item)
    if (!sorted.contains(item.key())) sorted[item.key()] = item.value();
  object = std::move(sorted);
}

void change_limits(document::Json& joint, const JointChange& change) {
  if (change.freedom == Freedom::free) joint.erase("limits");
  if (change.freedom == Freedom::fixed) joint["limits"] = document::Json::object();
  if (change.limits.empty()) return;
  if (!joint.contains("limits")) joint["limits"] = {{"x", {-180, 180}}, {"y", {-180, 180}}, {"z", {-180, 180}}};
  document::Json& limits = joint["limits"];
  for (const auto& [axis, range] : change.limits)
    limits[std::string(1, axis)] = {plain_number(range.lower), plain_number(range.upper)};
  put_in_order(limits, "limits");
}

// But for that of the shape.
void forget_options(document::Json& segment, const std::string& shape) {
  const LibraryShape* const known = find_library_shape(shape);
  const keys::Key* const own = known ? known->option : nullptr;
  for (const keys::Key* const option : keys::kShapeOptions)
    if (option != own) segment.erase(std::string(option->name));
}

bool uses(const document::Json& joint, const std::string& material) {
  return joint.contains("segment") && joint["segment"].value("material", "") == material;
}

std::vector<std::string> materials_known(document::Json& model) {
  std::set<std::string> names;
  if (const auto materials = model.find("materials"); materials != model.end())
    for (auto material = materials->begin(); material != materials->end(); ++material) names.insert(material.key());
  if (model.contains("joints"))
    for (const document::Json& joint : model["joints"])
      if (joint.contains("segment")) names.insert(joint["segment"].value("material", ""));
  names.erase("");
  return {names.begin(), names.end()};
}

// The model's own, or one that a segment already takes from the film.
void require_material(document::Json& model, const std::string& material, const std::string& joint) {
  const std::vector<std::string> known = materials_known(model);
  if (std::ranges::count(known, material)) return;
  throw Failure("is given the material '" + material + "', which the model has not", joint_of(joint),
                near(material, known, "add it: give --color R G B too"));
}

void change_segment(document::Json& model, document::Json& joint, const document::Json& values) {
  if (values.empty()) return;
  const auto shape = values.find("shape"), material = values.find("material");
  const bool is_new = !joint.contains("segment");
  if (is_new && shape == values.end())
    throw Failure("has no segment", joint_of(joint["name"]), "give it a shape: --shape box");
  if (material != values.end()) require_material(model, *material, joint["name"]);
  document::Json& segment = joint["segment"];
  if (!is_new && shape != values.end()) forget_options(segment, *shape);
  segment.update(values);
  put_in_order(segment, "segment");
}

void reset(document::Json& joint, const std::string& what) {
  if (what == "axes") {
    joint.erase("x_axis");
    joint.erase("y_axis");
  } else if (what == "sbb" || what == "material") {
    if (joint.contains("segment")) joint["segment"].erase(what);
  } else {
    joint.erase(what);
  }
}

// Everything but the name.
void change_joint(document::Json& model, document::Json& joint, const JointChange& change) {
  for (const std::string& what : change.reset) what == "limb" ? forget_limb(model, joint["name"]) : reset(joint, what);
  joint.update(change.joint);
  change_limits(joint, change);
  change_segment(model, joint, change.segment);
  put_in_order(joint, "joint");
}

void refuse_known(document::Json& model, const std::string& name) {
  if (find_joint(model, name))
    throw Failure("is in the model already", joint_of(name), "choose another name, or change it: mars model MODEL set");
}

// The names of a skin's joints; nullptr where it has none.
document::Json* bones_of(document::Json& joint) {
  if (!joint.contains("segment") || !joint["segment"].contains("skin")) return nullptr;
  return &joint["segment"]["skin"]["joints"];
}

void refuse_bone(document::Json& model, const std::string& name) {
  for (document::Json& joint : joints_of(model))
    if (const document::Json* const bones = bones_of(joint); bones && std::ranges::count(*bones, document::Json(name)))
      throw Failure("is a bone of the skin of '" + joint["name"].get<std::string>() + "'", joint_of(name),
                    "remove that joint too, or let it be");
}

void rename_joint(document::Json& model, const std::string& from, const std::string& to) {
  refuse_known(model, to);
  for (document::Json& joint : joints_of(model)) {
    if (joint["name"] == from) joint["name"] = to;
    if (joint.value("parent", "") == from) joint["parent"] = to;
    if (document::Json* const bones = bones_of(joint))
      std::ranges::replace(*bones, document::Json(from), document::Json(to));
  }
  rename_limb(model, from, to);
}

std::string listed(const std::vector<std::string>& names) { return "'" + document::joined(names, "', '") + "'"; }

std::vector<std::string> children_of(const document::Json& joints, const std::string& name) {
  std::vector<std::string> children;
  for (const document::Json& joint : joints)
    if (joint.value("parent", "") == name) children.push_back(joint["name"]);
  return children;
}

void refuse_limb(const document::Json& model, const std::string& name) {
  if (const std::string limb = limb_of(model, name); !limb.empty())
    throw Failure("is one of the model's limbs: " + limb, joint_of(name),
                  "make another joint it, --limb " + limb + ", or this one none, --reset limb");
}

document::Json& materials_of(document::Json& model) {
  document::Json& materials = model["materials"];
  if (materials.is_null()) materials = document::Json::object();
  return materials;
}

void require_known_material(document::Json& model, const std::string& name) {
  if (model.contains("materials") && model["materials"].contains(name)) return;
  throw Failure("is not in the model", material_of(name),
                near(name, materials_known(model), "add it: mars model MODEL add"));
}

}  // namespace

document::Json plain_vector(const glm::dvec3& vector) {
  return {plain_number(vector.x), plain_number(vector.y), plain_number(vector.z)};
}

void put_in_order(document::Json& joint) { put_in_order(joint, "joint"); }

document::Json empty_model() { return {{"joints", document::Json::array()}}; }

document::Json derived_model(const std::string& from) {
  return {{"from", from}, {"proportions", document::Json::object()}};
}

void add_joint(document::Json& model, const std::string& name, const JointChange& change) {
  refuse_known(model, name);
  document::Json joint = {{"name", name}};
  if (!change.limits.empty()) joint["limits"] = document::Json::object();
  change_joint(model, joint, change);
  joints_of(model).push_back(joint);
  if (!change.limb) return;
  if (const std::string other = joint_that_is(model, *change.limb); !other.empty())
    throw Failure("cannot be " + *change.limb + " too: '" + other + "' is", joint_of(name),
                  "leave --limb out; mars model MODEL set ... --limb gives it to another joint");
  name_limb(model, name, *change.limb);
}

void set_joint(document::Json& model, const std::string& name, const JointChange& change) {
  change_joint(model, joint_named(model, name), change);
  if (change.limb) name_limb(model, name, *change.limb);
  if (change.name && *change.name != name) rename_joint(model, name, *change.name);
}

void remove_joint(document::Json& model, const std::string& name, bool branch) {
  joint_named(model, name);
  const document::Json& joints = joints_of(model);
  std::vector<std::string> going{name};
  for (std::size_t at = 0; at < going.size(); ++at) {
    const std::vector<std::string> children = children_of(joints, going[at]);
    if (!branch && !children.empty())
      throw Failure("carries " + listed(children), joint_of(name),
                    "remove them too: --branch; or hang them on another joint: mars model MODEL set ... --parent");
    going.insert(going.end(), children.begin(), children.end());
  }
  if (going.size() == joints.size())
    throw Failure(going.size() == 1 ? "is the model's last" : "carries all the others", joint_of(name),
                  "a model has at least one joint");
  for (const std::string& each : going) refuse_limb(model, each);
  document::Json left = document::Json::array();
  for (const document::Json& joint : joints)
    if (!std::ranges::count(going, joint["name"].get<std::string>())) left.push_back(joint);
  model["joints"] = std::move(left);
  for (const std::string& each : going) refuse_bone(model, each);
}

void add_material(document::Json& model, const std::string& name, const document::Json& values) {
  document::Json material = document::Json::object();
  change_material(material, values);
  document::Json& materials = materials_of(model);
  if (materials.contains(name) && materials[name] != material)
    throw Failure("is in the model already, and looks otherwise", material_of(name), "change it: mars model MODEL set");
  materials[name] = material;
}

void set_material(document::Json& model, const std::string& name, const document::Json& values,
                  const std::optional<std::string>& new_name) {
  require_known_material(model, name);
  change_material(model["materials"][name], values);
  if (!new_name || *new_name == name) return;
  if (model["materials"].contains(*new_name))
    throw Failure("is in the model already", material_of(*new_name), "choose another name");
  document::Json renamed = document::Json::object();
  for (auto item = model["materials"].begin(); item != model["materials"].end(); ++item)
    renamed[item.key() == name ? *new_name : item.key()] = item.value();
  model["materials"] = std::move(renamed);
  for (document::Json& joint : joints_of(model))
    if (uses(joint, name)) joint["segment"]["material"] = *new_name;
}

void remove_material(document::Json& model, const std::string& name) {
  require_known_material(model, name);
  std::vector<std::string> users;
  if (model.contains("joints"))
    for (const document::Json& joint : model["joints"])
      if (uses(joint, name)) users.push_back(joint["name"]);
  if (!users.empty())
    throw Failure("is what " + listed(users) + (users.size() == 1 ? " is" : " are") + " made of", material_of(name),
                  "give them another first: mars model MODEL set ... --material");
  model["materials"].erase(name);
  if (model["materials"].empty()) model.erase("materials");
}

}  // namespace mars::modeler
