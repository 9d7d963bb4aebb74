#include "host/content/importer/model_text.h"

#include <charconv>
#include <nlohmann/json.hpp>

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

std::string json_text(const std::string& name) { return nlohmann::json(name).dump(); }

std::string numbered(const std::string& name, std::size_t number) {
  return number == 0 ? name : name + "-" + std::to_string(number + 1);
}

}  // namespace

std::string material_name(std::size_t part) { return numbered("color", part); }

std::string shape_text(const std::vector<wire::Patch>& patches) {
  std::string text;
  append_rows(text, patches.size(), [&](std::size_t number) {
    text += '[';
    for (std::size_t i = 0; i < 16; ++i) {
      if (i > 0) text += ", ";
      append_row(text, patches[number].points[i].data(), 3);
    }
    text += ']';
  });
  return text;
}

std::string shape_text(const modeler::Mesh& mesh) {
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
  return text + "}}";
}

std::string model_text(const std::vector<ImportedPart>& parts, const modeler::Box& bounds, const std::string& joint) {
  std::string materials, joints, shapes, sbb = "[";
  append_row(sbb, &bounds.min.x, 3);
  sbb += ", ";
  append_row(sbb, &bounds.max.x, 3);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string comma = i == 0 ? "\n    " : ",\n    ";
    const std::string shape = json_text(numbered("imported", i)), material = json_text(material_name(i));
    joints += comma + "{\"name\": " + json_text(numbered(joint, i));
    if (i > 0) joints += ", \"parent\": " + json_text(joint) + ", \"limits\": {}";
    joints += ", \"segment\": {\"shape\": " + shape + ", \"sbb\": " + sbb + "]";
    if (parts[i].color) {
      joints += ", \"material\": " + material;
      materials += (materials.empty() ? "\n    " : ",\n    ") + material + ": {\"color\": ";
      append_row(materials, parts[i].color->data(), 3);
      materials += "}";
    }
    joints += "}}";
    shapes += comma + shape + ": " + parts[i].shape;
  }
  if (!materials.empty()) materials = "  \"materials\": {" + materials + "\n  },\n";
  return "{\n" + materials + "  \"joints\": [" + joints + "\n  ],\n  \"shapes\": {" + shapes + "\n  }\n}\n";
}

}  // namespace mars::importer
