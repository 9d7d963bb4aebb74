// The frames of a panorama: nodes draw its faces into a working folder beside that of the frames, and the mars process
// joins them then. Meanwhile it has the claim on the frames, as the host of another film has.
#pragma once

#include <filesystem>
#include <string>

#include "host/content/document/work_folder.h"
#include "host/render/resume/resume.h"
#include "host/shell/launch/display.h"
#include "host/shell/options/render_options.h"

namespace mars::launch {

// Whether the film, or with kept_film the folder's, is a panorama whose frames are asked for; false where it cannot be
// read: who reads it says why.
bool is_panorama(const options::RenderOptions& options);

// The options that draw its faces where no frames are written. Compiles the film.
options::RenderOptions faces_of(options::RenderOptions options);

// Removes faces of frames that are there, which a process that was killed has left beside this folder of frames; not
// those of other frames, which other runs may draw.
void remove_left_faces(const std::filesystem::path& frames);
// Removes all faces beside a folder of frames that goes too, unless somebody draws there.
void remove_all_faces(const std::filesystem::path& frames);

class FilmPanorama {
 public:
  // Enters the folder. Throws Failure as resume::open(). Both must outlive it.
  FilmPanorama(const options::RenderOptions& options, Display& display);
  FilmPanorama(const options::RenderOptions&&, auto&&...) = delete;

  bool is_there() const { return opened_.folder == nullptr; }
  // The options that draw the faces of the frames that are not there.
  options::RenderOptions faces() const;
  // The faces are there: joins them, and removes them. Throws sinks::DamagedFrame where one is missing or torn, after
  // which it can be called again, and Failure where a frame cannot be written; then the same command goes on.
  void join();

 private:
  void check_memory() const;

  const options::RenderOptions& options_;
  Display& display_;
  resume::Opened opened_;
  document::WorkFolder work_;  // other runs may draw faces of other frames there
};

}  // namespace mars::launch
