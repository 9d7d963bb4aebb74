// Keys of a film of one rate at the frames of another.
#pragma once

#include "host/content/document/json_file.h"

namespace mars::animator {

// Each key of the actor, an object of a film file, or its matrices, comes to the frame that is nearest to `factor`
// times its own. Where keys follow each other closely and evenly, as in captured motion, it takes the value that the
// motion has at just that time. Of two keys that come to one frame the later stays.
void retime_actor(document::Json& actor, double factor);

}  // namespace mars::animator
