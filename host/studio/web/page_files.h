// The page's own files: what HTTP answers from their folder.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "host/studio/web/gate.h"

namespace mars::web {

struct Answer {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string tag;  // ETag; "": none
  std::string body;
};

// The file of the path ("/" is /index.html), if it is below `folder`, by its own name and where links lead, and of a
// kind that pages are made of. `known`: the tag of what the browser has.
Answer answer_file(const std::filesystem::path& folder, std::string_view path, std::string_view known);

}  // namespace mars::web
