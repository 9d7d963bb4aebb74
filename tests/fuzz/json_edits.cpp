#include "tests/fuzz/json_edits.h"

#include <array>
#include <limits>
#include <set>
#include <string_view>

namespace mars::fuzz {
namespace {

using document::Json;

// At which readers of numbers go wrong, and those that hands and people give.
constexpr std::array<double, 20> kNumbers{0,   1,          -1,         2,   3,    0.5,  7,     -0.0,   1e-6,   1e-320,
                                          1e6, 4294967295, 4294967296, 1e9, -1e9, 1e18, 1e300, -1e300, 89.999, 180};
constexpr std::array<std::string_view, 16> kTexts{"",   "0",       "-1", "1e300", "nan", "..", "/", "-",
                                                  "--", "\x1b[2J", "*",  "=",     "{}",  "%%", "é", "9999999999"};
constexpr std::size_t kDeep = 14;
constexpr std::size_t kLong = 5000;

struct Place {
  Json* parent;  // null: the message itself
  std::size_t index;
};

// The values of the message, each by where it stands, in order.
void add_places(Json& value, std::vector<Place>& places) {
  if (!value.is_structured()) return;
  for (std::size_t i = 0; i < value.size(); ++i) {
    places.push_back({&value, i});
    add_places(*std::next(value.begin(), static_cast<std::ptrdiff_t>(i)), places);
  }
}

void add_words(const Json& value, std::set<std::string>& words) {
  if (value.is_string()) words.insert(value.get<std::string>());
  if (value.is_object())
    for (const auto& [key, each] : value.items()) words.insert(key);
  if (value.is_structured())
    for (const Json& each : value) add_words(each, words);
}

Json& at(const Place& place) { return *std::next(place.parent->begin(), static_cast<std::ptrdiff_t>(place.index)); }

void erase(const Place& place) {
  place.parent->erase(std::next(place.parent->begin(), static_cast<std::ptrdiff_t>(place.index)));
}

Json odd_value(Script& script) {
  switch (script.below(9)) {
    case 0: return nullptr;
    case 1: return true;
    case 2: return Json::object();
    case 3: return Json::array();
    case 4: return std::numeric_limits<std::uint64_t>::max();
    case 5: return std::numeric_limits<std::int64_t>::min();
    case 6: return std::string(kLong, 'x');
    case 7: {
      Json deep = 1;
      for (std::size_t i = 0; i < kDeep; ++i) deep = Json::array({std::move(deep)});
      return deep;
    }
    default: return std::string(kTexts[script.below(kTexts.size())]);
  }
}

double other_number(double number, Script& script) {
  switch (script.below(4)) {
    case 0: return number + static_cast<std::int8_t>(script.byte());
    case 1: return number * (static_cast<std::int8_t>(script.byte()) / 16.0);
    default: return kNumbers[script.below(kNumbers.size())];
  }
}

}  // namespace

JsonEdits::JsonEdits(const std::vector<Json>& sound) {
  std::set<std::string> words;
  for (const Json& each : sound) add_words(each, words);
  words_.assign(words.begin(), words.end());
}

// A word of those that are known, or its own with a part of it changed: "place=1,2,3".
std::string JsonEdits::other_text(const std::string& text, Script& script) const {
  const std::size_t from = script.below(text.size() + 1), length = script.below(4);
  switch (script.below(6)) {
    case 0: return std::string(text).replace(from, length, kTexts[script.below(kTexts.size())]);
    case 1: return std::string(text).replace(from, length, word(script));
    case 2: return std::string(text).erase(from, length);
    case 3: return text + word(script);
    default: return word(script);
  }
}

Json JsonEdits::other_value(const Json& value, Script& script) const {
  if (value.is_number() && script.below(8) > 0) return other_number(value.get<double>(), script);
  if (value.is_string() && script.below(8) > 0) return other_text(value.get<std::string>(), script);
  if (value.is_boolean()) return !value.get<bool>();
  return odd_value(script);
}

void JsonEdits::edit(Json& message, Script& script) const {
  std::vector<Place> places;
  add_places(message, places);
  if (places.empty()) return;
  const Place place = places[script.below(places.size())];
  switch (script.below(10)) {
    case 0: erase(place); break;
    case 1: at(place) = odd_value(script); break;
    case 2: at(place) = Json(at(places[script.below(places.size())])); break;
    case 3:
      if (place.parent->is_array())
        place.parent->insert(place.parent->begin() + static_cast<std::ptrdiff_t>(place.index), word(script));
      else
        (*place.parent)[word(script)] = word(script);
      break;
    case 4:
      if (place.parent->is_array()) place.parent->push_back(Json(at(place)));
      break;
    default: at(place) = other_value(at(place), script);
  }
}

std::string text_of(const Json& message) { return message.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace mars::fuzz
