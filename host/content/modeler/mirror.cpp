#include "host/content/modeler/mirror.h"

#include <algorithm>
#include <map>

#include "hal/failure/failure.h"
#include "host/content/modeler/edit.h"
#include "host/content/modeler/edit_limbs.h"
#include "host/content/modeler/shape_library.h"
#include "host/content/modeler/sides.h"

namespace mars::modeler {
namespace {

using document::Json;

// Exact, as a person would write it.
Json negated(const Json& number) {
  if (number.is_number_unsigned() || number.is_number_integer()) return -number.get<std::int64_t>();
  return number.get<double>() == 0 ? Json(0) : Json(-number.get<double>());
}

// The name of a shape's mirror image, where the shape's own names no side.
std::string toggled(const std::string& shape) {
  constexpr std::string_view kSuffix = "-mirrored";
  return shape.ends_with(kSuffix) ? shape.substr(0, shape.size() - kSuffix.size()) : shape + std::string(kSuffix);
}

Json from_other_side(const Json& share) { return plain_number(1 - share.get<double>()); }

void negate(Json& vector, std::initializer_list<int> axes) {
  for (const int axis : axes) vector[axis] = negated(vector[axis]);
}

// [lower, upper] as seen in the mirror.
void turn_round(Json& lower, Json& upper) {
  Json least = negated(upper);
  upper = negated(lower);
  lower = std::move(least);
}

void mirror_points(Json& points) {
  for (Json& point : points) point[1] = from_other_side(point[1]);
}

// Along u it runs the other way round, so that the outside stays outside.
Json mirrored_patch(Json patch) {
  mirror_points(patch);
  for (int row = 0; row < 4; ++row) std::reverse(patch.begin() + 4 * row, patch.begin() + 4 * row + 4);
  return patch;
}

Json reversed_knots(const Json& knots) {
  const double sum = knots.front().get<double>() + knots.back().get<double>();
  Json reversed = Json::array();
  for (std::size_t i = knots.size(); i-- > 0;) reversed.push_back(plain_number(sum - knots[i].get<double>()));
  return reversed;
}

// Reversed along u, as a patch is; where u is periodic, point i of n points and degree d becomes point n - 1 - d - i of
// the reversed knots.
Json mirrored_bspline(Json bspline) {
  Json& u = bspline["u"];
  const std::size_t degree = u.is_null() ? 3 : u.value("degree", std::size_t{3});
  const bool periodic = !u.is_null() && u.value("ends", "clamped") == "periodic";
  if (!u.is_null() && u.contains("knots")) u["knots"] = reversed_knots(u["knots"]);
  if (u.is_null()) bspline.erase("u");
  for (Json& row : bspline["points"]) {
    mirror_points(row);
    std::reverse(row.begin(), row.end());
    if (periodic) std::rotate(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(degree), row.end());
  }
  return bspline;
}

Json mirrored_subdivision(Json cage) {
  mirror_points(cage["points"]);
  for (Json& face : cage["faces"]) std::reverse(face.begin(), face.end());
  return cage;
}

Json mirrored_mesh(Json mesh) {
  mirror_points(mesh["vertices"]);
  for (const char* faces : {"faces", "paint_faces"})
    if (mesh.contains(faces))
      for (Json& face : mesh[faces]) std::reverse(face.begin(), face.end());
  if (mesh.contains("normals"))
    for (Json& normal : mesh["normals"]) negate(normal, {1});
  return mesh;
}

class Mirror {
 public:
  Mirror(Json& model, const Model& meaning, Side from)
      : model_(model),
        meaning_(meaning),
        from_(from),
        sides_(sides_of(meaning)),
        counterparts_(counterparts_of(meaning)) {
    for (const Joint& joint : meaning.joints) names_[joint.name] = names_.size();
  }

  Mirrored run(const std::string& root) {
    require_own_joints();
    const std::vector<std::size_t> sources = sources_of(root);
    for (const std::size_t source : sources) name_target(source);
    for (const std::size_t source : sources) put(source);
    return std::move(done_);
  }

 private:
  void require_own_joints() const {
    if (!model_.contains("joints"))
      throw Failure("has no joints of its own", "", "mirror the joints of " + model_.value("from", "the other file"));
  }

