#include "host/content/modeler/edit_material.h"

#include <iterator>
#include <string>

#include "host/content/keys/material_keys.h"

namespace mars::modeler {
namespace {

void erase_unused(document::Json& material, wire::Reflection reflection) {
  for (const keys::MaterialNumber& number : keys::kMaterialNumbers)
    if (!keys::uses(reflection, number)) material.erase(std::string(number.key.name));
}

}  // namespace

void change_material(document::Json& material, const document::Json& values) {
  if (const auto reflection = values.find("reflection"); reflection != values.end())
    for (unsigned i = 0; i < std::size(keys::kReflections); ++i)
      if (*reflection == keys::kReflections[i]) erase_unused(material, static_cast<wire::Reflection>(i));
  material.update(values);
}

}  // namespace mars::modeler
