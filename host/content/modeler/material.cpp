#include "host/content/modeler/material.h"

#include <string>

namespace mars::modeler {
namespace {

// "phong, blinn-phong": the models that use it.
std::string users_of(const MaterialNumber& number) {
  std::string names;
  for (unsigned i = 0; i < std::size(kReflections); ++i)
    if (uses(static_cast<wire::Reflection>(i), number))
      names += (names.empty() ? "" : ", ") + std::string(kReflections[i]);
  return names;
}

// They are kept for the day when surfaces show them.
void check_images(const document::Fields& material) {
  const auto images = material.find("images");
  if (!images) return;
  const document::Fields fields(*images, keys::object("images"));
  for (const keys::Key& use : keys::object("images").keys)
    if (const auto file = fields.find(use.name)) document::read_file_name(*file);
}

}  // namespace

void refuse_unused(const document::Fields& fields, wire::Reflection reflection) {
  for (const MaterialNumber& number : kMaterialNumbers) {
    const auto element = fields.find(number.key.name);
    if (element && !uses(reflection, number))
      element->refuse("is not used by the reflection " + document::in_quotes(word_of(reflection)),
                      "leave it out, or choose a reflection that uses it: " + users_of(number));
  }
}

wire::Material read_shading(const document::Fields& fields) {
  wire::Material material{};
  material.reflection = static_cast<wire::Reflection>(fields.choice("reflection"));
  material.interpolation = static_cast<wire::Interpolation>(fields.choice("interpolation"));
  material.sides = document::read_count(fields.value("sides"), 1, 2);
  for (const MaterialFlag& flag : kMaterialFlags) material.*flag.member = fields.flag(flag.key.name);
  refuse_unused(fields, material.reflection);
  check_images(fields);
  return material;
}

wire::Material read_material(const document::Fields& fields) {
  wire::Material material = read_shading(fields);
  const glm::dvec3 color = fields.color("color");
  for (int i = 0; i < 3; ++i) material.color[i] = static_cast<float>(color[i]);
  for (const MaterialNumber& number : kMaterialNumbers)
    material.*number.member = static_cast<float>(fields.number(number.key.name));
  return material;
}

const wire::Material& default_material() {
  static const wire::Material material =
      read_material(document::Fields(document::Document("{}", "").root(), keys::object("material")));
  return material;
}

}  // namespace mars::modeler
