// How long a film is against the keys that words give it.
#pragma once

#include <cstdint>
#include <string>

#include "host/content/document/json_file.h"

namespace mars::editing {

// A film that ends before the frame `last` gets the frames up to it, or stays as it is. What the person should know
// then: "the film has 49 frames now, not 24"; "" where it is long enough.
std::string fit_length(document::Json& film, std::uint32_t last, bool lengthen);

}  // namespace mars::editing
