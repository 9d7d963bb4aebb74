// Model files as commands and the studio change them: read and checked, changed as JSON (edit.h), and written only if
// they are a model then. A model may stand in no film yet, so materials it has not are taken to be the film's.
#pragma once

#include <filesystem>
#include <functional>

#include "host/content/document/json_file.h"
#include "host/content/modeler/model.h"

namespace mars::modeler {

// As read_model(). Refuses films with what to do.
Model read_own_model(const document::Element& element);
Model load_own_model(const std::filesystem::path& path);

// Writes a new model file. Refuses if there is one of this name.
void create_model(const std::filesystem::path& path, const document::Json& model);

// Changes a model file; where `change` fails or leaves no valid model, it stays as it was, and the Failure names it.
void change_model(const std::filesystem::path& path,
                  const std::function<void(document::Json& json, const Model& model)>& change);

}  // namespace mars::modeler
