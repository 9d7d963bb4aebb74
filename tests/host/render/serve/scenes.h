// Moments of films as a studio asks for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::test {

using Moves = std::function<bool(std::uint32_t segment)>;

// The scene block of a frame; `moves`: which segments inbetweens may move.
std::vector<std::byte> scene_of(const wire::PackedFilm& film, std::uint32_t frame, const Moves& moves);

// These segments at a frame, for the scene of another.
std::vector<wire::MovedSegment> moved_to(const wire::PackedFilm& film, std::uint32_t frame, const Moves& moves);

// Segments that move in the interval that has this frame.
Moves movers_at(const wire::PackedFilm& film, std::uint32_t frame);

}  // namespace mars::test
