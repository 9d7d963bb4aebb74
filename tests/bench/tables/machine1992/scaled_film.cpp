#include "tests/bench/tables/machine1992/scaled_film.h"

#include <cstring>

namespace mars::machine1992 {

ScaledFilm::ScaledFilm(std::span<const std::byte> film, double scale)
    : words_((film.size() + 7) / 8), size_(film.size()) {
  const auto block = std::as_writable_bytes(std::span(words_));
  std::memcpy(block.data(), film.data(), size_);
  const auto cameras = view().cameras();
  auto at = static_cast<std::size_t>(std::as_bytes(cameras).data() - block.data());
  for (wire::Camera camera : cameras) {
    camera.focal *= scale;
    std::memcpy(block.data() + at, &camera, sizeof(camera));
    at += sizeof(camera);
  }
}

}  // namespace mars::machine1992
