// Which videos there are: kinds of files, by their endings, and codecs with the words by which ffmpeg encodes them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/images/picture_place.h"
#include "host/images/picture_size.h"

namespace mars::videos {

struct Kind {
  std::string_view ending;  // ".mp4"
  std::string_view muxer;   // ffmpeg's
  bool has_audio;
  std::string_view audio_codec;          // ffmpeg's encoder
  std::vector<std::string_view> codecs;  // that it may hold; the first by default
};

// Of a codec that takes a quality, ffmpeg's CRF: the lower, the better and larger.
struct Quality {
  std::uint32_t best, usual, worst;
};

struct Codec {
  std::string_view name;
  std::vector<std::string_view> encoders;  // ffmpeg's, the one to be preferred first
  std::optional<Quality> quality;
  bool needs_even_sides = false;
  bool cuts = true;                 // a video of it can be joined of pieces
  std::string_view piece_ending{};  // of a piece's file, whose times are exact
  std::string_view piece_muxer{};
};

// What a person says of it.
struct FormWish {
  std::string codec;  // "": the kind's first
  std::optional<std::uint32_t> quality;

  bool operator==(const FormWish&) const = default;
};

struct Form {
  const Kind* kind;
  const Codec* codec;
  std::optional<std::uint32_t> quality;
};

std::span<const Kind> kinds();
std::span<const Codec> codecs();

// None: the name's ending is no video's. Capital letters count as small ones.
const Kind* kind_of(const std::filesystem::path& file);
inline bool is_video_name(const std::filesystem::path& file) { return kind_of(file) != nullptr; }
std::string endings_text();  // ".mp4, .mov, ..."

// Throws Failure where the kind of `file` has no such codec, or the codec no such quality.
Form form_of(const std::filesystem::path& file, const FormWish& wish);

// Those of ffmpeg's encoders that take pictures of this size: SVT-AV1 takes no small ones.
std::span<const std::string_view> encoders_for(const Form& form, images::PictureSize size);

// By which ffmpeg encodes pictures of full-range RGB with `encoder`, one of the codec's. `pixel`: the shape of a pixel.
std::vector<std::string> encoding_words(const Form& form, std::string_view encoder, images::Ratio pixel = {1, 1});
// The filter that says which shape pixels have; "": they are square.
std::string shape_filter(images::Ratio pixel);
// Of a GIF also two filters: the palette of all pictures is found first.
inline constexpr const char* kFindPalette = "palettegen=stats_mode=full";
inline constexpr const char* kUsePalette = "paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle";

// For the file's container, also where streams are only copied.
std::vector<std::string> container_words(const Form& form);

// Pictures a second: people write 29.97 and mean 30000/1001.
double exact_rate(double rate);
// As ffmpeg takes them: "24", "30000/1001".
std::string rate_text(double rate);

}  // namespace mars::videos
