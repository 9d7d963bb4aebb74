#include "host/content/importer/model_text.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <utility>

namespace mars::importer {
namespace {

void append(std::string& text, auto number) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}

// "[1, 2, 3]"
void append_row(std::string& text, const auto* numbers, std::size_t count) {
  text += '[';
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ", ";
    append(text, numbers[i]);
  }
  text += ']';
}

// A list of rows, a line each.
void append_rows(std::string& text, std::size_t count, const auto& append_item) {
  text += '[';
  for (std::size_t i = 0; i < count; ++i) {
    text += i == 0 ? "\n        " : ",\n        ";
    append_item(i);
  }
  text += ']';
}

void append_places(std::string& text, const std::vector<modeler::Mesh::Place>& places) {
  append_rows(text, places.size(), [&](std::size_t i) { append_row(text, places[i].data(), 3); });
}

void append_bones(std::string& text, const std::vector<modeler::VertexBones>& bones) {
  text += ",\n      \"bones\": ";
  append_rows(text, bones.size(), [&](std::size_t vertex) {
    text += '[';
    for (std::size_t i = 0; i < modeler::kMostBonesOfVertex && bones[vertex].weight[i] > 0; ++i) {
      if (i > 0) text += ", ";
      append(text, bones[vertex].bone[i]);
      text += ", ";
      append(text, bones[vertex].weight[i]);
    }
    text += ']';
  });
}

// An alpha of 1 goes without saying.
void append_paint(std::string& text, const modeler::Mesh& mesh, const MeshPaint& paint) {
  if (!paint.uv.empty()) {
    text += ",\n      \"uv\": ";
    append_rows(text, paint.uv.size(), [&](std::size_t row) { append_row(text, paint.uv[row].data(), 2); });
  }
  if (!paint.colors.empty()) {
    text += ",\n      \"colors\": ";
    append_rows(text, paint.colors.size(), [&](std::size_t row) {
      append_row(text, paint.colors[row].data(), paint.colors[row][3] == 1 ? 3 : 4);
    });
  }
  if (paint.corners.empty()) return;
  text += ",\n      \"paint_faces\": ";
  append_rows(text, mesh.ends.size(), [&](std::size_t face) {
    append_row(text, paint.corners.data() + mesh.first_corner(face), mesh.face(face).size());
  });
}

// A triangle that follows the last bone.
std::string brief_text(const modeler::Mesh& mesh) {
  std::string text = "{\"mesh\": {\"vertices\": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], \"faces\": [[0, 1, 2]]";
  if (!mesh.bones.empty()) {
    const std::string bone = "[" + std::to_string(modeler::all_bones(mesh.bones).back()) + ", 1]";
    text += ", \"bones\": [" + bone + ", " + bone + ", " + bone + "]";
  }
  return text + "}}";
}

std::string json_text(const std::string& name) { return nlohmann::json(name).dump(); }

std::string numbered(const std::string& name, std::size_t number) {
  return number == 0 ? name : name + "-" + std::to_string(number + 1);
}

std::string row_text(const glm::dvec3& vector) {
  std::string text;
  append_row(text, &vector.x, 3);
  return text;
}

std::string material_text(const ImportedMaterial& material) {
  std::string text = "{\"color\": ";
  append_row(text, material.color.data(), 3);
  if (material.surface) {
    text += ", \"reflection\": \"metallic-roughness\", \"roughness\": ";
    append(text, material.surface->roughness);
    text += ", \"metallic\": ";
    append(text, material.surface->metallic);
  }
  if (!material.images.empty()) {
    nlohmann::ordered_json images = nlohmann::ordered_json::object();
    for (const MaterialImage& image : material.images) images[std::string(image.use)] = image.file;
    text += ", \"images\": " + images.dump();
  }
  return text + "}";
}

std::string limbs_text(const std::vector<NamedLimb>& limbs) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const NamedLimb& named : limbs) {
    const std::size_t dot = named.limb.find('.');
    if (dot == std::string::npos)
      json[named.limb] = named.joint;
    else
      json[named.limb.substr(0, dot)][named.limb.substr(dot + 1)] = named.joint;
  }
  return json.dump();
}

// The lists of a model's joints and shapes, as they grow.
class ModelText {
 public:
  void add(WrittenJoint joint) {
    joints_ += (joints_.empty() ? "\n    {" : ",\n    {") + ("\"name\": " + json_text(joint.name));
    if (!joint.parent.empty()) joints_ += ", \"parent\": " + json_text(joint.parent);
    const JointFrame &frame = joint.frame, usual;
    add_vector("place", frame.origin, usual.origin);
    add_vector("x_axis", frame.x_axis, usual.x_axis);
    add_vector("y_axis", frame.y_axis, usual.y_axis);
    if (joint.fixed) joints_ += ", \"limits\": {}";
    if (joint.limits) add_limits(*joint.limits);
    if (joint.segment) add_segment(std::move(*joint.segment));
    joints_ += "}";
  }

