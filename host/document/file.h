// A whole file into memory, for every reader of models and films. What cannot be read is one Failure that
// names the file. (whole_file.h writes them, recorded_reads.h knows which were read.)
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace mars::host {

// Refuses what is missing, no regular file, or larger than `largest` bytes.
std::string read_file(const std::filesystem::path& path, std::uintmax_t largest = std::uintmax_t{1} << 34);

// The first bytes of a regular file: fewer where it is shorter, none where it cannot be read.
std::string read_start(const std::filesystem::path& path, std::size_t bytes);

bool file_exists(const std::filesystem::path& path);

}  // namespace mars::host
