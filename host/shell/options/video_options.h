// How videos are encoded, as people say it: the same options of all commands that make videos.
#pragma once

#include "host/cli/command.h"
#include "host/videos/video_form.h"

namespace mars::options {

// --codec and --quality; `form` must outlive the parsing.
void add_video_form(cli::Command command, videos::FormWish& form);

}  // namespace mars::options
