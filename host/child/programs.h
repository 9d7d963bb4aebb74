// Where programs are.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mars::child {

// The file of the program that runs here.
std::filesystem::path own_file();

// A file that may be executed. Folders that we may not look into have none for us.
bool runnable(const std::filesystem::path& file);

// The program of that name in `path`, folders separated by colons; none: in none of them.
std::optional<std::filesystem::path> find_program(const std::string& name, const std::string& path);

// In the first folder of `path` that has any of `names`, the program whose name comes first in `names`.
std::optional<std::filesystem::path> find_first_program(std::span<const std::string_view> names, std::string_view path);

}  // namespace mars::child