  // Once.
  document::LongText whole(const std::vector<ImportedMaterial>& materials, const std::vector<NamedLimb>& limbs) {
    std::string text = "{\n";
    for (std::size_t i = 0; i < materials.size(); ++i)
      text += (i == 0 ? "  \"materials\": {\n    " : ",\n    ") + json_text(material_name(i)) + ": " +
              material_text(materials[i]);
    if (!materials.empty()) text += "\n  },\n";
    if (!limbs.empty()) text += "  \"limbs\": " + limbs_text(limbs) + ",\n";
    document::LongText parts{{text + "  \"joints\": [" + joints_ + "\n  ],\n  \"shapes\": {"}};
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      parts.push_back({(i == 0 ? "\n    " : ",\n    ") + json_text(shape_name(i)) + ": "});
      parts.push_back(std::move(shapes_[i]));
    }
    parts.push_back({"\n  }\n}\n"});
    return parts;
  }

 private:
  void add_limits(const std::array<modeler::Limits, 3>& limits) {
    const std::size_t begin = joints_.size();
    for (std::size_t axis = 0; axis < limits.size(); ++axis) {
      if (!limits[axis].free()) continue;
      joints_ += joints_.size() == begin ? ", \"limits\": {\"" : ", \"";
      joints_ += "xyz"[axis];
      joints_ += "\": ";
      const double range[] = {limits[axis].lower, limits[axis].upper};
      append_row(joints_, range, 2);
    }
    joints_ += joints_.size() == begin ? ", \"limits\": {}" : "}";
  }

  void add_vector(const char* key, const glm::dvec3& vector, const glm::dvec3& usual) {
    if (vector != usual) joints_ += std::string(", \"") + key + "\": " + row_text(vector);
  }

  void add_segment(WrittenSegment segment) {
    joints_ += ", \"segment\": {\"shape\": " + json_text(shape_name(number_of(std::move(segment.shape)))) +
               ", \"sbb\": [" + row_text(segment.sbb.min) + ", " + row_text(segment.sbb.max) + "]";
    if (segment.material) joints_ += ", \"material\": " + json_text(material_name(*segment.material));
    if (segment.skin) add_skin(*segment.skin);
    joints_ += "}";
  }

  void add_skin(const WrittenSkin& skin) {
    joints_ += ",\n      \"skin\": {\"joints\": [";
    for (std::size_t i = 0; i < skin.joints.size(); ++i) joints_ += (i == 0 ? "" : ", ") + json_text(skin.joints[i]);
    joints_ += "]";
    if (!skin.binds.empty()) joints_ += ", \"bind\": ";
    if (!skin.binds.empty())
      append_rows(joints_, skin.binds.size(), [&](std::size_t i) { append_bind(skin.binds[i]); });
    joints_ += "}";
  }

  void append_bind(const modeler::Affine& bind) {
    double numbers[12];
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) numbers[4 * row + column] = bind.turn[column][row];
      numbers[4 * row + 3] = bind.place[row];
    }
    append_row(joints_, numbers, 12);
  }

  static std::string shape_name(std::size_t number) { return numbered("imported", number); }

  std::size_t number_of(document::TextPart shape) {
    if (const auto known = numbers_.find(shape.text); known != numbers_.end()) return known->second;
    shapes_.push_back(std::move(shape));
    return numbers_[shapes_.back().text] = shapes_.size() - 1;
  }

  std::string joints_;
  std::deque<document::TextPart> shapes_;
  std::map<std::string_view, std::size_t> numbers_;  // by their texts
};

}  // namespace

std::string material_name(std::size_t number) { return numbered("color", number); }

document::TextPart shape_text(const std::vector<wire::Patch>& patches) {
  const auto text_of = [](std::span<const wire::Patch> some) {
    std::string text;
    append_rows(text, some.size(), [&](std::size_t number) {
      text += '[';
      for (std::size_t i = 0; i < 16; ++i) {
        if (i > 0) text += ", ";
        append_row(text, some[number].points[i].data(), 3);
      }
      text += ']';
    });
    return text;
  };
  return {text_of(patches), text_of(std::span(patches).first(std::min<std::size_t>(patches.size(), 1)))};
}

document::TextPart shape_text(const modeler::Mesh& mesh, const MeshPaint& paint) {
  std::string text = "{\"mesh\": {\n      \"vertices\": ";
  append_places(text, mesh.vertices);
  text += ",\n      \"faces\": ";
  append_rows(text, mesh.ends.size(),
              [&](std::size_t i) { append_row(text, mesh.face(i).data(), mesh.face(i).size()); });
  if (mesh.normals.empty()) {
    text += ",\n      \"crease\": ";
    append(text, mesh.crease);
  } else {
    text += ",\n      \"normals\": ";
    append_places(text, mesh.normals);
  }
  if (!mesh.bones.empty()) append_bones(text, mesh.bones);
  append_paint(text, mesh, paint);
  text += "}}";
  return {std::move(text), brief_text(mesh)};
}

document::LongText model_text(std::vector<WrittenJoint> joints, const std::vector<ImportedMaterial>& materials,
                              const std::vector<NamedLimb>& limbs) {
  ModelText text;
  for (WrittenJoint& joint : joints) text.add(std::move(joint));
  return text.whole(materials, limbs);
}

}  // namespace mars::importer
