// Files that another program writes, which appear whole or not at all, as those of whole_file.h.
#pragma once

#include <filesystem>
#include <functional>

namespace mars::document {

// As write_whole_file(): `fill` is given the temporary file, which is there and empty.
void fill_whole_file(const std::filesystem::path& path,
                     const std::function<void(const std::filesystem::path& part)>& fill);

}  // namespace mars::document
