#include "host/studio/thumbnails/thumbnail_film.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <span>

#include "host/content/animator/keys/written.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/animator/settings/cast.h"
#include "host/content/animator/settings/film_settings.h"
#include "host/content/document/document.h"
#include "host/content/document/json_file.h"
#include "host/content/film/compile.h"
#include "host/content/modeler/figure_library.h"
#include "host/preview/wireframe.h"

namespace mars::studio {
namespace {

using document::Json;

constexpr double kDegrees = 24;                // that the camera sees
const glm::dvec3 kToCamera(0.86, -0.5, 0.24);  // from the model, which looks along x
const glm::dvec3 kAway(0, 0, -1e5);            // where no camera sees it

Json empty_film() {
  Json film = animator::new_film();
  film["frames"] = 1;
  film["size"] = {kThumbnailSize, kThumbnailSize};
  film["samples"] = 4;
  film["camera"] = {{"eye", {14, -8, 4.5}}, {"at", {0, 0, 2.3}}, {"fov", kDegrees}};
  return film;
}

preview::Ball ball_of(const std::string& name) {
  Json json = empty_film();
  animator::add_actor(json, {name, name, glm::dvec3(0)});
  const document::Document document(document::laid_out(json), name);
  const animator::Film film = animator::read_film(document.root(), "");
  return preview::wireframe_of(film::compile(film), &film).whole;
}

Json camera_key(std::size_t frame, const preview::Ball& ball) {
  const double distance = ball.radius / std::sin(glm::radians(kDegrees / 2));
  const glm::dvec3 eye = ball.center + distance * glm::normalize(kToCamera);
  return {{"frame", frame}, {"eye", animator::written(eye)}, {"at", animator::written(ball.center)}};
}

// There at its own frame alone.
Json place_keys(std::size_t frame) {
  Json keys = Json::array();
  if (frame > 0) keys.push_back({{"frame", frame - 1}, {"place", animator::written(kAway)}});
  keys.push_back({{"frame", frame}, {"place", {0, 0, 0}}});
  keys.push_back({{"frame", frame + 1}, {"place", animator::written(kAway)}});
  return keys;
}

}  // namespace

ThumbnailFilm thumbnail_film() {
  ThumbnailFilm made;
  for (const auto library : {modeler::figure_library(), modeler::object_library()})
    for (const modeler::LibraryFigure& each : library) made.names.emplace_back(each.name);
  Json film = empty_film(), keys = Json::array();
  film["frames"] = made.names.size();
  for (std::size_t frame = 0; frame < made.names.size(); ++frame) {
    const std::string& name = made.names[frame];
    animator::add_actor(film, {name, name, glm::dvec3(0)});
    film["actors"].back()["keys"] = place_keys(frame);
    keys.push_back(camera_key(frame, ball_of(name)));
  }
  film["camera"]["keys"] = std::move(keys);
  animator::light_new_film(film, "thumbnails.json");
  film["lights"][0].erase("shadow");
  made.text = document::laid_out(film);
  return made;
}

}  // namespace mars::studio
