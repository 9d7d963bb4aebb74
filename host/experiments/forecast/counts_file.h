// Counts of all frames of a film in a file, which knows the film, its frames, and this program's way to draw them: a
// header with a checksum, then numbers, small ones in few bytes. Written whole or not at all; read only if every bit is
// as it was written.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "host/experiments/forecast/film_counts.h"

namespace mars::forecast {

// What the counts depend on, as a checksum: `block` is the compiled film's.
std::string counted_content(std::span<const std::byte> block, std::span<const farm::Task> tasks,
                            const wire::PackedFilm& film, images::PictureFormat format);

void save_counts(const FilmCounts& counts, const std::string& content, const std::filesystem::path& path);

// Throws Failure where they are of another content, or the file is not as it was written.
FilmCounts load_counts(const std::filesystem::path& path, const std::string& content, std::span<const farm::Task> tasks,
                       const wire::PackedFilm& film);
// What the file has behind its header; `path` for failures.
FilmCounts read_counts(std::string_view numbers, const std::filesystem::path& path, std::span<const farm::Task> tasks,
                       const wire::PackedFilm& film);

}  // namespace mars::forecast
