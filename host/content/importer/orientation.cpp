#include "host/content/importer/orientation.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "hal/failure/failure.h"

namespace mars::importer {
namespace {

glm::dvec3 vector_of(const std::string& axis) {
  glm::dvec3 vector(0);
  vector[axis.back() - 'x'] = axis.front() == '-' ? -1 : 1;
  return vector;
}

std::string usual_front(const std::string& up) {
  if (up == "x") return "-y";
  return up == "-x" ? "y" : "x";
}

}  // namespace

std::string axis_name(const glm::dvec3& vector) {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(vector[other]) > std::abs(vector[axis])) axis = other;
  return std::string(vector[axis] < 0 ? "-" : "") + "xyz"[axis];
}

glm::dmat3 orientation(const std::string& up, const std::string& front) {
  const glm::dvec3 z = vector_of(up), x = vector_of(front.empty() ? usual_front(up) : front);
  if (glm::dot(x, z) != 0)
    throw Failure("is the axis that points up, or down", "--front " + front,
                  "choose another, or what points up with --up");
  return glm::transpose(glm::dmat3(x, glm::cross(z, x), z));
}

}  // namespace mars::importer
