#include "host/shell/options/video_options.h"

#include <algorithm>
#include <string>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"

namespace mars::options {
namespace {

constexpr std::uint32_t kWorst = 63;  // quality of any codec

void read_codec(const std::string& word, videos::FormWish& form) {
  if (std::ranges::find(videos::codecs(), word, &videos::Codec::name) == videos::codecs().end())
    throw Failure("'" + word + "' is no codec of videos", "", "");
  form.codec = word;
}

void read_quality(const std::string& word, videos::FormWish& form) {
  form.quality = document::number_in<std::uint32_t>(word);
  if (form.quality.value_or(0) < 1 || *form.quality > kWorst)
    throw Failure("'" + word + "' is not a number from 1 to " + std::to_string(kWorst), "", "");
}

}  // namespace

void add_video_form(cli::Command command, videos::FormWish& form) {
  command
      .add_read(
          "--codec", [&form](const std::string& word) { read_codec(word, form); },
          "Codec of videos: h264, h265, vp9, av1, ffv1 or prores; default: h264, in .webm vp9. Example: --codec av1")
      .type("NAME");
  command
      .add_read(
          "--quality", [&form](const std::string& word) { read_quality(word, form); },
          "Quality of videos, from 1, the best; default: 16 of h264. Example: --quality 23")
      .type("N");
}

}  // namespace mars::options
