// The command line of a rendering that a page asks for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/studio/rendering/rendering.h"

namespace mars::studio {

// The folder for frames in options of a `render` message.
std::filesystem::path frames_folder(const Json& options, const std::filesystem::path& folder);

// `mars render` and its options, watched at `socket`. Throws Failure where the options make no sense.
std::vector<std::string> render_words(const RenderingSettings& settings, const Json& options,
                                      const std::string& socket);

}  // namespace mars::studio
