#include "host/content/document/fields.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/forms.h"

namespace mars::document {
namespace {

constexpr double kLeastOf255 = 8;  // of a colour's brightest part

// Levenshtein's distance, two neighbours exchanged counting once, of names cut at 64 bytes.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  a = a.substr(0, 64);
  b = b.substr(0, 64);
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

std::string listed(std::span<const std::string_view> names) {
  const std::string list = joined(names);
  return list.size() > 300 ? list.substr(0, 300) + " ..." : list;
}

// "a material", "a key of an actor": what messages call an object, by its name in the schema.
std::string with_article(std::string_view name) {
  if (name.starts_with("film_")) name.remove_prefix(5);
  if (name.ends_with("_key")) return "a key of " + with_article(name.substr(0, name.size() - 4));
  const bool several = name.ends_with('s'), vowel = std::string_view("aeiou").find(name.front()) != name.npos;
  return (several ? "" : vowel ? "an " : "a ") + std::string(name);
}

std::string default_text(const keys::Key& key) { return key.number ? shown(*key.number) : std::string(key.json); }

// As a file would write it.
Element written_default(const keys::Key& key) {
  static const auto defaults = [] {
    std::map<const keys::Key*, Document> documents;
    for (const auto objects : {keys::film_objects(), keys::model_objects()})
      for (const keys::Object& object : objects)
        for (const keys::Key& each : object.keys)
          if (const std::string text = default_text(each); !text.empty()) documents.try_emplace(&each, text, "");
    return documents;
  }();
  const auto found = defaults.find(&key);
  check(found != defaults.end(), "a reader asks for a default that the table has");
  return found->second.root();
}

std::string form_or(const Element& element, const std::string& otherwise) {
  const std::string form = form_of(element);
  return form.empty() ? otherwise : form;
}

}  // namespace

std::optional<std::string> near_name(std::string_view wanted, std::span<const std::string_view> names) {
  std::size_t nearest = (wanted.size() + 2) / 3 + 1;
  std::optional<std::string> found;
  for (const std::string_view name : names) {
    const std::size_t longer = std::max(name.size(), wanted.size());
    if (longer - std::min(name.size(), wanted.size()) >= nearest) continue;
    const std::size_t distance = edit_distance(wanted, name);
    if (distance >= nearest || distance >= longer) continue;
    nearest = distance;
    found = name;
  }
  return found;
}

std::string did_you_mean(std::string_view wanted, std::span<const std::string_view> names,
                         const std::string& otherwise) {
  const auto name = near_name(wanted, names);
  return name ? "did you mean " + in_quotes(*name) + "?" : otherwise;
}

void require_kind(const Element& element, Kind kind) {
  if (element.kind() != kind)
    element.refuse(std::string("is ") + name_of(element.kind()) + ", not " + name_of(kind),
                   "write " + form_or(element, name_of(kind)));
}

void require_size(const Element& element, std::size_t size) {
  require_kind(element, Kind::list);
  if (element.size() != size)
    element.refuse("has " + std::to_string(element.size()) + " items",
                   "write " + form_or(element, std::to_string(size) + " of them"));
}

double read_number(const Element& element, Range range) {
  require_kind(element, Kind::number);
  const double number = element.number();
  if (!(number >= range.lowest && number <= range.highest))
    element.refuse("is " + shown(number), "write a number from " + shown(range.lowest) + " to " + shown(range.highest));
  return number;
}

double read_number(const Element& element, const keys::Key& key) { return read_number(element, key.range); }

std::uint32_t read_count(const Element& element, const keys::Key& key) {
  return read_count(element, static_cast<std::uint32_t>(key.range.lowest),
                    static_cast<std::uint32_t>(key.range.highest));
}

std::size_t read_choice(const Element& element, const keys::Key& key) { return read_choice(element, key.choices); }

std::uint32_t read_count(const Element& element, std::uint32_t lowest, std::uint32_t highest) {
  const double number = read_number(element, {double(lowest), double(highest)});
  if (number != std::floor(number)) element.refuse("is " + shown(number), "write a whole number");
  return static_cast<std::uint32_t>(number);
}

glm::dvec3 read_vector(const Element& element, Range range) {
  require_size(element, 3);
  glm::dvec3 vector;
  int axis = 0;
  for (const Element item : element) vector[axis++] = read_number(item, range);
  return vector;
}

glm::dvec3 read_color(const Element& element) {
  require_size(element, 3);
  glm::dvec3 color;
  int part = 0;
  for (const Element item : element) color[part++] = read_number(item, {-HUGE_VAL, HUGE_VAL});
  const auto ranges_over = [&](double most) {
    return std::min({color.x, color.y, color.z}) >= 0 && std::max({color.x, color.y, color.z}) <= most;
  };
  if (ranges_over(1)) return color;
  // Refuses the number that is wrong; of 0 to 255 nobody means as little as these.
  if (ranges_over(kLeastOf255) || !ranges_over(255)) return read_vector(element, {0, 1});
  const auto share = [](double part) { return shown(std::round(part / 255 * 1000) / 1000); };
  element.refuse("has " + shown(std::max({color.x, color.y, color.z})) + ", above 1, where colours go from 0 to 1",
                 "divide by 255: [" + share(color.x) + ", " + share(color.y) + ", " + share(color.z) + "]");
}

std::string read_text(const Element& element) {
  require_kind(element, Kind::text);
  if (element.text().empty()) element.refuse("is an empty text", "write a name");
  return std::string(element.text());
}

std::string file_trouble(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) return "";
  return file_exists(path) ? "which is not a regular file" : "which does not exist";
}

