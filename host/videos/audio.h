// The sound of a video: a file that ffmpeg can read, and when it begins.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/videos/video_form.h"

namespace mars::videos {

struct Audio {
  std::filesystem::path file;
  double delay = 0;  // seconds from the film's first frame to the sound's beginning; negative: it began before

  bool operator==(const Audio&) const = default;
};

// Throws Failure where there is no such file, or it has no sound.
void check_audio(const Audio& audio);

// Encodes the second input's sound for a video that begins `begins` seconds after the film, and takes `seconds`: it is
// cut where the video ends.
std::vector<std::string> audio_words(const Audio& audio, const Form& form, double begins, double seconds);

}  // namespace mars::videos
