// Where the camera stands and looks at a frame. Between two keys each point is where it is at the frame, and the way
// goes from one to the other; on a spline the same holds for the keys before and after.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "host/content/animator/pose/film.h"
#include "host/content/animator/pose/joint_frames.h"

namespace mars::animator {

glm::dvec3 eye_at(const Film& film, std::uint32_t frame);
glm::dvec3 at_at(const Film& film, std::uint32_t frame);

// For many frames: `frames` are the film's.
glm::dvec3 place_of(const Point& point, std::uint32_t frame, JointFrames& frames);
glm::dvec3 place_at(const Channel<Point>& points, std::uint32_t frame, JointFrames& frames);

// Whether any of them goes along with an actor.
bool follows(const Channel<Point>& points);

}  // namespace mars::animator
