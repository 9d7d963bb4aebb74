#include "host/content/importer/companion.h"

#include "hal/failure/failure.h"
#include "host/content/document/text.h"

namespace mars::importer {

bool stays_inside(const std::filesystem::path& name) {
  const std::filesystem::path way = name.lexically_normal();
  return !way.empty() && way.is_relative() && *way.begin() != "..";
}

std::filesystem::path companion(const std::filesystem::path& file, const std::string& name) {
  if (!stays_inside(name))
    throw Failure("names " + document::in_quotes(document::printable(name, 100)) + ", which is outside of its folder",
                  file.string(),
                  "put that file beside it, and let it name the file without .. and without a leading /");
  return file.parent_path() / name;
}

}  // namespace mars::importer
