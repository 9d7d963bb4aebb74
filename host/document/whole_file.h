// Files that appear whole or not at all: written under a temporary name in the same folder, then renamed.
// Whatever goes wrong is one Failure with the system's reason, and the temporary file is gone.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace mars::host {

// What ends the temporary names; a killed process may leave such files, never others.
inline constexpr std::string_view kPartSuffix = ".part";

void write_whole_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_whole_file(const std::filesystem::path& path, std::string_view text);
// What `produce` writes, piece by piece.
using Write = std::function<void(std::string_view piece)>;
void write_whole_file(const std::filesystem::path& path, const std::function<void(const Write&)>& produce);

// Throws as writing `path` would, as far as can be told before; leaves nothing behind.
void check_can_write(const std::filesystem::path& path);

// Refuses to write `to` where it is the file `from` that is read.
void refuse_same_file(const std::filesystem::path& from, const std::filesystem::path& to);

std::vector<std::byte> read_whole_file(const std::filesystem::path& path);

// Throws Failure("cannot <act>: <the system's reason>", path, what to do about it) for `error`, an errno.
[[noreturn]] void fail_file(const char* act, const std::filesystem::path& path, int error);

}  // namespace mars::host
