// How the values of film and model files are written, for messages about those that are not. docs/schema says what
// is allowed; a test holds the two together.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/content/document/document.h"

namespace mars::document {

struct Form {
  std::string_view key;  // "place"; "limits.x" where the key means something else elsewhere; "pose.*" of any name;
                         // "/color" of the file itself
  std::string_view value;
};

std::span<const Form> forms();

// "\"limits\": {\"x\": [-30, 30]}", of the key whose value the element is or lies in; "" where none is known.
std::string form_of(const Element& element);

}  // namespace mars::document
