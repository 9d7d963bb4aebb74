#include "host/videos/audio.h"

#include <cmath>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/videos/probe.h"

namespace mars::videos {
namespace {

// It refuses others, as 5.1 with speakers at the sides.
constexpr const char* kLayoutsOfOpus = ",aformat=channel_layouts=7.1|6.1|5.1|5.0|quad|3.0|stereo|mono";

}  // namespace

void check_audio(const Audio& audio) {
  if (!has_audio(audio.file))
    throw Failure("has no sound", audio.file.string(), "name a file that ffmpeg can read: WAV, FLAC, MP3 and others");
}

std::vector<std::string> audio_words(const Audio& audio, const Form& form, double begins, double seconds) {
  const double delay = audio.delay - begins;
  std::string filter;
  if (delay > 0) filter = "adelay=delays=" + document::formatted("%.0f", std::round(1000 * delay)) + ":all=1,";
  if (delay < 0) filter = "atrim=start=" + document::formatted("%.6f", -delay) + ",asetpts=PTS-STARTPTS,";
  filter += "atrim=end=" + document::formatted("%.6f", seconds);
  if (form.kind->audio_codec == "libopus") filter += kLayoutsOfOpus;
  return {"-af", filter, "-c:a", std::string(form.kind->audio_codec), "-b:a", "192k"};
}

}  // namespace mars::videos
