#include "host/videos/video_form.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"

namespace mars::videos {
namespace {

using Words = std::vector<std::string>;

const Kind* find_kind(std::string_view ending) {
  const auto found = std::ranges::find(kinds(), ending, &Kind::ending);
  return found == kinds().end() ? nullptr : &*found;
}

const Codec& codec_named(std::string_view name) {
  const auto found = std::ranges::find(codecs(), name, &Codec::name);
  check(found != codecs().end(), "a kind's codecs are known");
  return *found;
}

void add(Words& words, std::initializer_list<std::string> more) { words.insert(words.end(), more); }

// From sRGB's full range to BT.709's, of which video has 219 levels; what is not named is taken for other colours by
// some players.
void add_video_colors(Words& words, const char* pixels) {
  add(words, {"-vf",
              std::string("scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int+"
                          "full_chroma_inp,format=") +
                  pixels,
              "-color_primaries", "bt709", "-color_trc", "bt709", "-colorspace", "bt709", "-color_range", "tv"});
}

// Encoders write other bytes with another number of threads, and would start as many as there are processors. With one
// number a piece of a video is the same on every machine.
constexpr const char* kThreads = "8";
// x265 writes other bytes from run to run on a busy machine if its threads share more than one frame.
constexpr const char* kFrameThreads = "1";

void add_speed(Words& words, std::string_view encoder) {
  add(words, {"-threads", kThreads});
  if (encoder == "libx264") add(words, {"-preset", "medium", "-profile:v", "high"});
  if (encoder == "libx265")
    add(words, {"-preset", "medium", "-x265-params", std::string("log-level=error:frame-threads=") + kFrameThreads});
  if (encoder == "libvpx-vp9") add(words, {"-b:v", "0", "-deadline", "good", "-cpu-used", "4", "-row-mt", "1"});
  if (encoder == "libsvtav1") add(words, {"-preset", "8"});
  if (encoder == "libaom-av1") add(words, {"-b:v", "0", "-cpu-used", "6", "-row-mt", "1"});
}

Words words_of_codec(const Form& form, std::string_view encoder) {
  Words words{"-c:v", std::string(encoder)};
  const std::string_view codec = form.codec->name;
  if (codec == "gif") return words;
  if (codec == "apng") {
    add(words, {"-pix_fmt", "rgb24", "-pred", "mixed"});
  } else if (codec == "ffv1") {
    add(words, {"-pix_fmt", "bgr0", "-level", "3", "-g", "1", "-slicecrc", "1"});
  } else if (codec == "prores") {
    add_video_colors(words, "yuv422p10le");
    add(words, {"-profile:v", "hq", "-vendor", "apl0", "-bsf:v",
                "prores_metadata=color_primaries=bt709:color_trc=bt709:colorspace=bt709"});
  } else {
    add_video_colors(words, "yuv420p");
    add_speed(words, encoder);
    add(words, {"-crf", std::to_string(*form.quality)});
  }
  return words;
}

// 30 of 29.97, which is 30000/1001; 0: it is no such rate.
std::uint64_t thousands_of_tv(double rate) {
  constexpr double kNear = 0.002;  // also of 23.976
  const double thousands = std::round(rate * 1.001);
  const bool is_tv = rate != std::round(rate) && thousands >= 1 && std::abs(thousands / 1.001 - rate) < kNear;
  return is_tv ? static_cast<std::uint64_t>(thousands) : 0;
}

}  // namespace

std::span<const Kind> kinds() {
  static const std::array kAll{
      Kind{".mp4", "mp4", true, "aac", {"h264", "h265", "av1", "vp9"}},
      Kind{".m4v", "mp4", true, "aac", {"h264", "h265"}},
      Kind{".mov", "mov", true, "aac", {"h264", "h265", "prores"}},
      Kind{".mkv", "matroska", true, "aac", {"h264", "h265", "av1", "vp9", "ffv1", "prores"}},
      Kind{".webm", "webm", true, "libopus", {"vp9", "av1"}},
      Kind{".gif", "gif", false, "", {"gif"}},
      Kind{".apng", "apng", false, "", {"apng"}},
  };
  return kAll;
}

std::span<const Codec> codecs() {
  static const std::array kAll{
      Codec{"h264", {"libx264"}, Quality{1, 16, 51}, true, true, ".mp4", "mp4"},
      Codec{"h265", {"libx265"}, Quality{1, 20, 51}, true, true, ".mp4", "mp4"},
      Codec{"vp9", {"libvpx-vp9"}, Quality{1, 20, 63}, false, true, ".mp4", "mp4"},
      Codec{"av1", {"libsvtav1", "libaom-av1"}, Quality{1, 26, 63}, true, true, ".mp4", "mp4"},
      Codec{"ffv1", {"ffv1"}, {}, false, true, ".nut", "nut"},
      Codec{"prores", {"prores_ks"}, {}, true, true, ".mov", "mov"},
      Codec{"gif", {"gif"}, {}, false, false},
      Codec{"apng", {"apng"}, {}, false, false},
  };
  return kAll;
}

const Kind* kind_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return find_kind(ending);
}

