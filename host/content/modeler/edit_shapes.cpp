#include "host/content/modeler/edit_shapes.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/modeler/edit.h"

namespace mars::modeler {
namespace {

using document::Json;

const Joint* find_joint(const Model& meaning, const std::string& name) {
  const auto found = std::ranges::find_if(meaning.joints, [&](const Joint& joint) { return joint.name == name; });
  return found == meaning.joints.end() ? nullptr : &*found;
}

[[noreturn]] void refuse(const std::string& problem, const std::string& joint, const std::string& remedy) {
  throw Failure(problem, "joint '" + joint + "'", remedy);
}

// The model's own shape as the file has it; null where it is one of the library.
const Json* own_shape(const Json& model, const std::string& name) {
  const auto shapes = model.find("shapes");
  if (shapes == model.end()) return nullptr;
  const auto shape = shapes->find(name);
  return shape == shapes->end() ? nullptr : &*shape;
}

bool is_subdivision(const Json& shape) { return shape.is_object() && shape.contains("subdivision"); }

bool is_mesh(const Shape& shape) { return shape.mesh.has_value(); }

glm::dvec3 place_of(const Json& point) { return {point[0], point[1], point[2]}; }

void add_rows(const Json& rows, std::vector<ControlPoint>& points) {
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = 0; i < rows[j].size(); ++i) points.push_back({0, {i, j}, place_of(rows[j][i])});
}

void add_points(const Json& list, std::vector<ControlPoint>& points) {
  for (std::size_t i = 0; i < list.size(); ++i) points.push_back({0, {i, 0}, place_of(list[i])});
}

void add_points(const std::vector<wire::Patch>& patches, std::vector<ControlPoint>& points) {
  for (std::size_t patch = 0; patch < patches.size(); ++patch)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& place = patches[patch].points[4 * j + i];
        points.push_back({patch, {i, j}, {place[0], place[1], place[2]}});
      }
}

// As a file has them: a coordinate is read as the same number again.
Json written(const std::vector<wire::Patch>& patches) {
  Json list = Json::array();
  for (const wire::Patch& patch : patches) {
    Json points = Json::array();
    for (const auto& point : patch.points) points.push_back(plain_vector({point[0], point[1], point[2]}));
    list.push_back(std::move(points));
  }
  return list;
}

// Every point of the shape.
template <typename Visit>
void for_each_point(Json& shape, Visit visit) {
  if (is_subdivision(shape)) {
    for (Json& point : shape["subdivision"]["points"]) visit(point);
    return;
  }
  Json& lists = shape.is_array() ? shape : shape["bspline"]["points"];
  for (Json& list : lists)
    for (Json& point : list) visit(point);
}

Json& point_of(Json& shape, const std::string& joint, const ControlPoint& wanted) {
  const auto [i, j] = wanted.at;
  if (shape.is_array() && wanted.patch < shape.size() && i < 4 && j < 4) return shape[wanted.patch][4 * j + i];
  if (is_subdivision(shape)) {
    Json& points = shape["subdivision"]["points"];
    if (wanted.patch == 0 && j == 0 && i < points.size()) return points[i];
  } else if (!shape.is_array() && wanted.patch == 0) {
    Json& rows = shape["bspline"]["points"];
    if (j < rows.size() && i < rows[j].size()) return rows[j][i];
  }
  refuse(document::formatted("has no point %zu, %zu of patch %zu", i, j, wanted.patch), joint, "choose another");
}

std::string free_name(const Json& model, const std::string& joint) {
  std::string name = joint + "-shape";
  while (own_shape(model, name)) name += "-2";
  return name;
}

// Returns the new shape's name.
std::string make_own(Json& model, const Shape& shape, const std::string& joint) {
  const std::string name = free_name(model, joint);
  model["shapes"][name] = written(shape.patches);
  JointChange change;
  change.segment["shape"] = name;
  set_joint(model, joint, change);
  return name;
}

}  // namespace

std::vector<ControlPoint> control_points(const Json& model, const Model& meaning, const std::string& joint) {
  const Joint* const found = find_joint(meaning, joint);
  if (!found || !found->segment) return {};
  const Shape& shape = meaning.shapes[found->segment->shape];
  std::vector<ControlPoint> points;
  const Json* const own = own_shape(model, shape.name);
  if (own && own->is_object() && own->contains("bspline"))
    add_rows((*own)["bspline"]["points"], points);
  else if (own && is_subdivision(*own))
    add_points((*own)["subdivision"]["points"], points);
  else
    add_points(shape.patches, points);
  return points;
}

std::string set_point(Json& model, const Model& meaning, const std::string& joint, const ControlPoint& point) {
  const Joint* const found = find_joint(meaning, joint);
  if (!found) refuse("is not in the model", joint, "mars model MODEL show lists the joints");
  if (!model.contains("joints"))
    throw Failure("has no joints of its own", "", "change " + model.value("from", "the other file"));
  if (!found->segment) refuse("has no segment", joint, "give it a shape");
  const Shape& shape = meaning.shapes[found->segment->shape];
  if (is_mesh(shape)) refuse("is a mesh, which has no control points", joint, "choose another shape");
  std::string made;
  if (!own_shape(model, shape.name)) made = make_own(model, shape, joint);
  Json& own = model["shapes"][made.empty() ? shape.name : made];
  const Json from = point_of(own, joint, point);
  for (int axis = 0; axis < 3; ++axis)
    if (!(point.place[axis] >= 0 && point.place[axis] <= 1))
      refuse("has a point at " + document::shown(point.place[axis]) + " of its box", joint,
             "write numbers from 0 to 1; to make the box larger, change its sbb");
  const Json to = plain_vector(point.place);
  for_each_point(own, [&](Json& each) {
    if (each == from) each = to;
  });
  return made;
}

}  // namespace mars::modeler
