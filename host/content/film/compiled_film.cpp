#include "host/content/film/compiled_film.h"

#include <algorithm>

#include "host/content/document/checksum.h"

namespace mars::film {

void CompiledFilm::visit_pieces(const std::function<void(std::span<const std::byte>)>& visit) const {
  constexpr std::size_t kPiece = std::size_t{16} << 20;
  for (std::span<const std::byte> left = block(); !left.empty();) {
    const std::size_t bytes = std::min(left.size(), kPiece);
    visit(left.first(bytes));
    left = left.subspan(bytes);
    let_pages_go(lines);
  }
}

std::string CompiledFilm::checksum() const {
  document::Checksum sum;
  visit_pieces([&](std::span<const std::byte> piece) { sum.add(piece); });
  return sum.digits();
}

CompiledFilm empty_film(bool in_file) {
  CompiledFilm film;
  film.lines = CompiledFilm::Lines(LazyMemory<CompiledFilm::Line>(in_file));
  return film;
}

}  // namespace mars::film
