// Where a viewer stands: the film's own camera, or one that goes around what the film is about. World: z up; models
// look along x, so "front" sees them from +x, "side" their right side from -y, "top" from above with x to the right.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "host/content/film/compile.h"
#include "host/preview/wireframe.h"
#include "node/wire/film_parts.h"

namespace mars::preview {

enum class From { camera, front, side, top };

// A camera that looks at `center` from the direction `turn` (degrees about z, 0 from +x, 90 from +y) and `height`
// (degrees above the horizon, -90..90).
struct Orbit {
  glm::dvec3 center{0, 0, 0};
  double turn = 0;
  double height = 0;
  double distance = 1;
};

// So far that the ball fills a picture of this shape (width / height). Not for From::camera.
Orbit orbit_from(From from, const Ball& subject, double aspect);

// The orbit that looks the same way as a camera, about a point before it that is as far away as the subject: it shows
// that point as large. The camera's roll is lost.
Orbit orbit_near(const wire::Camera& camera, const Ball& subject);

wire::Camera camera_of(const Orbit& orbit);

// In parallel projection: what is as far away as the center it shows as large.
wire::Camera parallel_camera_of(const Orbit& orbit);

// Where a camera of this projection and focal length stands that looks at the orbit's center and, in perspective, shows
// it as large: orbit_near()'s inverse. In parallel projection its picture must be height_of() high for that.
glm::dvec3 eye_of(const Orbit& orbit, const wire::Camera& camera);
double height_of(const Orbit& orbit);

// Plain materials in place of those that a model leaves to its film.
std::vector<animator::MaterialMotion> lent_materials(const modeler::Model& model);

// A model's turntable: the film, `frames` long, of a camera going once around it.
animator::Film turntable(modeler::Model model, const std::string& source);

// The film at another size and, if there is a camera, seen by it through all frames.
film::CompiledFilm as_seen(const film::CompiledFilm& film, std::array<std::uint32_t, 2> size,
                           const wire::Camera* camera);

}  // namespace mars::preview
