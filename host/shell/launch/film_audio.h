// The sound that a film file names, for its videos.
#pragma once

#include <filesystem>
#include <optional>

#include "host/render/sinks/manifest.h"
#include "host/videos/audio.h"

namespace mars::launch {

// None where it names none, or is a compiled film, which has none. Throws Failure where it cannot be read.
std::optional<videos::Audio> audio_of_film(const std::filesystem::path& film);

// Of the film that a folder's frames were rendered from, where that is still there.
std::optional<videos::Audio> audio_of_folder(const sinks::Manifest& manifest);

}  // namespace mars::launch
