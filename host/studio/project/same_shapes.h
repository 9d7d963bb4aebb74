// Whether films have the same shapes, and segments of them: what nodes have of a film beside its scenes.
#pragma once

#include <cstddef>
#include <optional>

#include "host/content/animator/pose/film.h"

namespace mars::studio {

bool same_actors(const animator::Film& one, const animator::Film& two);  // have the same models, by their numbers
bool same_shapes(const animator::Film& one, const animator::Film& two);
bool same_segments(const modeler::Model& one, const modeler::Model& two);
bool same_shape(const modeler::Shape& one, const modeler::Shape& two);

// The one shape whose patches are in other places, as many, where all else is the same; none where nothing or more
// differs.
std::optional<std::size_t> pulled_shape(const modeler::Model& one, const modeler::Model& two);

}  // namespace mars::studio
