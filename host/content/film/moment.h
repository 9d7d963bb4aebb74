// A film at one frame, as compile() has it there, bit for bit: for who shows and changes a film moment by moment, in
// time that does not depend on its length.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/film/compiled_film.h"
#include "host/content/film/film_writer.h"
#include "node/wire/film.h"

namespace mars::film {

// What of a film does not depend on frames: of `parts` shapes and what they are made of alone.
struct FilmShapes {
  wire::FilmData parts;
  ShapeNumbers numbers;
};

FilmShapes shapes_of(const animator::Film& film);

// One frame and one interval, in which nothing moves; without shapes, which have these numbers. Each segment has a
// matrix of its own, by its own number, and so has each bone, behind all segments.
wire::FilmData moment_of(const animator::Film& film, const ShapeNumbers& shapes, std::uint32_t frame);

// One frame of the film as a film of its own, shapes and all, in which nothing moves.
CompiledFilm compiled_moment(const animator::Film& film, std::uint32_t frame);

// The intervals that compile() cuts, and what moves in each.
struct Cut {
  std::vector<wire::Interval> intervals;
  std::vector<std::uint32_t> moving;

  // What moves in the interval that has the frame.
  std::span<const std::uint32_t> moving_at(std::uint32_t frame) const;
};

// Takes time and memory by the film's length.
Cut cut_of(const animator::Film& film, const FilmShapes& shapes);

}  // namespace mars::film
