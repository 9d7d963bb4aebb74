#include "host/editing/new_files.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/content/document/file.h"
#include "host/content/keys/named_files.h"

namespace mars::editing {

void require_new_files_below(const std::filesystem::path& folder, const std::filesystem::path& file,
                             const keys::Object& object, const nlohmann::ordered_json& was,
                             const nlohmann::ordered_json& now) {
  if (folder.empty()) return;
  const std::vector<std::string> known = keys::files_named_in(was, object);
  for (const std::string& name : keys::files_named_in(now, object))
    if (std::ranges::find(known, name) == known.end())
      document::path_below(folder, (std::filesystem::absolute(file).parent_path() / name).string());
}

}  // namespace mars::editing
