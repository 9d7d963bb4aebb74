#include "host/content/document/text.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace mars::document {
namespace {

constexpr std::size_t kLongestShown = 80;  // bytes of a name in a message

}  // namespace

std::string shortened(std::string_view name) {
  if (name.size() <= kLongestShown) return std::string(name);
  std::size_t end = kLongestShown;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;  // within a character
  return std::string(name.substr(0, end)) + "...";
}

std::string in_quotes(std::string_view name) { return "'" + shortened(name) + "'"; }

std::string printable(std::string_view bytes, std::size_t longest) {
  std::string text(bytes.substr(0, longest));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

std::string in_utf8(const std::string& text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

std::string counted(std::uint64_t count, std::string_view one, std::string_view several) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : several);
}

std::string counted(std::uint64_t count, std::string_view one) { return counted(count, one, std::string(one) + "s"); }

std::string formatted(const char* format, ...) {
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  std::string text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, values)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(values);
  return text;
}

std::string shown(double number) { return formatted("%.9g", number); }

double rounded_to(double number, int digits) { return std::strtod(formatted("%.*g", digits, number).c_str(), nullptr); }

}  // namespace mars::document
