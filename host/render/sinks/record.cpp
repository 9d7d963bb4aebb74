#include "host/render/sinks/record.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "node/wire/film_parts.h"

namespace mars::sinks {

using nlohmann::json;

namespace {

constexpr std::size_t kChecksumDigits = 32;
constexpr std::uintmax_t kMostBytesOfAFrame = 64;  // its hash in quotes, indented, and a stretch of its own
static_assert(kLargestRecord >= wire::kMostFrames * kMostBytesOfAFrame);

std::string shortened(const std::string& text) {
  constexpr std::size_t kLongestShown = 40;
  return text.size() <= kLongestShown ? text : text.substr(0, kLongestShown) + "...";
}

// In ASCII, with whatever a terminal would obey escaped.
std::string shown(const json& value) {
  if (value.is_array()) return "a list";
  if (value.is_object()) return "an object";
  return shortened(value.dump(-1, ' ', true, json::error_handler_t::replace));
}

std::string shown_key(std::string_view key) { return shown(json(std::string(key))); }

}  // namespace

json parse_record(const std::string& text) try { return json::parse(text); } catch (const json::parse_error& error) {
  throw Failure("byte " + std::to_string(error.byte) + " is no JSON, or the end is missing", "", "");
} catch (const json::exception&) {
  throw Failure("it has a number beyond all that can be stored", "", "");
}

Record::Record(const json& object) : object_(object) {
  if (!object.is_object()) throw Failure(shown(object) + " is not an object", "", "");
}

void Record::refuse_keys_but(std::span<const std::string_view> known) const {
  for (const auto& item : object_.items())
    if (std::ranges::find(known, item.key()) == known.end())
      throw Failure("the key " + shown_key(item.key()) + " is unknown", "", "");
}

bool Record::has(std::string_view key) const { return object_.contains(key); }

const json& Record::value(std::string_view key) const {
  const auto found = object_.find(key);
  if (found == object_.end()) throw Failure("the key " + shown_key(key) + " is missing", "", "");
  return *found;
}

const json& Record::list(std::string_view key) const {
  const json& list = value(key);
  if (!list.is_array()) refuse_value(key, list, "a list");
  return list;
}

std::uint64_t Record::whole_number(std::string_view key, std::uint64_t lowest, std::uint64_t highest) const {
  const json& number = value(key);
  const bool whole = number.is_number_unsigned() || (number.is_number_integer() && number.get<std::int64_t>() >= 0);
  const bool fits = whole && number.get<std::uint64_t>() >= lowest && number.get<std::uint64_t>() <= highest;
  if (!fits)
    refuse_value(key, number, "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
  return number.get<std::uint64_t>();
}

double Record::positive_number(std::string_view key) const {
  const json& number = value(key);
  const bool fits = number.is_number() && std::isfinite(number.get<double>()) && number.get<double>() > 0;
  if (!fits) refuse_value(key, number, "a number above 0");
  return number.get<double>();
}

double Record::number(std::string_view key) const {
  const json& number = value(key);
  const bool fits = number.is_number() && std::isfinite(number.get<double>()) && number.get<double>() >= 0;
  if (!fits) refuse_value(key, number, "a number from 0");
  return number.get<double>();
}

std::string Record::text(std::string_view key, std::size_t longest) const {
  const json& text = value(key);
  if (!text.is_string() || text.get_ref<const std::string&>().size() > longest)
    refuse_value(key, text, "a text of at most " + std::to_string(longest) + " bytes");
  return text.get<std::string>();
}

std::string Record::checksum(std::string_view key) const {
  const json& sum = value(key);
  if (!is_checksum(sum)) refuse_value(key, sum, "32 hexadecimal digits");
  return sum.get<std::string>();
}

bool is_checksum(const json& value) {
  if (!value.is_string()) return false;
  const std::string& digits = value.get_ref<const std::string&>();
  return digits.size() == kChecksumDigits && digits.find_first_not_of("0123456789abcdef") == std::string::npos;
}

void refuse_value(std::string_view key, const json& value, const std::string& expected) {
  throw Failure(std::string(key) + ": " + shown(value) + " is not " + expected, "", "");
}

}  // namespace mars::sinks
