#include "host/content/animator/pose/check_pictures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "host/content/animator/pose/camera_points.h"
#include "host/content/animator/pose/worn_materials.h"
#include "host/content/document/shell_word.h"
#include "host/content/document/text.h"
#include "host/content/elementary/elementary.h"

namespace mars::animator {
namespace {

bool casts_shadows(const Film& film) { return std::ranges::any_of(film.lights, &LightMotion::casts); }

// "material/oak", "actor 'tom', material 'skin'" of its model.
std::string name_of(const Actor& actor, const WornMaterial& worn) {
  return worn.of_film ? "material/" + worn.of_film->name
                      : "actor '" + actor.name + "', material '" + worn.of_model->name + "'";
}

// Nodes light others at corners of triangles or once a triangle, which would not show where a shadow ends.
bool fails_to_receive(const wire::Material& shading) {
  return shading.receives && shading.interpolation != wire::Interpolation::phong;
}

void find_unreceived_shadows(const Film& film, std::vector<std::string>& lines) {
  const WornMaterials materials(film);
  std::set<const void*> seen;
  for (const Actor& actor : film.actors)
    for (const modeler::Joint& joint : film.models[actor.model].joints) {
      const auto worn = joint.segment ? materials.of(actor, joint.segment->material) : std::nullopt;
      if (!worn || (!worn->of_film && !worn->of_model)) continue;
      const wire::Material& shading = worn->of_film ? worn->of_film->shading : worn->of_model->material;
      if (!fails_to_receive(shading) || !seen.insert(&shading).second) continue;
      lines.push_back(name_of(actor, *worn) + ": no shadow falls on it, because its interpolation is " +
                      std::string(modeler::word_of(shading.interpolation)) +
                      " (make that phong, or set receives=false)");
    }
}

void find_unused_sizes(const Film& film, std::vector<std::string>& lines) {
  const auto is_wide = [](const Key<double>& size) { return size.value > 0; };
  for (std::size_t i = 0; i < film.lights.size(); ++i)
    if (!film.lights[i].casts && std::ranges::any_of(film.lights[i].size, is_wide))
      lines.push_back("light/" + std::to_string(i + 1) +
                      ": its size has no effect, because it casts no shadows (set shadow=true, or size=0)");
}

constexpr double kSeenOff = 1.0 / 400;             // of the picture's height
constexpr double kDepthError = 1.0 / (1 << 23);    // of depths, and so of where shadows begin: node/shadow/light_view.h
constexpr double kNearPart = 1e-3, kFarPart = 10;  // of the distance to what is seen: planes that do no harm

// The place that the camera looks at, in a frame.
struct Look {
  std::uint32_t frame = 0;
  double away = 0;    // distance
  double height = 0;  // of the picture there
  double off = 0;     // of a shadow from what casts it

  double part_off() const { return height > 0 ? off / height : 0; }
};

bool is_parallel(const CameraMotion& camera) { return camera.projection == wire::Projection::orthographic; }

Look look_at(const Film& film, std::uint32_t frame, JointFrames& joints) {
  const CameraMotion& camera = film.camera;
  const double away = glm::length(place_at(camera.at, frame, joints) - place_at(camera.eye, frame, joints));
  if (is_parallel(camera)) return {frame, away, value_at(camera.height, frame), camera.far * kDepthError};
  const double view = camera.projection == wire::Projection::panorama ? 90 : value_at(camera.fov, frame);
  return {frame, away, 2 * away * elementary::tan(view * std::numbers::pi / 360),
          away * away * kDepthError / camera.near};
}

// One for each key.
std::vector<Look> looks_of(const Film& film) {
  JointFrames joints(film);
  std::vector<Look> looks{look_at(film, 0, joints)};
  for (const Channel<Point>* points : {&film.camera.eye, &film.camera.at})
    for (const auto& key : *points)
      if (key.frame < film.frames) looks.push_back(look_at(film, key.frame, joints));
  return looks;
}

std::string roughly(double number) { return document::shown(document::rounded_to(number, 2)); }

std::string place_of(const Look& look) {
  return "where it looks in frame " + std::to_string(look.frame) + ", " + roughly(look.away) + " away";
}

// Nothing nearer than `near` or farther than `far` is drawn.
std::string plane_text(const Film& film, const char* key, double plane, double better) {
  return "its " + std::string(key) + " is " + document::shown(plane) + " (fix it with: mars film " +
         document::shell_word(film.source) + " camera " + key + "=" + roughly(better) + ")";
}

std::string cut_text(const Film& film, const Look& nearest, const Look& farthest) {
  const CameraMotion& camera = film.camera;
  if (nearest.away > 0 && nearest.away < camera.near)
    return "camera: nothing is drawn " + place_of(nearest) + ": " +
           plane_text(film, "near", camera.near, nearest.away * kNearPart);
  if (farthest.away > camera.far)
    return "camera: nothing is drawn " + place_of(farthest) + ": " +
           plane_text(film, "far", camera.far, farthest.away * kFarPart);
  return "";
}

// A near plane with which shadows stand off half as far as is seen, and that cuts away nothing that is looked at.
double near_for(const CameraMotion& camera, const Look& nearest, const Look& worst) {
  const double enough = 2 * camera.near * worst.part_off() / kSeenOff;
  return document::rounded_to(std::min(std::max(worst.away * kNearPart, enough), nearest.away / 2), 2);
}

// Nothing where no plane is better.
std::string detached_text(const Film& film, const Look& nearest, const Look& worst) {
  const CameraMotion& camera = film.camera;
  if (!casts_shadows(film) || worst.part_off() < kSeenOff) return "";
  const std::string text =
      "camera: shadows begin " + roughly(worst.off) + " away from what casts them " + place_of(worst) + ": ";
  if (is_parallel(camera)) {
    const double far = worst.away * kFarPart;
    return far < camera.far ? text + plane_text(film, "far", camera.far, far) : "";
  }
  const double near = near_for(camera, nearest, worst);
  return near > camera.near ? text + plane_text(film, "near", camera.near, near) : "";
}

}  // namespace

void find_lost_shadows(const Film& film, std::vector<std::string>& lines) {
  if (casts_shadows(film)) find_unreceived_shadows(film, lines);
  find_unused_sizes(film, lines);
}

void find_unfit_planes(const Film& film, std::vector<std::string>& lines) {
  const std::vector<Look> looks = looks_of(film);
  const auto [nearest, farthest] = std::ranges::minmax_element(looks, {}, &Look::away);
  const auto worst = std::ranges::max_element(looks, {}, &Look::part_off);
  for (const std::string& line : {cut_text(film, *nearest, *farthest), detached_text(film, *nearest, *worst)})
    if (!line.empty()) lines.push_back(line);
}

}  // namespace mars::animator
