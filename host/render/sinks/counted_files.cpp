#include "host/render/sinks/counted_files.h"

namespace mars::sinks {
namespace {

HashedBand restore_only(const images::PictureBands& bands, compositor::Frame& frame, std::size_t band) {
  const images::Lines lines = bands.lines_of(band);
  frame.restore({lines.first, lines.end});
  return {};
}

}  // namespace

CountedFiles::CountedFiles(const images::PictureBands& bands, double part)
    : encoder_(bands, restore_only),
      file_bytes_(static_cast<std::uint64_t>(
          part * static_cast<double>(bands.words_of({0, bands.height()}) * sizeof(std::uint32_t)))) {}

void CountedFiles::take(compositor::Frame& frame) {
  ++made_.files;
  made_.encoded_bytes += encoder_.encode(frame).encoded_bytes;
  made_.file_bytes += file_bytes_;
}

}  // namespace mars::sinks
