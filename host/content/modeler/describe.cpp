#include "host/content/modeler/describe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "host/content/document/fields.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/frames.h"

namespace mars::modeler {
namespace {

constexpr double kSquare = 1e-3;  // degrees from a right angle that are rounding

using Row = std::vector<std::string>;

double without_rounding(double number) { return std::abs(number) < 1e-9 ? 0 : number; }

// "0.5 x 1 x 2", to four digits.
std::string size_text(const glm::dvec3& size) {
  return document::formatted("%.4g x %.4g x %.4g", size.x, size.y, size.z);
}

// "free", "fixed", or what its limits leave it: "y -60..60, z at 20". Degrees.
std::string turns_of(const Joint& joint) {
  std::string text;
  bool all_round = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Limits& limits = joint.limits[axis];
    all_round = all_round && limits.lower == -180 && limits.upper == 180;
    if (!limits.free() && limits.lower == 0) continue;
    text += text.empty() ? "" : ", ";
    text += "xyz"[axis];
    text += limits.free() ? " " + document::shown(limits.lower) + ".." + document::shown(limits.upper)
                          : " at " + document::shown(limits.lower);
  }
  return all_round ? "free" : text.empty() ? "fixed" : text;
}

std::string axes_of(const Joint& joint) {
  if (skew_of(joint) != 0) return document::formatted("skewed, %.4g degrees", skew_of(joint));
  const bool own = joint.x_axis != Joint().x_axis || joint.y_axis != Joint().y_axis;
  return own ? "its own" : "-";
}

// Which limb each joint is: "left.knee", "-" if none.
std::vector<std::string> limbs_of(const Model& model) {
  std::vector<std::string> limbs(model.joints.size(), "-");
  const auto name = [&](std::size_t joint, const std::string& limb) {
    if (joint != kNone) limbs[joint] = limb;
  };
  for (std::size_t part = 0; part < std::size(kTrunkNames); ++part)
    name(model.limbs.trunk[part], std::string(kTrunkNames[part]));
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t limb = 0; limb < std::size(kLimbNames); ++limb)
      name(model.limbs.sides[side][limb], (side == 0 ? "left." : "right.") + std::string(kLimbNames[limb]));
  return limbs;
}

Row row_of(const Model& model, const Joint& joint, std::size_t depth, const std::string& limb) {
  Row row{std::string(2 * depth, ' ') + joint.name, turns_of(joint), axes_of(joint), limb, "-", "-", "-", "-"};
  if (!joint.segment) return row;
  const Shape& shape = model.shapes[joint.segment->shape];
  row[4] = shape.name;
  row[5] = shape.mesh ? std::to_string(shape.mesh->ends.size()) + " faces" : std::to_string(shape.patches.size());
  if (!joint.segment->bones.empty()) row[5] += ", " + document::counted(joint.segment->bones.size(), "bone", "bones");
  row[6] = size_text(joint.segment->sbb.max - joint.segment->sbb.min);
  if (!joint.segment->material.empty()) row[7] = joint.segment->material;
  return row;
}

// Joints as a person thinks of them: each followed by all that hangs on it.
class Tree {
 public:
  explicit Tree(const Model& model) : model_(model), children_(model.joints.size()) {
    for (std::size_t number = 0; number < model.joints.size(); ++number)
      if (const std::size_t parent = model.joints[number].parent; parent != kNone) children_[parent].push_back(number);
  }

  std::vector<Row> rows() const {
    std::vector<Row> rows{{"joint", "turns", "axes", "limb", "shape", "patches", "sbb", "material"}};
    const std::vector<std::string> limbs = limbs_of(model_);
    std::vector<std::pair<std::size_t, std::size_t>> waiting;  // joints and their depths, the next one last
    for (std::size_t number = model_.joints.size(); number-- > 0;)
      if (model_.joints[number].parent == kNone) waiting.emplace_back(number, 0);
    while (!waiting.empty()) {
      const auto [number, depth] = waiting.back();
      waiting.pop_back();
      rows.push_back(row_of(model_, model_.joints[number], depth, limbs[number]));
      for (auto child = children_[number].rbegin(); child != children_[number].rend(); ++child)
        waiting.emplace_back(*child, depth + 1);
    }
    if (std::ranges::all_of(limbs, [](const std::string& limb) { return limb == "-"; }))
      for (Row& row : rows) row.erase(row.begin() + kLimbColumn);
    return rows;
  }

