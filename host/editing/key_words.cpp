#include "host/editing/key_words.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "hal/failure/failure.h"
#include "host/content/document/fields.h"
#include "host/content/document/text.h"
#include "host/content/keys/text.h"

namespace mars::editing {
namespace {

using document::Json;

std::string option_name(const keys::Key& key) {
  std::string name = "--" + std::string(key.name);
  std::ranges::replace(name, '_', '-');
  return name;
}

std::string upper(std::string_view word) {
  std::string text(word);
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

// How the key's value is typed: what help calls its words and, if they are numbers, a value with a place for each.
struct Typing {
  std::string words;
  std::optional<Json> numbers{};
};

Typing typing_of(const keys::Key& key) {
  if (key.type == "number" || key.type == "whole") return {"NUMBER", Json(0)};
  if (key.type == "choice") return {document::joined(key.choices, "|")};
  if (key.type == "flag") return {"true|false"};
  const keys::Type* const type = keys::find_type(key.type);
  if (type == nullptr || type->words.empty()) return {upper(key.name)};
  return {std::string(type->words), Json::parse(type->example)};
}

std::size_t places_in(const Json& value) {
  if (!value.is_array()) return 1;
  std::size_t places = 0;
  for (const Json& each : value) places += places_in(each);
  return places;
}

void fill(Json& value, std::span<const double>& numbers) {
  if (value.is_array()) {
    for (Json& each : value) fill(each, numbers);
    return;
  }
  value = document::plain_number(numbers.front());
  numbers = numbers.subspan(1);
}

// A word that is neither stays one, for readers to refuse.
Json flag_of(const std::string& word) { return word == "true" || word == "false" ? Json(word == "true") : Json(word); }

void add_key_option(cli::Command command, const keys::Key& key, Json& values) {
  const std::string option = option_name(key), help = keys::help_of(key, option + " "), name(key.name);
  const Typing typing = typing_of(key);
  if (!typing.numbers) {
    command
        .add_read(
            option,
            [&values, name, flag = key.type == "flag"](const std::string& word) {
              values[name] = flag ? flag_of(word) : Json(word);
            },
            help)
        .type(typing.words);
    return;
  }
  const auto read = [&values, name, places = *typing.numbers](const std::vector<double>& typed) {
    std::span<const double> numbers(typed);
    Json value = places;
    fill(value, numbers);
    values[name] = std::move(value);
  };
  command.add_read(option, read, help).words(static_cast<int>(places_in(*typing.numbers))).type(typing.words);
}

// "0.5" is a number, "1,0.8,0.6" a list, anything else a text.
Json value_of(const std::string& text) {
  Json list = Json::array();
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto number = document::number_in<double>(std::string_view(text).substr(at, comma - at));
    if (!number) return text;
    list.push_back(document::plain_number(*number));
    at = comma + 1;
  }
  return list.size() == 1 ? list[0] : list;
}

// "color=0.8,0.4,0.2", of the first key that has an example.
std::string example_of(const keys::Object& object) {
  for (const keys::Key& key : object.keys) {
    std::string words = key.typed ? keys::words_of_example(key) : "";
    std::ranges::replace(words, ' ', ',');
    if (!words.empty()) return std::string(key.name) + "=" + words;
  }
  return "KEY=VALUE";
}

// As a value of the key with numbers is written; null where none is.
Json form_of(const keys::Key& key) {
  if (key.type == "number" || key.type == "whole") return Json(1);
  const keys::Type* const type = keys::find_type(key.type);
  Json form = type == nullptr ? Json() : Json::parse(type->example, nullptr, false);
  return form.is_number() || (form.is_array() && !form.empty() && form[0].is_number()) ? form : Json();
}

// Whether the value cannot be one of the key's, whatever its numbers are. The file's reader would say so in JSON's
// words.
bool has_other_form(const Json& value, const Json& form, std::string_view schema) {
  const auto allows = [&](std::string_view part) { return schema.find(part) != schema.npos; };
  if (value.is_string()) return !allows(R"("enum": [")") && !allows("const");
  if (value.is_array() && form.is_array()) return value.size() != form.size();
  return value.is_array() != form.is_array() && !allows("anyOf");
}

// "size=960,540", with the key's own numbers where it has an example or a default.
std::string example_of(const keys::Key& key, const Json& form) {
  std::string words(key.example.empty() ? key.json : key.example);
  if (words.empty()) words = key.number ? document::shown(*key.number) : form.dump();
  std::erase_if(words, [](char c) { return c == '[' || c == ']' || c == ' '; });
  return std::string(key.name) + "=" + words;
}

// The value that `text`, of the word KEY=VALUE, stands for.
Json value_of(const keys::Key& key, std::string text, const std::string& word) {
  if (key.type == "flag") return flag_of(text);
  if (key.type == "text" || key.type == "file" || key.type == "choice") return text;
  if (key.type == "size") std::ranges::replace(text, 'x', ',');  // as --size takes it
  Json value = value_of(text);
  const Json form = form_of(key);
  const keys::Type* const type = keys::find_type(key.type);
  if (!form.is_null() && has_other_form(value, form, type == nullptr ? "" : type->schema))
    throw Failure("is no value of " + std::string(key.name), document::in_quotes(word),
                  "write it like " + example_of(key, form));
  return value;
}

}  // namespace

void add_key_options(cli::Command command, const keys::Object& object, Json& values) {
  for (const keys::Key& key : object.keys)
    if (key.typed) add_key_option(command, key, values);
}

cli::Option add_key_values(cli::Command command, const keys::Object& object, std::vector<std::string>& words,
                           const std::string& example) {
  return command
      .add("KEY=VALUE", words,
           keys::names_of(object) + "; `mars keys " + std::string(object.name) + "` explains them. Example: " + example)
      .offers(keys::typed_forms(object));
}

Json values_of(std::span<const std::string> words, const keys::Object& object) {
  const std::vector<std::string_view> names = object.typed_names();
  Json values = Json::object();
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
      throw Failure("is not KEY=VALUE", "'" + word + "'", "write it like " + example_of(object));
    const std::string key = word.substr(0, equals);
    if (std::ranges::find(names, std::string_view(key)) == names.end())
      throw Failure("is no key of a " + std::string(object.name), document::in_quotes(key),
                    document::did_you_mean(key, names, "choose " + document::joined(names)));
    if (values.contains(key)) throw Failure("is given twice", document::in_quotes(key), "give each key once");
    values[key] = value_of(object.key(key), word.substr(equals + 1), word);
  }
  return values;
}

void limit(cli::Option option, const keys::Key& key) { option.range(key.range.lowest, key.range.highest); }

}  // namespace mars::editing
