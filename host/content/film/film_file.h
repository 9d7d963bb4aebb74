// Compiled films on disk: .mars files. A header of 64 bytes with a checksum, then the block of node/wire/film.h.
// Written whole or not at all; read only if every bit is as it was written.
#pragma once

#include <filesystem>

#include "host/content/film/compiled_film.h"

namespace mars::film {

void save_film(const CompiledFilm& film, const std::filesystem::path& path);
// For a folder that MARS keeps: `part` is the temporary file (document::replace_file).
void save_film(const CompiledFilm& film, const std::filesystem::path& path, const std::filesystem::path& part);

// Whether the file is as save_film() writes the film.
bool is_saved(const CompiledFilm& film, const std::filesystem::path& path);

// Whether the file begins as a .mars file; false if it cannot be read.
bool is_compiled_film(const std::filesystem::path& path);

// `in_file`: as in CompileOptions.
CompiledFilm load_compiled_film(const std::filesystem::path& path, bool in_file = false);

}  // namespace mars::film
