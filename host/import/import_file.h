// `mars import`: a model file from a file of another program, with the shape scaled into the unit cube and its bounds
// as sbb.
#pragma once

#include <filesystem>
#include <string>

namespace mars::host {

// Reads the patch file (.bpt) or mesh file `from` and writes a model file `to`. Its joint is named `joint`, or as the
// file if that is "". A mesh of several colours has a joint for each, fixed to the first. Tells what was written in one
// line.
std::string import_model(const std::filesystem::path& from, const std::filesystem::path& to, std::string joint);

}  // namespace mars::host
