#include "host/videos/verify_video.h"

#include <cmath>
#include <sstream>

#include "hal/failure/failure.h"
#include "host/content/document/checksum.h"
#include "host/content/document/text.h"
#include "host/videos/ffmpeg.h"
#include "host/videos/video_form.h"

namespace mars::videos {
namespace {

constexpr double kSameRate = 1e-3;  // of each other: containers of milliseconds round

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// Lines of ffmpeg: "0, 12, 12, 1, 518400, 8f3c...", of stream 0 the pictures.
void count_pictures(const std::string& lines, VideoVerdict& verdict) {
  document::Checksum sum;
  std::istringstream all(lines);
  for (std::string line; std::getline(all, line);) {
    if (!line.starts_with("0,")) continue;
    const std::string hash = line.substr(line.rfind(' ') + 1);
    sum.add(std::as_bytes(std::span(hash)));
    ++verdict.decoded;
  }
  verdict.hash = sum.digits();
}

void decode(const std::filesystem::path& file, VideoVerdict& verdict) try {
  Ffmpeg ffmpeg(find_ffmpeg(file),
                {"-v", "error", "-nostdin", "-xerror", "-i", file_word(file), "-map", "0:v:0", "-map", "0:a?", "-vsync",
                 "passthrough", "-f", "framemd5", "-"},
                file, {});
  ffmpeg.finish();
  count_pictures(ffmpeg.printed(), verdict);
  const std::string complaints = ffmpeg.complaints();
  if (!complaints.empty())
    verdict.troubles.push_back("decodes with errors: " + complaints.substr(0, complaints.find('\n')));
} catch (const Failure& failure) {
  verdict.troubles.push_back("does not decode: " + failure.problem);
}

void compare(const Mark& mark, VideoVerdict& verdict) {
  const Probed::Video& video = *verdict.found.video;
  if (verdict.decoded != mark.frames.size())
    verdict.troubles.push_back("has " + std::to_string(verdict.decoded) + " of " +
                               document::counted(mark.frames.size(), "frame"));
  if (video.width != mark.width || video.height != mark.height)
    verdict.troubles.push_back("has " + size_text(video.width, video.height) + " pixels instead of " +
                               size_text(mark.width, mark.height));
  const double rate = exact_rate(mark.rate);
  if (std::abs(video.rate - rate) > kSameRate * rate)
    verdict.troubles.push_back("has " + document::shown(video.rate) + " frames a second instead of " +
                               document::shown(rate));
}

}  // namespace

VideoVerdict verify_video(const std::filesystem::path& file) {
  VideoVerdict verdict;
  verdict.found = probe(file);
  if (!verdict.found.video) throw Failure("has no video", file.string(), "name a video or a folder of frames");
  verdict.mark = mark_of(verdict.found.comment);
  decode(file, verdict);
  if (verdict.mark) compare(*verdict.mark, verdict);
  return verdict;
}

}  // namespace mars::videos
