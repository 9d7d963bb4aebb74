#include "host/studio/project/scripts.h"

#include <map>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLongestScript = 48 * 1024;  // bytes
constexpr std::size_t kMost = 100;

}  // namespace

Scripts::Scripts(const fs::path& film, fs::path folder)
    : beside_(fs::absolute(film).parent_path()), folder_(std::move(folder)) {}

void Scripts::write(const ScriptStep& script) const {
  document::write_whole_file(document::path_below(folder_, (beside_ / script.name).string()), script.text);
}

Json Scripts::list() const {
  std::map<std::string, std::string> texts;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(beside_, ignored)) try {
      const std::string name = checked_script_name(entry.path().filename().string());
      const fs::path path = document::path_below(folder_, entry.path().string());
      if (texts.size() < kMost) texts[name] = document::read_file(path, kLongestScript);
    } catch (const Failure&) {
      continue;  // no script, or none for pages
    }
  Json scripts = Json::array();
  for (const auto& [name, text] : texts) scripts.push_back({{"name", name}, {"text", text}});
  return {{"is", "scripts"}, {"scripts", std::move(scripts)}};
}

}  // namespace mars::studio
