// Materials of a film file: those of a model file (host/content/modeler/material.h), with keys.
#pragma once

#include <string>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/document/fields.h"

namespace mars::animator {

std::vector<MaterialMotion> read_materials(const document::Element& materials);

// The material that never changes.
MaterialMotion still_material(const std::string& name, const wire::Material& material);

}  // namespace mars::animator
