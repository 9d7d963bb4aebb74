// The frames of a panorama: nodes draw its faces into a folder of their own, beside that of the frames, which the mars
// process joins then. Meanwhile it has the claim on the frames, as the host of another film has.
#pragma once

#include <string>

#include "host/render/resume/resume.h"
#include "host/shell/launch/display.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

// Whether the film, or with kept_film the folder's, is a panorama whose frames are asked for; false where it cannot be
// read: who reads it says why.
bool is_panorama(const options::RenderOptions& options);

// The options that draw its faces where no frames are written. Compiles the film.
options::RenderOptions faces_of(options::RenderOptions options);

class FilmPanorama {
 public:
  // Enters the folder. Throws Failure as resume::open(). Both must outlive it.
  FilmPanorama(const options::RenderOptions& options, Display& display);

  bool is_there() const { return opened_.folder == nullptr; }
  // The options that draw the faces of the frames that are not there.
  options::RenderOptions faces() const;
  // The faces are there: joins them, and removes them. Throws Failure where one is missing, or a frame cannot be
  // written; then the same command goes on.
  void join();

 private:
  void remove_faces() const;

  const options::RenderOptions& options_;
  Display& display_;
  resume::Opened opened_;
};

}  // namespace mars::launch
