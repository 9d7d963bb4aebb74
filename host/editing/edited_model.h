// The model that words change or read.
#pragma once

#include <functional>

#include "host/content/modeler/model.h"
#include "host/editing/edited.h"

namespace mars::editing {

class EditedModel : public Edited {
 public:
  using Change = std::function<void(document::Json& json, const modeler::Model& model)>;

  virtual modeler::Model read() const = 0;
  // It stays as it was where `change` throws or the result is no model.
  virtual void change(const Change& change) = 0;
};

}  // namespace mars::editing
