// What options of a rendering do not go together. Throws Failure, which names a remedy.
#pragma once

#include "host/shell/options/render_wish.h"

namespace mars::options {

// Of all programs: what files of frames cannot hold.
void check_pictures(const RenderOptions& options);
// Where files have one compression only, none may be chosen, not even theirs.
void check_compression(const RenderOptions& options, bool is_given);
// Of programs that draw.
void check_together(const RenderOptions& options, Program program);

}  // namespace mars::options
