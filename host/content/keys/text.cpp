#include "host/content/keys/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

namespace mars::keys {
namespace {

std::string shown(double number) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.7g", number);
  return text.data();
}

std::string joined(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

// Without the marks of code.
std::string plain(std::string_view markdown) {
  std::string text(markdown);
  std::erase(text, '`');
  return text;
}

bool is_json(const Key& key) { return key.without.empty() && (key.number || !key.json.empty()); }

std::string code(const std::string& text) { return "`" + text + "`"; }

// "[below](#fog)", "[shapes.md](shapes.md#the-library-of-shapes)".
std::string link_to(std::string_view heading) {
  const std::string page(heading.substr(0, heading.find('#')));
  return "[" + (page.empty() ? "below" : page) + "](" + std::string(heading) + ")";
}

std::string markdown_row(const Key& key, bool keyed) {
  std::string row = "| " + code(std::string(key.name)) + " | " + std::string(key.meaning);
  if (!key.unit.empty() && range_of(key).empty()) row += ", in " + std::string(key.unit);
  if (const std::string range = range_of(key); !range.empty()) row += " (" + range + ")";
  if (!key.see.empty()) row += ", see " + link_to(key.see);
  row += " | " + (is_json(key) ? code(default_of(key)) : default_of(key)) + " |";
  if (keyed) row += key.keyed ? " yes |" : " |";
  return row + "\n";
}

}  // namespace

std::string range_of(const Key& key) {
  if (key.type == "choice") {
    std::string text;
    for (const std::string_view each : key.choices)
      text += (text.empty() ? "" : ", ") + code("\"" + std::string(each) + "\"");
    return key.meaning.find('`') == std::string_view::npos ? text : "";
  }
  if (key.type.front() == '[' && key.range.highest < kFarthest) return "at most " + shown(key.range.highest);
  const bool number = key.type == "number" || key.type == "whole";
  const bool bounded = key.range != Range{} && key.range.highest < kFarthest;
  std::string text = number && bounded ? shown(key.range.lowest) + " to " + shown(key.range.highest) : "";
  if (!text.empty() && !key.unit.empty()) text += " " + std::string(key.unit);
  return text;
}

std::string default_of(const Key& key) {
  if (key.required) return "required";
  if (!key.without.empty()) return std::string(key.without);
  if (!key.json.empty()) return std::string(key.json);
  return key.number ? shown(*key.number) : "";
}

std::string words_of_example(const Key& key) {
  std::string words = key.example.empty() ? default_of(key) : std::string(key.example);
  std::erase_if(words, [](char c) { return std::string_view("[],\"").find(c) != std::string_view::npos; });
  return words;
}

std::string help_of(const Key& key, std::string_view before) {
  std::string text = plain(key.meaning);
  if (std::islower(static_cast<unsigned char>(text.front())))
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (const std::string range = plain(range_of(key)); !range.empty()) text += " (" + range + ")";
  return text + ". Example: " + std::string(before) + words_of_example(key);
}

std::string names_of(const Object& object) {
  const std::vector<std::string_view> names = object.typed_names();
  return joined(std::span(names).first(names.size() - 1)) + " or " + std::string(names.back());
}

std::vector<std::string> typed_forms(const Object& object) {
  std::vector<std::string> forms;
  for (const Key& key : object.keys) {
    if (!key.typed) continue;
    const std::string begun = std::string(key.name) + "=";
    if (key.type == "flag")
      forms.insert(forms.end(), {begun + "true", begun + "false"});
    else if (key.choices.empty())
      forms.push_back(begun);
    for (const std::string_view choice : key.choices) forms.push_back(begun + std::string(choice));
  }
  return forms;
}

std::string table_of(const Object& object) {
  std::string text;
  for (const Key& key : object.keys) {
    text += "  " + std::string(key.name) + std::string(15 - std::min<std::size_t>(14, key.name.size()), ' ') +
            plain(key.meaning);
    if (const std::string range = plain(range_of(key)); !range.empty()) text += " (" + range + ")";
    if (const std::string otherwise = plain(default_of(key)); !otherwise.empty())
      text += key.required ? " (required)" : "; default: " + otherwise;
    text += "\n";
  }
  return text;
}

std::string markdown_of(const Object& object) {
  const bool keyed = std::ranges::any_of(object.keys, &Key::keyed);
  std::string text = std::string("| key | meaning | default |") + (keyed ? " in keys |" : "") + "\n|---|---|---|" +
                     (keyed ? "---|" : "") + "\n";
  for (const Key& key : object.keys) text += markdown_row(key, keyed);
  return text;
}

}  // namespace mars::keys