std::filesystem::path read_file_name(const Element& element, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / read_text(element);
  if (const std::string trouble = file_trouble(path); !trouble.empty())
    element.refuse("is " + in_quotes(path.string()) + ", " + trouble,
                   file_exists(path) ? "name a file on a disk"
                                     : "name a file as seen from the folder of the file that names it");
  return path;
}

std::filesystem::path read_file_name(const Element& element) {
  return read_file_name(element, std::filesystem::path(element.document().name()).parent_path());
}

std::size_t read_choice(const Element& element, std::span<const std::string_view> choices) {
  const std::string wanted = read_text(element);
  const auto at = std::find(choices.begin(), choices.end(), wanted);
  if (at == choices.end())
    element.refuse("is " + in_quotes(wanted), did_you_mean(wanted, choices, "choose one of: " + listed(choices)));
  return static_cast<std::size_t>(at - choices.begin());
}

Fields::Fields(const Element& object, const Keys& keys) : object_(object), keys_(keys) {
  if (object.kind() != Kind::object && form_of(object).empty())
    object.refuse(std::string("is ") + name_of(object.kind()) + ", not " + with_article(keys.of),
                  "write it as {\"" + std::string(keys.names[0]) + "\": ...}");
  require_kind(object, Kind::object);
  for (const Element child : object) {
    if (std::find(keys.names.begin(), keys.names.end(), child.key()) != keys.names.end()) continue;
    child.refuse((keys.of.ends_with("_key") ? "does not belong to " : "is no key of ") + with_article(keys.of),
                 did_you_mean(child.key(), keys.names, "its keys are: " + listed(keys.names)));
  }
}

const keys::Key& Fields::key(std::string_view name) const {
  check(keys_.object != nullptr, "only objects of film and model files have a table");
  return keys_.object->key(name);
}

Element Fields::value(std::string_view name) const {
  const auto found = find(name);
  return found ? *found : written_default(key(name));
}

double Fields::number(std::string_view name) const { return read_number(value(name), key(name)); }

std::uint32_t Fields::count(std::string_view name) const { return read_count(value(name), key(name)); }

std::size_t Fields::choice(std::string_view name) const { return read_choice(value(name), key(name)); }

bool Fields::flag(std::string_view name) const {
  const Element flag = value(name);
  require_kind(flag, Kind::boolean);
  return flag.boolean();
}

glm::dvec3 Fields::vector(std::string_view name, Range range) const { return read_vector(value(name), range); }

glm::dvec3 Fields::color(std::string_view name) const { return read_color(value(name)); }

Element Fields::required(std::string_view key) const {
  const auto found = find(key);
  if (!found) object_.refuse("has no " + in_quotes(key), with_article(keys_.of) + " needs it");
  return *found;
}

double Fields::number(std::string_view key, double otherwise, Range range) const {
  const auto found = find(key);
  return found ? read_number(*found, range) : otherwise;
}

std::uint32_t Fields::count(std::string_view key, std::uint32_t otherwise, std::uint32_t lowest,
                            std::uint32_t highest) const {
  const auto found = find(key);
  return found ? read_count(*found, lowest, highest) : otherwise;
}

std::string Fields::text(std::string_view key, const std::string& otherwise) const {
  const auto found = find(key);
  return found ? read_text(*found) : otherwise;
}

std::size_t Fields::choice(std::string_view key, std::size_t otherwise,
                           std::span<const std::string_view> choices) const {
  const auto found = find(key);
  return found ? read_choice(*found, choices) : otherwise;
}

}  // namespace mars::document
