#include "host/content/animator/reading/read_materials.h"

#include "host/content/animator/reading/read_keys.h"
#include "host/content/modeler/read_model.h"

namespace mars::animator {
namespace {

using modeler::kMaterialNumbers;

MaterialMotion read_material(const document::Element& element) {
  const document::Fields fields(element, keys::object("film_material"));
  MaterialMotion material;
  material.name = modeler::checked_name(element, element.key());
  material.shading = modeler::read_shading(fields);
  if (const auto keys = fields.find("keys"))
    read_keys(*keys, keys::object("material_key"),
              [&](const document::Fields& key, std::uint32_t frame, const Ease& ease) {
                modeler::refuse_unused(key, material.shading.reflection);
                add_key(material.color, key, "color", frame, ease, document::read_color);
                for (std::size_t i = 0; i < kMaterialNumbers.size(); ++i) {
                  const std::string_view name = kMaterialNumbers[i].key.name;
                  add_key(material.numbers[i], key, name, frame, ease, number_of(key, name));
                }
              });
  settle(material.color, fields, "color", document::read_color);
  for (std::size_t i = 0; i < kMaterialNumbers.size(); ++i) {
    const std::string_view name = kMaterialNumbers[i].key.name;
    settle(material.numbers[i], fields, name, number_of(fields, name));
  }
  return material;
}

}  // namespace

std::vector<MaterialMotion> read_materials(const document::Element& materials) {
  document::require_kind(materials, document::Kind::object);
  std::vector<MaterialMotion> read;
  for (const document::Element material : materials) read.push_back(read_material(material));
  return read;
}

MaterialMotion still_material(const std::string& name, const wire::Material& material) {
  MaterialMotion still;
  still.name = name;
  still.shading = material;
  still.color = constant(glm::dvec3(material.color[0], material.color[1], material.color[2]));
  for (std::size_t i = 0; i < kMaterialNumbers.size(); ++i)
    still.numbers[i] = constant(double{material.*kMaterialNumbers[i].member});
  return still;
}

}  // namespace mars::animator
