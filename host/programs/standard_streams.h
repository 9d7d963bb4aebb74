// What every program does first.
#pragma once

namespace mars::programs {

// Opens /dev/null for standard input, output and error where they are closed: a file or pipe that is opened later would
// get their number, and what is printed would go there.
void open_standard_streams();

}  // namespace mars::programs
