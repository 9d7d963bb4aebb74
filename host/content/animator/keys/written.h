// How values stand in a film file, and how they are read back from it.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "host/content/animator/pose/ease.h"
#include "host/content/animator/pose/film.h"
#include "host/content/document/json_file.h"

namespace mars::animator {

document::Json written(double number);  // whole numbers without ".0", and no -0
document::Json written(const glm::dvec2& pair);
document::Json written(const glm::dvec3& vector);
// Three numbers, or a point of one of the film's actors.
document::Json written(const Point& point, const Film& film);
document::Json written(const Ease& ease);  // by its name, if it has one

// Of a key, as read_film accepts it.
Ease ease_of(const document::Json& key);
// Of three numbers.
glm::dvec3 vector_of(const document::Json& array);

}  // namespace mars::animator
