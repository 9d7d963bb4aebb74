// What a person may give an action, as command line, scripts and help have it.
#pragma once

#include <string_view>

namespace mars::motion {

struct Parameter {
  std::string_view name;     // "step-length"; an option --step-length, in scripts a word before its values
  std::string_view value;    // what follows, for help: "N", "X Y"; as many words as values
  std::string_view meaning;  // with what it is otherwise
  std::string_view example;  // its values

  std::size_t count() const;  // of values
};

}  // namespace mars::motion
