// How large a person wants a model.
#pragma once

#include <optional>
#include <string>

namespace mars::importer {

struct ModelSize {
  double scale = 1;              // above 0
  std::optional<double> height;  // units from the lowest point to the highest, above 0; given: it decides, not `scale`

  // From the file's units to the model's, where `height_of_file` is the height in the file's. Refuses to make a flat
  // model high, in a Failure that names `file`.
  double factor(double height_of_file, const std::string& file) const;
};

}  // namespace mars::importer
