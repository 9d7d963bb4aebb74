#include "host/videos/probe.h"

#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "host/content/document/file.h"
#include "host/content/document/file_failure.h"
#include "host/content/document/text.h"
#include "host/videos/ffmpeg.h"

namespace mars::videos {
namespace {

using nlohmann::json;

// It is not there, or ffmpeg cannot read it.
class NoMedia : public Failure {
 public:
  using Failure::Failure;
};

// "30000/1001"
double ratio_of(const std::string& text) {
  const std::size_t at = text.find('/');
  const double above = document::number_in<double>(text.substr(0, at)).value_or(0);
  const double below = at == std::string::npos ? 1 : document::number_in<double>(text.substr(at + 1)).value_or(0);
  return below > 0 ? above / below : 0;
}

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw NoMedia("is no file of video or sound that ffmpeg can read", file.string(), "see what it is: ffprobe FILE");
}

json read(const std::filesystem::path& file, bool counts) {
  const std::string program = find_ffmpeg(file, "ffprobe");
  std::vector<std::string> words{"-v", "error", "-of", "json", "-show_format", "-show_streams"};
  if (counts) words.emplace_back("-count_packets");
  words.push_back(file_word(file));
  try {
    return json::parse(run_ffmpeg(program, words, file, {}));
  } catch (const FfmpegRefusal&) {
    refuse(file);
  } catch (const document::FileFailure&) {
    refuse(file);
  } catch (const json::exception&) {
    refuse(file);
  }
}

Probed::Video video_of(const json& stream) {
  const std::string packets = stream.value("nb_read_packets", std::string("0"));
  return {stream.value("codec_name", std::string()), stream.value("width", 0u), stream.value("height", 0u),
          ratio_of(stream.value("r_frame_rate", std::string("0/1"))),
          document::number_in<std::uint64_t>(packets).value_or(0)};
}

Probed probed(const std::filesystem::path& file, bool counts) {
  if (!document::file_exists(file)) throw NoMedia("is not there", file.string(), "check the name");
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))  // ffprobe would wait for what a pipe may bring
    throw NoMedia("is not a regular file", file.string(), "name a file on a disk");
  const json all = read(file, counts);
  Probed found;
  for (const json& stream : all.value("streams", json::array())) {
    const std::string type = stream.value("codec_type", std::string());
    if (type == "video" && !found.video) found.video = video_of(stream);
    if (type == "audio" && found.audio.empty()) found.audio = stream.value("codec_name", std::string("audio"));
  }
  const json format = all.value("format", json::object()), tags = format.value("tags", json::object());
  for (const auto& [key, value] : tags.items())
    if ((key == "comment" || key == "COMMENT") && value.is_string()) found.comment = value.get<std::string>();
  return found;
}

// None where it is no video.
std::uint64_t pictures_in(const std::filesystem::path& part) try {
  const Probed found = probed(part, true);
  return found.video ? found.video->packets : 0;
} catch (const NoMedia&) {
  return 0;
}

}  // namespace

Probed probe(const std::filesystem::path& file) { return probed(file, true); }

void require_pictures(const std::filesystem::path& part, const std::filesystem::path& file, std::uint64_t count) {
  const std::uint64_t pictures = pictures_in(part);
  if (pictures != count)
    throw Failure("ffmpeg wrote " + std::to_string(pictures) + " of " + document::counted(count, "picture"),
                  file.string(), "see whether the disk is full");
}

void require_some_picture(const std::filesystem::path& part, const std::filesystem::path& file) {
  if (pictures_in(part) == 0) throw Failure("ffmpeg wrote no picture", file.string(), "see whether the disk is full");
}

std::string comment_of(const std::filesystem::path& file) try {
  return probed(file, false).comment;
} catch (const NoMedia&) {
  return "";
}

bool has_audio(const std::filesystem::path& file) { return !probed(file, false).audio.empty(); }

}  // namespace mars::videos
