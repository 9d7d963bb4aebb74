// The film that `mars import --as film` writes: a model, an actor with keys, and a camera that sees all of its motion.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/content/document/json_file.h"
#include "host/content/document/long_text.h"
#include "host/content/importer/motions/skeleton.h"

namespace mars::importer {

// Of a film's actor, by frame.
struct ActorMotion {
  std::vector<glm::dvec3> places;
  std::vector<std::vector<glm::dvec3>> poses;  // by frame and joint
};

// What moves an actor, a light or the camera, as it grows: keys only where the ways between two others do not give the
// frames between them; what never moves stands beside them.
class KeyedText {
 public:
  explicit KeyedText(document::Json beside) : json_(std::move(beside)) {}

  // By frame; straight ways, true to `error` of the values' unit.
  void add(const char* name, std::vector<glm::dvec3> values, double error);
  void add_pose(const modeler::Joint& joint, std::span<const glm::dvec3> poses);

  std::size_t keys() const { return keys_.size(); }  // frames that have any
  document::Json finished() const;

 private:
  document::Json json_, pose_ = document::Json::object();
  std::map<std::uint32_t, document::Json> keys_;  // by frame
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
  std::string model_name;
  document::LongText model;  // as model files are
  document::Json camera, actor;
  document::Json lights{};                             // null: none of its own
  std::optional<std::array<std::uint32_t, 2>> size{};  // of the picture; none: as is usual
};

document::LongText film_text(FilmText film);

}  // namespace mars::importer
