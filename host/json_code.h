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

// Declares (KIND `extern template`) or makes (KIND `template`) what reads and writes values of the type JSON.
#define MARS_JSON_CODE_OF(KIND, JSON)                                                       \
  KIND class nlohmann::detail::serializer<JSON>;                                            \
  KIND class nlohmann::detail::iter_impl<const JSON>;                                       \
  KIND class nlohmann::detail::json_sax_dom_parser<JSON>;                                   \
  KIND class nlohmann::detail::json_sax_dom_callback_parser<JSON>;                          \
  KIND class nlohmann::detail::lexer_base<JSON>;                                            \
  KIND class nlohmann::detail::lexer<JSON, mars::json_code::TextInput>;                     \
  KIND class nlohmann::detail::lexer<JSON, mars::json_code::WordInput>;                     \
  KIND class nlohmann::detail::parser<JSON, mars::json_code::TextInput>;                    \
  KIND class nlohmann::detail::parser<JSON, mars::json_code::WordInput>;                    \
  KIND bool nlohmann::detail::parser<JSON, mars::json_code::TextInput>::sax_parse_internal( \
      nlohmann::detail::json_sax_dom_parser<JSON>*);                                        \
  KIND bool nlohmann::detail::parser<JSON, mars::json_code::TextInput>::sax_parse_internal( \
      nlohmann::detail::json_sax_dom_callback_parser<JSON>*);                               \
  KIND class std::vector<JSON>

#define MARS_JSON_CODE(KIND)                              \
  KIND class nlohmann::basic_json<>;                      \
  KIND class nlohmann::basic_json<nlohmann::ordered_map>; \
  MARS_JSON_CODE_OF(KIND, nlohmann::json);                \
  MARS_JSON_CODE_OF(KIND, nlohmann::ordered_json)

MARS_JSON_CODE(extern template);
