#include "host/import/import_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <vector>

#include "hal/failure.h"
#include "host/document/whole_file.h"
#include "host/import/apart.h"
#include "host/import/mesh_file.h"
#include "host/modeler/patch_file.h"

namespace mars::host {
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

void append_places(std::string& text, const std::vector<Mesh::Place>& places) {
  append_rows(text, places.size(), [&](std::size_t i) { append_row(text, places[i].data(), 3); });
}

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

std::string numbered(const std::string& name, std::size_t number) {
  return number == 0 ? name : name + "-" + std::to_string(number + 1);
}

// One joint of the model, with its shape and colour as JSON.
struct Part {
  std::string shape;
  std::string color;  // "": grey
};

std::string shape_of(const std::vector<node::Patch>& patches) {
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

std::string shape_of(const Mesh& mesh) {
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

std::string model_text(const std::vector<Part>& parts, const Box& bounds, const std::string& joint) {
  std::string materials, joints, shapes, sbb = "[";
  append_row(sbb, &bounds.min.x, 3);
  sbb += ", ";
  append_row(sbb, &bounds.max.x, 3);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string comma = i == 0 ? "\n    " : ",\n    ";
    const std::string shape = quoted(numbered("imported", i)), material = quoted(numbered("color", i));
    joints += comma + "{\"name\": " + quoted(numbered(joint, i));
    if (i > 0) joints += ", \"parent\": " + quoted(joint) + ", \"limits\": {}";
    joints += ", \"segment\": {\"shape\": " + shape + ", \"sbb\": " + sbb + "]";
    if (!parts[i].color.empty()) {
      joints += ", \"material\": " + material;
      materials += (materials.empty() ? "\n    " : ",\n    ") + material + ": {\"color\": " + parts[i].color + "}";
    }
    joints += "}}";
    shapes += comma + shape + ": " + parts[i].shape;
  }
  if (!materials.empty()) materials = "  \"materials\": {" + materials + "\n  },\n";
  return "{\n" + materials + "  \"joints\": [" + joints + "\n  ],\n  \"shapes\": {" + shapes + "\n  }\n}\n";
}

std::string import_patches(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& joint) {
  const PatchFile file = read_patch_file(from);
  write_whole_file(to, model_text({{shape_of(file.patches), ""}}, file.bounds, joint));
  return "model of one joint '" + joint + "', " + std::to_string(file.patches.size()) + " patches";
}

std::string import_mesh(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& joint) {
  const MeshFile file = read_mesh_file(from);
  std::vector<Part> parts;
  std::size_t vertices = 0, faces = 0;
  for (const MeshPart& part : file.parts) {
    parts.push_back({shape_of(part.mesh), ""});
    if (part.color) append_row(parts.back().color, part.color->data(), 3);
    vertices += part.mesh.vertices.size();
    faces += part.mesh.ends.size();
  }
  write_whole_file(to, model_text(parts, file.bounds, joint));
  const bool one = parts.size() == 1;
  return "model of " + (one ? "one joint" : std::to_string(parts.size()) + " joints, the first") + " '" + joint + "', " +
         std::to_string(vertices) + " vertices, " + std::to_string(faces) + " faces";
}

// Assimp does not come back from every damaged file.
std::string import_mesh_apart(const std::filesystem::path& from, const std::filesystem::path& to,
                              const std::string& joint) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(from, error);
  const std::chrono::seconds most(5 + (error ? 0 : bytes >> 20));  // a sound file takes a fraction of that
  return run_apart([&] { return import_mesh(from, to, joint); }, most,
                   Failure("is no sound mesh file: reading it does not end well", from.string(),
                           "export it again, or as another of OBJ, STL, PLY, glTF, GLB"));
}

}  // namespace

std::string import_model(const std::filesystem::path& from, const std::filesystem::path& to, std::string joint) {
  if (joint.empty()) joint = from.stem().string();
  constexpr std::size_t kMost = 90;  // of a name's 100 bytes: numbers may follow
  const bool plain = !joint.empty() && joint.size() <= kMost && joint.find('/') == std::string::npos &&
                     std::none_of(joint.begin(), joint.end(), [](unsigned char c) { return std::iscntrl(c); });
  if (!plain) throw Failure("cannot name a joint", joint, "choose a name of 1 to 90 bytes without '/' with --joint");
  check_can_write(to);
  refuse_same_file(from, to);
  const std::string told = is_mesh_file(from) ? import_mesh_apart(from, to, joint) : import_patches(from, to, joint);
  return to.string() + ": " + told;
}

}  // namespace mars::host
