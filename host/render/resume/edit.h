// What an edit of a film means for the frames that a folder has of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/content/film/compiled_film.h"
#include "host/render/sinks/manifest.h"

namespace mars::resume {

// The frames of `now`, ascending, that are not as in `before`, of which a folder has frames.
struct Edit {
  std::vector<std::uint32_t> frames;
  bool keeps_none = false;  // no frame that both films have is as before
};

// Throws Failure where they have another size or other samples of a pixel.
Edit edit_of(const film::CompiledFilm& before, const film::CompiledFilm& now, const std::string& folder,
             wire::LayerSet layers = 0);

// The hashes of frames that stay, added to those of `all`, which is the manifest of the film as it is now.
void add_kept_frames(const sinks::Manifest& there, const Edit& edit, sinks::Manifest& all);

// "film.json has changed: frames 24-35 are to be rendered again (interval 3 of 6)", of frames that had been rendered;
// `what`: "film.json has changed".
std::string edit_text(const sinks::Manifest& there, const Edit& edit, const film::CompiledFilm& now,
                      const std::string& what);

// "frames.json lists no more frames 3-8 of walk.json, whose files stay"; "": it lists all that it had.
std::string unlisted_text(const sinks::Manifest& there, const sinks::Manifest& now);

}  // namespace mars::resume
