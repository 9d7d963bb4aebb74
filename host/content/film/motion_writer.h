// The T-matrices of all actors over all frames: only those that differ from the frame before. They are written
// where the compiled film keeps them, by several threads, each an actor at a time; the result is the same for
// any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>

#include "host/content/animator/pose/film.h"
#include "host/content/film/compiled_film.h"
#include "node/wire/film.h"

namespace mars::film {

// Gives the segments of `data`, which are those of all actors in order, and their bones their motion; `lines` becomes
// the memory of the block's header and the matrices. Returns the number of matrices. Throws, before any is made, where
// there are more than memory holds; and where a segment stands too far out.
std::size_t write_motion(const animator::Film& film, wire::FilmData& data, CompiledFilm::Lines& lines);

// Throws where the segment of the actor's joint stands farther out than a compiled film may say.
void check_near(const wire::Matrix& matrix, const animator::Film& film, std::size_t actor, std::size_t joint,
                std::uint32_t frame);

// Throws where dual quaternions blend the segment's skin and a bone of it, whose T-matrix this is, has no volume.
void check_volume(const wire::Matrix& matrix, const animator::Film& film, std::size_t actor, std::size_t joint,
                  const modeler::Bone& bone, std::uint32_t frame);

}  // namespace mars::film
