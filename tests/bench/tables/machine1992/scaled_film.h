// A film whose figures are larger or smaller in the picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/wire/film.h"

namespace mars::machine1992 {

class ScaledFilm {
 public:
  // All cameras' pictures of `film` become `scale` times as large.
  ScaledFilm(std::span<const std::byte> film, double scale);

  wire::PackedFilm view() const { return {std::as_bytes(std::span(words_)).first(size_), "scaled film", true}; }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t size_;
};

}  // namespace mars::machine1992
