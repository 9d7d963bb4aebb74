// The code of JSON's templates, which is compiled once, in json_code.cpp, instead of in every source that reads or
// writes JSON. It belongs to the headers that are read once (CMakeLists.txt): no source includes it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mars::json_code {

using TextInput = nlohmann::detail::iterator_input_adapter<std::string::const_iterator>;
using WordInput = nlohmann::detail::iterator_input_adapter<const char*>;

}  // namespace mars::json_code

// Declares (KIND `extern template`) or makes (KIND `template`) what most sources use of the type JSON. The whole class
// would take four times as long to compile: it has every binary form of JSON.
#define MARS_JSON_CODE_OF(KIND, JSON)                                                       \
  KIND class nlohmann::detail::serializer<JSON>;                                            \
  KIND class nlohmann::detail::json_sax_dom_parser<JSON>;                                   \
  KIND class nlohmann::detail::json_sax_dom_callback_parser<JSON>;                          \
  KIND class nlohmann::detail::lexer<JSON, mars::json_code::TextInput>;                     \
  KIND class nlohmann::detail::lexer<JSON, mars::json_code::WordInput>;                     \
  KIND void nlohmann::detail::parser<JSON, mars::json_code::TextInput>::parse(bool, JSON&); \
  KIND void nlohmann::detail::parser<JSON, mars::json_code::WordInput>::parse(bool, JSON&); \
  KIND void JSON::json_value::destroy(JSON::value_t);                                       \
  KIND JSON::basic_json(const JSON&);                                                       \
  KIND JSON::basic_json(JSON::initializer_list_t, bool, JSON::value_t);                     \
  KIND JSON::string_t JSON::dump(int, char, bool, JSON::error_handler_t) const;             \
  KIND class std::vector<JSON>

#define MARS_JSON_CODE(KIND)               \
  MARS_JSON_CODE_OF(KIND, nlohmann::json); \
  MARS_JSON_CODE_OF(KIND, nlohmann::ordered_json)

MARS_JSON_CODE(extern template);
