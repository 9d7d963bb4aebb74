// How the values of film and model files are written, for messages about those that are not: by the table of keys.
#pragma once

#include <string>

#include "host/content/document/document.h"

namespace mars::document {

// "\"limits\": {\"x\": [-30, 30]}", of the key whose value the element is or lies in; "" where none is known.
std::string form_of(const Element& element);

}  // namespace mars::document
