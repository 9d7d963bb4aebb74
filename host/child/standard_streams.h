// Standard input, output and error of programs that a person starts, who may have closed them.
#pragma once

namespace mars::child {

// Opens /dev/null for standard input, output and error where they are closed: a file or pipe that is opened later would
// get their number, and what is printed would go there.
void open_standard_streams();

}  // namespace mars::child
