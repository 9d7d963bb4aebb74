// The program gnuplot, an optional companion.
#pragma once

#include <string>

namespace mars::animator {

// What the script writes to its standard output. Throws Failure where gnuplot is missing or fails.
std::string draw_with_gnuplot(const std::string& script);

}  // namespace mars::animator