std::string endings_text() {
  std::vector<std::string_view> endings;
  for (const Kind& kind : kinds()) endings.push_back(kind.ending);
  return document::joined(endings);
}

Form form_of(const std::filesystem::path& file, const FormWish& wish) {
  const Kind* kind = kind_of(file);
  check(kind != nullptr, "a form is that of a video's name");
  const std::string name = wish.codec.empty() ? std::string(kind->codecs.front()) : wish.codec;
  if (std::ranges::find(kind->codecs, name) == kind->codecs.end())
    throw Failure("a " + std::string(kind->ending) + " file has no " + name, file.string(),
                  "its codecs: " + document::joined(kind->codecs));
  const Codec& codec = codec_named(name);
  if (!codec.quality && wish.quality)
    throw Failure(name + " has one quality only", file.string(), "leave --quality out");
  if (codec.quality && wish.quality && (*wish.quality < codec.quality->best || *wish.quality > codec.quality->worst))
    throw Failure("the quality of " + name + " is from " + std::to_string(codec.quality->best) + ", the best, to " +
                      std::to_string(codec.quality->worst),
                  file.string(), "the default is " + std::to_string(codec.quality->usual));
  return {kind, &codec, codec.quality ? wish.quality.value_or(codec.quality->usual) : wish.quality};
}

std::span<const std::string_view> encoders_for(const Form& form, images::PictureSize size) {
  constexpr std::uint32_t kLeastOfSvt = 64;
  const std::span<const std::string_view> all = form.codec->encoders;
  const bool small = std::min(size.width, size.height) < kLeastOfSvt;
  return small && all.front() == "libsvtav1" ? all.subspan(1) : all;
}

std::string shape_filter(images::Ratio pixel) {
  if (pixel.width == pixel.height) return "";
  return "setsar=sar=" + std::to_string(pixel.width) + "/" + std::to_string(pixel.height) + ":max=1048576";
}

Words encoding_words(const Form& form, std::string_view encoder, images::Ratio pixel) {
  Words words = words_of_codec(form, encoder);
  const std::string shape = shape_filter(pixel);
  if (shape.empty() || form.codec->name == "gif") return words;
  const auto filters = std::ranges::find(words, "-vf");
  if (filters == words.end())
    add(words, {"-vf", shape});
  else
    *std::next(filters) += "," + shape;
  return words;
}

Words container_words(const Form& form) {
  Words words;
  const bool mp4 = form.kind->muxer == "mp4" || form.kind->muxer == "mov";
  if (mp4) add(words, {"-movflags", "+faststart"});                       // plays while it is loaded
  if (mp4 && form.codec->name == "h265") add(words, {"-tag:v", "hvc1"});  // what Apple's players take
  if (form.kind->muxer == "gif") add(words, {"-loop", "0"});
  if (form.kind->muxer == "apng") add(words, {"-plays", "0"});
  add(words, {"-f", std::string(form.kind->muxer)});
  return words;
}

double exact_rate(double rate) {
  const std::uint64_t thousands = thousands_of_tv(rate);
  return thousands == 0 ? rate : static_cast<double>(1000 * thousands) / 1001;
}

std::string rate_text(double rate) {
  const std::uint64_t thousands = thousands_of_tv(rate);
  return thousands == 0 ? document::shown(rate) : std::to_string(1000 * thousands) + "/1001";
}

}  // namespace mars::videos
