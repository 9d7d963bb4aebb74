// A word of a command line that a person is shown, to be pasted into a shell.
#pragma once

#include <string>

namespace mars::document {

// In quotation marks where the shell would read it otherwise.
std::string shell_word(const std::string& word);

}  // namespace mars::document
