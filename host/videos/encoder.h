// Pictures into one file, by one ffmpeg.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/videos/ffmpeg.h"
#include "host/videos/source.h"
#include "host/videos/video_form.h"

namespace mars::videos {

struct Span {
  std::size_t first, end;  // places of pictures
};

// Sides that the codec can have: an odd one becomes one pixel longer where it must be even.
images::PictureSize coded_size(const Form& form, images::PictureSize size);
// A line about that; "": the video is as large as its pictures.
std::string padding_text(const Form& form, images::PictureSize size, const std::filesystem::path& file);

// How ffmpeg reads the pictures from standard input.
std::vector<std::string> input_words(const Form& form, const Source& source);

// Feeds the pictures to ffmpeg, whose words begin with input_words(): reads them ahead of it where any thread may.
void feed(Ffmpeg& ffmpeg, const Form& form, const Source& source, Span span, const std::function<void()>& fed);

}  // namespace mars::videos
