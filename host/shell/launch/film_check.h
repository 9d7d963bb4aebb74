// A film's file looked at before a job is started, which takes seconds: in milliseconds, however large it is. The host
// reads all of it.
#pragma once

#include <filesystem>

namespace mars::launch {

// Throws Failure where it is missing, no file, cannot be read or, up to a megabyte, is neither JSON nor a .mars file.
void check_film_file(const std::filesystem::path& film);

}  // namespace mars::launch
