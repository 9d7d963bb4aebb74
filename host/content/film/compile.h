// From a film as described to the film as nodes read it (node/wire/film.h): T-matrices computed once, only what
// changes from frame to frame kept, render intervals cut. And the door to either kind of file: `load_film`.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "host/content/animator/pose/film.h"
#include "host/content/film/compiled_film.h"
#include "host/content/film/crop.h"
#include "host/content/film/eye.h"

namespace mars::film {

// What a person may choose against the film file.
struct CompileOptions {
  std::optional<animator::Cutting> cutting{};
  std::optional<std::array<std::uint32_t, 2>> size{};  // pixels, each 1..wire::kMaxSide
  std::optional<std::uint32_t> samples{};              // of a pixel: 1, 2, 4, 8 or 16
  Eye eye = Eye::middle;
  std::optional<Crop> crop{};  // of the picture, all that is drawn; none: all of it
  std::uint32_t margin = 0;    // pixels that are drawn around that
  bool in_file = false;        // the compiled film lies in a file, because little of it is looked at (lazy_memory.h)
};

CompiledFilm compile(const animator::Film& film, const CompileOptions& options = {});

// Throws as compile() does where the camera sees nothing in some frame, for it looks at its own place or along its up
// vector, or where a spot shines at its own place.
void check_camera_and_lights(const animator::Film& film);

// A film file or a .mars file, known by its content. The intervals of a .mars file are cut for good.
CompiledFilm load_film(const std::filesystem::path& path, const CompileOptions& options = {});

}  // namespace mars::film
