// A rendering goes on where an earlier one of the same film stopped. The folder keeps the compiled film (film.mars),
// and frames.json says what it was compiled from: while that is the same, nothing is compiled again, and all runs in
// the folder render the very same film, on whichever machines. Where the film was edited, frames that show the same as
// before stay. A run that goes on with another, as a job that is started again, takes the folder's film without a look
// at what it was compiled from, which may be half edited by then.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/content/film/compiled_film.h"
#include "host/content/film/frame_set.h"
#include "host/images/picture_format.h"
#include "host/render/sinks/frame_folder.h"

namespace mars::resume {

// What a run asks of a folder.
struct Wish {
  std::string folder;
  std::string film;                  // its file, as the person gave it
  std::vector<std::string> options;  // with which it is compiled, as on a command line
  sinks::FrameForm form{};
  film::FrameSet frames;
  bool overwrite = false;  // render them all, whatever is there
  bool kept_film = false;  // the folder's film, even if `film` has changed or is gone; `film` if the folder has none
  bool renders = true;     // no: the film is left in the folder for runs to come, and no frame is claimed
};

// The number of frames asked for, where all are there: nothing is left to render. None also where that cannot be seen
// without compiling the film, or from this machine.
std::optional<std::uint32_t> count_if_complete(const Wish& wish);

// A command line that renders these frames of the folder as those that are there were rendered.
std::string command_for(const std::string& folder, const sinks::Manifest& there, const film::FrameSet& frames);

// Throws Failure, which says how to get `frames` all the same, where the folder does not keep the film that its
// manifest names.
void require_kept_film(const std::string& folder, const sinks::Manifest& there, const film::FrameSet& frames);

struct Opened {
  film::CompiledFilm film;
  std::unique_ptr<sinks::FrameFolder> folder;  // none where nothing is left to render
  std::uint32_t asked = 0;                     // frames
  std::vector<std::uint32_t> frames;           // those that this run is to render, ascending
  std::string changed;                         // a line about what the film shows otherwise now; "": nothing
};

// Enters the folder with the film that it keeps, or, where that is not the one asked for, the one that `compile` gives.
// Throws Failure, and changes nothing, where the frames that are there are not of this film, size and format, and are
// not to be overwritten. Another film is one in another file of which no frame is as before.
// What is waited for is waited for as `bounds` say.
Opened open(const Wish& wish, const std::function<film::CompiledFilm()>& compile,
            const sinks::Patience::Bounds& bounds = {});

// The film with which open() would enter the folder, where nothing is changed. Throws Failure where the folder's frames
// would be in its way.
film::CompiledFilm film_for(const Wish& wish, const std::function<film::CompiledFilm()>& compile);

}  // namespace mars::resume
