// The keys of a film as a table to read.
#pragma once

#include <string>

#include "host/content/animator/keys/keys.h"

namespace mars::animator {

// Of the chosen parts, in the range: lines of text, frame by frame; then what has no keys. Of joints only the
// turns that they are free to make.
std::string keys_table(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range);

}  // namespace mars::animator
