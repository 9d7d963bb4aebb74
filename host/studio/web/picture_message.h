// Pictures as pages get them (docs/studio-protocol.md, "Pictures").
#pragma once

#include <cstdint>
#include <string>

#include "host/studio/stage/stage.h"

namespace mars::web {

enum class Encoding : std::uint16_t { raw, deflate, jpeg };

// The picture is one rectangle: all of the view.
bool is_whole(const studio::ViewPicture& picture);

// JPEG is for whole pictures only.
std::string picture_message(const studio::ViewPicture& picture, Encoding encoding);

}  // namespace mars::web
