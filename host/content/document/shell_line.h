// A line of words as a person types them to a shell.
#pragma once

#include <string>
#include <vector>

namespace mars::document {

// Its words: apart at blanks, but for those in quotation marks or after a backslash; $, * and the like stand for
// themselves. Throws Failure where a quotation mark is not closed.
std::vector<std::string> shell_words(const std::string& line);

}  // namespace mars::document
