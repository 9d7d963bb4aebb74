// Where a view looks from: the film's own camera, or an orbit of the preview (host/preview/viewpoint.h). Front, side
// and top are parallel projections.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "host/preview/viewpoint.h"
#include "node/wire/film_parts.h"

namespace mars::studio {

enum class From { front, side, top, free, camera };
inline constexpr const char* kFroms[] = {"front", "side", "top", "free", "camera"};

struct Eye {
  From from = From::free;
  preview::Orbit orbit{};  // not of From::camera
};

// All of the subject, in a picture of this shape (width / height).
preview::Orbit chosen_orbit(From from, const preview::Ball& subject, double aspect);

// From where it looks already, all of the subject.
void show_whole(preview::Orbit& orbit, const preview::Ball& subject, double aspect);

// The eye's camera, not of From::camera, with the film's exposure.
wire::Camera camera_from(const Eye& eye, double exposure);

// By pixels of a mouse in a picture of this height, right and down; zoom by a wheel's, about the spot at these pixels
// from the picture's middle.
void turn(preview::Orbit& orbit, const glm::dvec2& by);
void pan(preview::Orbit& orbit, const glm::dvec2& by, double height);
void zoom(preview::Orbit& orbit, const glm::dvec2& by, const glm::dvec2& spot, double height);

}  // namespace mars::studio