 private:
  static constexpr int kLimbColumn = 3;

  const Model& model_;
  std::vector<std::vector<std::size_t>> children_;
};

std::string laid_out(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string head_of(const Model& model) {
  std::size_t freedoms = 0, segments = 0, patches = 0, stored = 0, faces = 0, stored_faces = 0;
  for (const Joint& joint : model.joints) {
    freedoms += static_cast<std::size_t>(joint.freedoms());
    if (!joint.segment) continue;
    ++segments;
    const Shape& shape = model.shapes[joint.segment->shape];
    patches += shape.patches.size();
    faces += shape.mesh ? shape.mesh->ends.size() : 0;
  }
  for (const Shape& shape : model.shapes) {
    stored += shape.patches.size();
    stored_faces += shape.mesh ? shape.mesh->ends.size() : 0;
  }
  std::string text = "joints    " + document::formatted("%zu with %zu freedoms\n", model.joints.size(), freedoms);
  text += "segments  " + document::formatted("%zu of %zu shapes\n", segments, model.shapes.size());
  text += "patches   " + document::formatted("%zu, %zu of them stored\n", patches, stored);
  if (stored_faces > 0) text += "faces     " + document::formatted("%zu, %zu of them stored\n", faces, stored_faces);
  if (const auto bounds = rest_bounds(model))
    text += "at rest   " + size_text(bounds->max - bounds->min) +
            document::formatted(", z from %.4g to %.4g\n", without_rounding(bounds->min.z),
                                without_rounding(bounds->max.z));
  return text;
}

struct MaterialColumn {
  std::string head;
  std::function<std::string(const wire::Material&)> cell;  // "": the material does not use it
  bool always;                                             // else only where some material has not the default
};

std::vector<MaterialColumn> material_columns() {
  const auto number = [](double value) { return document::formatted("%.4g", value); };
  std::vector<MaterialColumn> columns{
      {"color",
       [=](const wire::Material& m) {
         return number(m.color[0]) + " " + number(m.color[1]) + " " + number(m.color[2]);
       },
       true},
      {"reflection", [](const wire::Material& m) { return std::string(word_of(m.reflection)); }, false}};
  for (const MaterialNumber& each : kMaterialNumbers)
    columns.push_back({std::string(each.key.name),
                       [&each, number](const wire::Material& m) {
                         return uses(m.reflection, each) ? number(m.*each.member) : std::string();
                       },
                       true});
  columns.push_back(
      {"interpolation", [](const wire::Material& m) { return std::string(word_of(m.interpolation)); }, false});
  columns.push_back({"sides", [](const wire::Material& m) { return std::to_string(m.sides); }, true});
  for (const MaterialFlag& each : kMaterialFlags)
    columns.push_back({std::string(each.key.name),
                       [&each](const wire::Material& m) { return std::string(m.*each.member ? "true" : "false"); },
                       false});
  return columns;
}

bool tells(const MaterialColumn& column, const Model& model) {
  const std::string usual = column.always ? "" : column.cell(default_material());
  return std::ranges::any_of(model.materials, [&](const NamedMaterial& m) { return column.cell(m.material) != usual; });
}

std::string materials_of(const Model& model) {
  if (model.materials.empty()) return "";
  std::vector<Row> rows{{"material"}};
  for (const NamedMaterial& each : model.materials) rows.push_back({each.name});
  for (const MaterialColumn& column : material_columns()) {
    if (!tells(column, model)) continue;
    rows[0].push_back(column.head);
    for (std::size_t i = 0; i < model.materials.size(); ++i)
      rows[i + 1].push_back(column.cell(model.materials[i].material));
  }
  return "\n" + laid_out(rows);
}

}  // namespace

double skew_of(const Joint& joint) {
  const double angle =
      elementary::acos(std::clamp(glm::dot(joint.x_axis, joint.y_axis), -1.0, 1.0)) * 180 / std::numbers::pi;
  return std::abs(angle - 90) < kSquare ? 0 : angle;
}

std::string describe_model(const Model& model) {
  return head_of(model) + "\n" + laid_out(Tree(model).rows()) + materials_of(model);
}

}  // namespace mars::modeler
