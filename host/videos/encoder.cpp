#include "host/videos/encoder.h"

#include <algorithm>
#include <deque>
#include <future>
#include <span>

#include "hal/failure/failure.h"
#include "topology/processor_limit.h"

namespace mars::videos {
namespace {

constexpr int kMostReaders = 8;

std::string size_text(images::PictureSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

// Its last column and row are repeated: a seam of any colour would be seen.
void pad(images::Image& image, images::PictureSize size) {
  images::Image padded{size.width, size.height, {}};
  padded.pixels.reserve(std::size_t{size.width} * size.height);
  for (std::uint32_t y = 0; y < size.height; ++y) {
    const auto line = image.pixels.begin() + std::ptrdiff_t{image.width} * std::min(y, image.height - 1);
    padded.pixels.insert(padded.pixels.end(), line, line + image.width);
    padded.pixels.resize(std::size_t{size.width} * (y + 1), line[image.width - 1]);
  }
  image = std::move(padded);
}

Picture coded_picture(const Source& source, std::size_t place, images::PictureSize size) {
  Picture picture = source.picture(place);
  check(picture && images::PictureSize{picture->width, picture->height} == source.size, "pictures have one size");
  if (size == source.size) return picture;
  images::Image padded = *picture;
  pad(padded, size);
  return std::make_shared<const images::Image>(std::move(padded));
}

}  // namespace

images::PictureSize coded_size(const Form& form, images::PictureSize size) {
  if (!form.codec->needs_even_sides) return size;
  return {size.width + size.width % 2, size.height + size.height % 2};
}

std::string padding_text(const Form& form, images::PictureSize size, const std::filesystem::path& file) {
  const images::PictureSize coded = coded_size(form, size);
  if (coded == size) return "";
  const bool column = coded.width != size.width, row = coded.height != size.height;
  return file.string() + " has " + size_text(coded) + " pixels, because " + std::string(form.codec->name) +
         " needs even sides: the last " + (column ? "column" : "") + (column && row ? " and " : "") +
         (row ? "row" : "") + (column && row ? " are" : " is") + " repeated";
}

std::vector<std::string> input_words(const Form& form, const Source& source) {
  return {"-v",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb0",
          "-s",
          size_text(coded_size(form, source.size)),
          "-framerate",
          rate_text(source.rate),
          "-i",
          "-"};
}

void feed(Ffmpeg& ffmpeg, const Form& form, const Source& source, Span span, const std::function<void()>& fed) {
  const images::PictureSize size = coded_size(form, source.size);
  const std::size_t ahead = source.any_thread ? std::min(topology::usable_processors(), kMostReaders) : 1;
  const auto policy = source.any_thread ? std::launch::async : std::launch::deferred;
  std::deque<std::future<Picture>> read;
  std::size_t next = span.first;
  for (std::size_t place = span.first; place < span.end; ++place) {
    for (; next < span.end && read.size() < ahead; ++next)
      read.push_back(std::async(policy, [&source, next, size] { return coded_picture(source, next, size); }));
    const Picture picture = read.front().get();
    read.pop_front();
    ffmpeg.feed(std::as_bytes(std::span(picture->pixels)));
    if (fed) fed();
  }
}

}  // namespace mars::videos
