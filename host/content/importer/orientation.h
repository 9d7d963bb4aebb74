// Which way a file's model is turned into MARS's axes: x forward, y to the left, z up.
#pragma once

#include <glm/mat3x3.hpp>
#include <string>

namespace mars::importer {

// Axes are "x", "y", "z", "-x", "-y" or "-z" of the file: what points up, and which way the model looks. `front` may be
// "": the file's x stays x, where that is upward its -y becomes x, where its -x is upward its y. Throws Failure where
// the two are along one axis.
glm::dmat3 orientation(const std::string& up, const std::string& front);

// The axis that the vector is along: "-y".
std::string axis_name(const glm::dvec3& vector);

}  // namespace mars::importer
