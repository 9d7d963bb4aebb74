// A compiled film in memory: the block that nodes read (node/wire/film.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "host/content/film/lazy_memory.h"
#include "node/wire/film.h"

namespace mars::film {

// The packed block, aligned to 64 bytes, and what it does not hold.
struct CompiledFilm {
  struct alignas(64) Line {
    std::array<std::byte, 64> bytes;
  };

  using Lines = LazyVector<Line>;

  Lines lines;
  std::string source;  // file, for messages
  std::uint32_t actors = 0;
  std::uint32_t joints = 0;  // of all actors

  std::span<const std::byte> block() const { return std::as_bytes(std::span(lines)); }
  // visit(piece) for all of the block, in order.
  void visit_pieces(const std::function<void(std::span<const std::byte>)>& visit) const;
  std::string checksum() const;  // of the block
  wire::PackedFilm view() const { return {block(), source, true}; }
};

// In memory alone, or in a file (lazy_memory.h).
CompiledFilm empty_film(bool in_file);

}  // namespace mars::film