  std::vector<std::size_t> sources_of(const std::string& root) const {
    std::vector<std::size_t> sources;
    std::vector<bool> in(meaning_.joints.size());
    for (std::size_t joint = 0; joint < in.size(); ++joint) {
      const std::size_t parent = meaning_.joints[joint].parent;
      in[joint] = root.empty() || meaning_.joints[joint].name == root || (parent != kNone && in[parent]);
      if (in[joint] && sides_[joint] == from_) sources.push_back(joint);
    }
    if (sources.empty())
      throw Failure("is nothing on its " + name_of(from_) + " side", root.empty() ? "there" : "of joint '" + root + "'",
                    "left has positive y; or name a joint left-..., or say which limb it is");
    return sources;
  }

  // The joint that is changed, or made.
  void name_target(std::size_t source) {
    if (counterparts_[source] != kNone) {
      targets_[source] = meaning_.joints[counterparts_[source]].name;
      return;
    }
    const std::string& name = meaning_.joints[source].name;
    std::string target = other_side_name(name);
    if (target.empty()) target = name_of(other(from_)) + "-" + name;
    while (names_.contains(target)) target += "-2";
    names_[target] = names_.size();
    targets_[source] = target;
  }

  Json* joint_named(const std::string& name) {
    for (Json& joint : model_["joints"])
      if (joint["name"] == name) return &joint;
    return nullptr;
  }

  std::string parent_of_target(std::size_t source) const {
    const std::size_t parent = meaning_.joints[source].parent;
    if (sides_[parent] != from_) return meaning_.joints[parent].name;
    if (const auto made = targets_.find(parent); made != targets_.end()) return made->second;
    if (counterparts_[parent] != kNone) return meaning_.joints[counterparts_[parent]].name;
    throw Failure("hangs on '" + meaning_.joints[parent].name + "', which has no counterpart",
                  "joint '" + meaning_.joints[source].name + "'", "mirror that joint");
  }

  void put(std::size_t source) {
    const std::string &from = meaning_.joints[source].name, &to = targets_[source];
    Json joint = *joint_named(from);
    joint["name"] = to;
    if (joint.contains("parent")) joint["parent"] = parent_of_target(source);
    if (joint.contains("place")) negate(joint["place"], {1});
    if (joint.contains("x_axis")) negate(joint["x_axis"], {1});
    if (joint.contains("y_axis")) negate(joint["y_axis"], {0, 2});
    for (const char* axis : {"x", "z"})
      if (joint.contains("limits") && joint["limits"].contains(axis))
        turn_round(joint["limits"][axis][0], joint["limits"][axis][1]);
    if (joint.contains("segment")) {
      if (joint["segment"].contains("skin"))
        throw Failure("has a skin, which has no other side", "joint '" + from + "'", "mirror joints without skins");
      mirror_segment(joint["segment"]);
    }
    Json* const there = joint_named(to);
    (there ? done_.changed : done_.added).push_back(to);
    if (there)
      *there = std::move(joint);
    else
      model_["joints"].push_back(std::move(joint));
    const std::string limb = other_side_name(limb_of(model_, from));
    if (!limb.empty() && joint_that_is(model_, limb) != to) name_limb(model_, to, limb);
  }

  void mirror_segment(Json& segment) {
    if (!segment.contains("sbb")) segment["sbb"] = {plain_vector(Box().min), plain_vector(Box().max)};
    turn_round(segment["sbb"][0][1], segment["sbb"][1][1]);
    const std::string shape = segment["shape"];
    const std::string mirrored = other_side_name(shape);
    if (find_library_shape(shape)) {
      if (find_library_shape(mirrored)) segment["shape"] = mirrored;
      return;
    }
    const std::string name = mirrored.empty() ? toggled(shape) : mirrored;
    model_["shapes"][name] = mirrored_shape(model_["shapes"][shape]);
    segment["shape"] = name;
  }

  Json& model_;
  const Model& meaning_;
  Side from_;
  std::vector<std::optional<Side>> sides_;
  std::vector<std::size_t> counterparts_;
  std::map<std::string, std::size_t> names_;
  std::map<std::size_t, std::string> targets_;  // of sources
  Mirrored done_;
};

}  // namespace

Json mirrored_shape(const Json& shape) {
  if (shape.is_array()) {
    Json patches = Json::array();
    for (const Json& patch : shape) patches.push_back(mirrored_patch(patch));
    return patches;
  }
  if (shape.contains("bspline")) return {{"bspline", mirrored_bspline(shape["bspline"])}};
  if (shape.contains("subdivision")) return {{"subdivision", mirrored_subdivision(shape["subdivision"])}};
  return {{"mesh", mirrored_mesh(shape["mesh"])}};
}

Mirrored mirror(Json& model, const Model& meaning, Side from, const std::string& joint) {
  return Mirror(model, meaning, from).run(joint);
}

}  // namespace mars::modeler
