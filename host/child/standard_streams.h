// Standard input, output and error of programs that a person starts.
#pragma once

#include <iosfwd>

namespace mars::child {

// To begin a program with. Opens /dev/null for standard input, output and error where a person has closed them: a file
// or pipe that is opened later would get their number, and what is printed would go there. From then on std::cout and
// std::cerr pass on plain text alone (hal/failure/plain_text.h): whatever a message repeats of arguments, files or
// other machines cannot act on a terminal.
void prepare_standard_streams();

// To end a program with: what was printed is written. Throws Failure where it cannot be.
void finish_output();

// The same streams for what moves a terminal's cursor: foreign text in it has to be made plain by its writer.
std::ostream& raw_output();
std::ostream& raw_error();

}  // namespace mars::child
