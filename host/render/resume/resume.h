// A rendering goes on where an earlier one of the same film stopped. The folder keeps the compiled film (film.mars),
// and frames.json says what it was compiled from: while that is the same, nothing is compiled again, and all runs in
// the folder render the very same film, on whichever machines. Where the film was edited, frames that show the same as
// before stay.
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
  images::PictureFormat format = images::PictureFormat::png;
  film::FrameSet frames;
  bool overwrite = false;  // render them all, whatever is there
};

// The number of frames asked for, where all are there: nothing is left to render. None also where that cannot be seen
// without compiling the film, or from this machine.
std::optional<std::uint32_t> count_if_complete(const Wish& wish);

struct Opened {
  film::CompiledFilm film;
  std::unique_ptr<sinks::FrameFolder> folder;  // none where nothing is left to render
  std::uint32_t asked = 0;                     // frames
  std::vector<std::uint32_t> frames;           // of these, to be rendered, ascending
  std::string changed;                         // a line about what the film shows otherwise now; "": nothing
};

// Enters the folder with the film that it keeps, or, where that is not the one asked for, the one that `compile` gives.
// Throws Failure, and changes nothing, where the frames that are there are not of this film, size and format, and are
// not to be overwritten. Another film is one in another file of which no frame is as before.
// `warn` takes a line about what is waited for.
Opened open(const Wish& wish, const std::function<film::CompiledFilm()>& compile, const sinks::Warn& warn = {});

}  // namespace mars::resume
