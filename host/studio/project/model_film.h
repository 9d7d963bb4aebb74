// The film in which a model stands alone: actor "model", lit and seen as `mars preview MODEL` begins, and actor
// "ground", a disc under it that is seen from above only.
#pragma once

#include "host/content/animator/pose/film.h"

namespace mars::studio {

inline constexpr std::size_t kModelActor = 0;  // and the number of its model

animator::Film film_of_model(modeler::Model model, const std::string& source);

// Another model in such a film, at rest. Camera, lights and ground stay.
void exchange_model(animator::Film& film, modeler::Model& model);

// Whether camera and ground suit the model: it stands on the ground, and has about the size that they were made for.
bool suits(const animator::Film& film, const modeler::Model& model);

}  // namespace mars::studio
