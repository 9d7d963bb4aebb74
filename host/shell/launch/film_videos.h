// The videos of a rendering, which are made of its frames once these are there: whoever drew them, in whatever order,
// with however many starts, and whoever wrote them. No rendering waits for ffmpeg.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/content/document/work_folder.h"
#include "host/shell/launch/display.h"
#include "host/shell/options/render_options.h"
#include "host/videos/write_video.h"

namespace mars::launch {

class FilmVideos {
 public:
  // Waits until no other process makes one of the videos. Throws Failure, before anything is started, where a video
  // cannot be made (videos::check_order), or is the film. Both must outlive it.
  FilmVideos(const options::RenderOptions& options, Display& display);
  FilmVideos(const options::RenderOptions&&, auto&&...) = delete;

  // Whether all videos are there, of this film, and its frames are not asked for; if so, removes what killed processes
  // have left in the videos' working folders. May compile the film.
  bool are_there();
  // Of the folder's frames; those that are there already are left alone. Throws Failure where a frame is missing or a
  // video cannot be made; then the same command goes on.
  void make();

 private:
  videos::Order order_of(const std::string& file) const;
  std::string recipe_of(const std::string& file, const std::string& film, std::uint32_t film_frames) const;
  bool is_there(const std::string& file, const std::string& film, std::uint32_t film_frames) const;
  void make(const std::string& file);
  void empty_work_folders();

  const options::RenderOptions& options_;
  Display& display_;
  std::optional<videos::Audio> audio_;
  std::map<std::filesystem::path, document::WorkFolder> work_;  // of each video, by its place
};

}  // namespace mars::launch
