// How far a command is that takes a while, for who looks at a terminal.
#pragma once

#include <unistd.h>

#include "host/child/standard_streams.h"

namespace mars::commands {

inline auto shown_progress(const char* doing) {
  return [doing](int done, int all) {
    if (isatty(STDERR_FILENO))
      child::raw_error() << '\r' << doing << ": " << 100 * done / all << " %" << (done == all ? "\n" : "");
  };
}

}  // namespace mars::commands
