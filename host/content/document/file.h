// A whole file into memory, for every reader. What cannot be read is one Failure that names the file, at once: pipes
// and devices, which nobody may ever fill or which never end, are neither waited for nor read. (whole_file.h writes
// them, recorded_reads.h knows which were read.)
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace mars::document {

inline constexpr std::uintmax_t kLargestFileRead = std::uintmax_t{1} << 34;  // bytes

// Refuses what is missing, no regular file, or larger than `largest` bytes.
std::string read_file(const std::filesystem::path& path, std::uintmax_t largest = kLargestFileRead);
// As read_file(); none where it is missing.
std::optional<std::string> read_file_if_there(const std::filesystem::path& path, std::uintmax_t largest);

// Reads a file piece by piece; false where it is missing. Refuses what is no regular file, or too large.
bool read_pieces(const std::filesystem::path& path, const std::function<void(std::string_view piece)>& take,
                 std::uintmax_t largest = std::numeric_limits<std::uintmax_t>::max());

// The first bytes of a regular file: fewer where it is shorter, none where it cannot be read.
std::string read_start(const std::filesystem::path& path, std::size_t bytes);

// A file or folder that a stranger names, as seen from `folder`, links followed. Throws Failure where it is not below.
std::filesystem::path path_below(const std::filesystem::path& folder, const std::string& name);

// The same for all names of a file, which need not be there: absolute, links followed.
std::filesystem::path place_of_file(const std::filesystem::path& file);

bool file_exists(const std::filesystem::path& path);

}  // namespace mars::document
