#include "host/studio/stage/page_message.h"

#include <algorithm>
#include <cmath>

#include "hal/failure/failure.h"

namespace mars::studio {
namespace {

constexpr double kMostPixels = 1e5;  // of a mouse's way

double number_of(const Json& number, const char* key, double lowest, double highest) {
  if (!number.is_number()) refuse("is no number", key, "give a number");
  const double value = number.get<double>();
  if (!(value >= lowest && value <= highest))
    refuse("is " + number.dump(), key, "between " + document::shown(lowest) + " and " + document::shown(highest));
  return value;
}

const Json& value_in(const Json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end()) refuse("is missing", key, "see docs/studio-protocol.md");
  return *found;
}

}  // namespace

void refuse(const std::string& what, const char* key, const std::string& remedy) {
  throw Failure(what, std::string("the message's '") + key + "'", remedy);
}

double number_in(const Json& message, const char* key, double lowest, double highest) {
  return number_of(value_in(message, key), key, lowest, highest);
}

glm::dvec2 pair_in(const Json& message, const char* key) {
  const Json& pair = value_in(message, key);
  if (!pair.is_array() || pair.size() != 2) refuse("is no list of two numbers", key, "give two numbers");
  return {number_of(pair[0], key, -kMostPixels, kMostPixels), number_of(pair[1], key, -kMostPixels, kMostPixels)};
}

glm::dvec2 pixel_in(const Json& message) {
  return {number_in(message, "x", -kMostPixels, kMostPixels), number_in(message, "y", -kMostPixels, kMostPixels)};
}

std::string word_in(const Json& message, const char* key) {
  const Json& word = value_in(message, key);
  if (!word.is_string()) refuse("is no text", key, "give a text");
  return word.get<std::string>();
}

std::vector<std::string> words_in(const Json& message, const char* key) {
  const Json list = message.value(key, Json::array());
  const auto is_text = [](const Json& word) { return word.is_string(); };
  if (!list.is_array() || !std::ranges::all_of(list, is_text)) refuse("is no list of texts", key, "give a list");
  return list.get<std::vector<std::string>>();
}

bool has_key(const Json& message, const char* modifier) {
  const auto found = message.find("keys");
  if (found == message.end() || !found->is_array()) return false;
  for (const Json& key : *found)
    if (key.is_string() && key.get<std::string>() == modifier) return true;
  return false;
}

}  // namespace mars::studio
