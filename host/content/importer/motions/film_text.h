// The film that `mars import --as film` writes: a model, an actor with keys, and a camera that sees all of its motion.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/content/importer/motions/skeleton.h"

namespace mars::importer {

// Of a film's actor, by frame.
struct ActorMotion {
  std::vector<glm::dvec3> places;
  std::vector<std::vector<glm::dvec3>> poses;  // by frame and joint
};

struct ActorText {
  document::Json json;   // of the film's "actors"
  std::size_t keys = 0;  // frames that have any
};

// Keys only where the ways between two others do not give the frames between them, to 3e-6 of a turn's radians and
// `error` units of places; what never moves stands beside them.
ActorText actor_text(const std::string& name, std::span<const modeler::Joint> joints, const ActorMotion& motion,
                     double error);

// Sees the box whole, from the front right of a figure that looks along x.
document::Json camera_text(const glm::dvec3& least, const glm::dvec3& greatest);

struct FilmText {
  std::size_t frames = 1;
  double rate = 24;
  std::string model_name, model;  // as model files are
  document::Json camera, actor;
  document::Json lights{};  // null: none of its own
};

std::string film_text(const FilmText& film);

}  // namespace mars::importer
