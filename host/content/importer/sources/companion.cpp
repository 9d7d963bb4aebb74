#include "host/content/importer/sources/companion.h"

#include <system_error>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"

namespace mars::importer {

namespace {

namespace fs = std::filesystem;

// False where no file can have the name, as one that is too long.
bool leads_out(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  if (error) return false;
  const fs::path real_folder = fs::weakly_canonical(folder, error);
  if (error)
    throw Failure("cannot be found: " + error.message(), folder.string(), "check its name and its permissions");
  return !stays_inside(real.lexically_relative(real_folder));
}

}  // namespace

bool stays_inside(const std::filesystem::path& name) {
  const std::filesystem::path way = name.lexically_normal();
  return !way.empty() && way.is_relative() && *way.begin() != "..";
}

std::filesystem::path companion(const std::filesystem::path& file, const std::string& name) {
  const std::string named = "names " + document::in_quotes(document::printable(name, 100));
  if (!stays_inside(name))
    throw Failure(named + ", which is outside of its folder", file.string(),
                  "put that file beside it, and let it name the file without .. and without a leading /");
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".", path = folder / name;
  if (leads_out(path, folder))
    throw Failure(named + ", a link that leads out of its folder", file.string(),
                  "put the file itself in place of the link");
  return file.parent_path() / name;
}

}  // namespace mars::importer
