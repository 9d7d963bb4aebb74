// What a page says, from its text (docs/studio-protocol.md). Pages are not trusted: anything may come.
#pragma once

#include <cstddef>
#include <string_view>

#include "host/content/document/json_file.h"

namespace mars::web {

inline constexpr std::size_t kMostMessage = 64 * 1024;  // bytes of a page's message

// An object with a text `do`, nested at most 16 deep, whose numbers are finite. Throws Failure.
document::Json read_page_message(std::string_view text);

}  // namespace mars::web
