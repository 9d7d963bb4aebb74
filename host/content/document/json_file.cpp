#include "host/content/document/json_file.h"

#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdint>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/folder_lock.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"

namespace mars::document {
namespace {

constexpr std::size_t kColumns = 110;
constexpr std::size_t kIndent = 2;

// On one line, or "" if that takes more than `columns` columns.
std::string on_one_line(const Json& json, std::size_t columns) {
  if (!json.is_structured()) return json.dump();
  std::string line(1, json.is_array() ? '[' : '{');
  for (auto item = json.begin(); item != json.end(); ++item) {
    if (item != json.begin()) line += ", ";
    if (json.is_object()) line += Json(item.key()).dump() + ": ";
    const std::string value = line.size() < columns ? on_one_line(*item, columns - line.size()) : "";
    if (value.empty()) return "";
    line += value;
  }
  line += json.is_array() ? ']' : '}';
  return line.size() <= columns ? line : "";
}

// `before`: columns that stand before the value on its first line.
void lay_out(const Json& json, std::size_t indent, std::size_t before, std::string& text) {
  const std::size_t columns = before < kColumns ? kColumns - before : 0;
  if (const std::string line = on_one_line(json, columns); !line.empty() || !json.is_structured()) {
    text.append(line);
    return;
  }
  text += json.is_array() ? "[" : "{";
  const std::string margin(indent + kIndent, ' ');
  for (auto item = json.begin(); item != json.end(); ++item) {
    text += item == json.begin() ? "\n" : ",\n";
    text += margin;
    const std::string key = json.is_object() ? Json(item.key()).dump().append(": ") : "";
    text += key;
    lay_out(*item, indent + kIndent, margin.size() + key.size() + 1, text);
  }
  text.append(1, '\n').append(indent, ' ').append(1, json.is_array() ? ']' : '}');
}

}  // namespace

Json read_json(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  const Document checked(text, path.string());
  return Json::parse(text);
}

Json plain_number(double number) {
  const double rounded = rounded_to(number, 10);
  if (rounded == std::floor(rounded) && std::abs(rounded) < 1e15) return static_cast<std::int64_t>(rounded);
  return rounded;
}

bool flag_in(const Json& object, const std::string& key, bool otherwise) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return otherwise;
  if (!found->is_boolean()) throw Failure("is neither true nor false", in_quotes(key), "give one of them");
  return found->get<bool>();
}

std::string laid_out(const Json& json) try {
  std::string text;
  lay_out(json, 0, 0, text);
  return text + "\n";
} catch (const Json::type_error&) {
  throw Failure("a name that was given is not UTF-8", "", "type it in a terminal that writes UTF-8");
}

void write_json(const std::filesystem::path& path, const Json& json, const std::function<void(const Element&)>& check) {
  const std::string text = laid_out(json);
  const Document document(text, path.string());
  check(document.root());
  write_whole_file(path, text);
}

void change_json(const std::filesystem::path& path, const std::function<void(Json&)>& change,
                 const std::function<void(const Element&)>& check) {
  const FolderLock lock(path);
  Json json = read_json(path);
  if (access(path.c_str(), W_OK) != 0) fail_file("write", path, errno);
  change(json);
  write_json(path, json, check);
}

}  // namespace mars::document
