// A film as a person describes it: settings, camera, lights, materials, models and actors with their keys;
// what a film file (docs/film-format.md) holds, with names resolved. compile.h makes the compiled film from
// it. World: right-handed, z up. Angles in degrees, colours 0..1 as shown, frames from 0.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/content/animator/pose/figure.h"
#include "host/content/modeler/model.h"

namespace mars::animator {

// Where render intervals are cut: where it saves work, or at the animator's keyframes.
enum class Cutting { automatic, keyframes };

// A point fixed in the world or, with an actor, one that goes along with it.
struct Point {
  glm::dvec3 offset{0, 0, 0};          // from the origin, or from where the actor or its joint is
  std::size_t actor = modeler::kNone;  // of the film
  std::size_t joint = modeler::kNone;  // of its model; none: the actor itself
  bool joint_axes = false;             // the offset is along the axes of the joint or the actor, else the world's
  bool level = false;                  // its height is the offset's alone

  bool operator==(const Point&) const = default;
};

struct CameraMotion {
  wire::Projection projection = wire::Projection::perspective;
  Channel<Point> eye;  // camera_points.h says where they are
  Channel<Point> at;
  Channel<glm::dvec3> up;
  Channel<double> fov;        // vertical, degrees; of perspective cameras
  Channel<double> height;     // of what the picture shows; of orthographic cameras
  Channel<glm::dvec2> shift;  // widths and heights of the picture (wire::Camera)
  Channel<double> exposure;   // stops; of linear films
  double near = 0.1;          // nothing nearer or farther is drawn
  double far = 10000;
  double interaxial = 0.065;  // between the eyes of a stereo pair
  double convergence = 5;     // how far ahead both see the same in the same place of their pictures
};

struct LightMotion {
  wire::LightKind kind = wire::LightKind::directional;
  Channel<glm::dvec3> vector;  // to the light if directional, never zero; else its place
  Channel<glm::dvec3> color;
  Channel<double> intensity;
  Channel<double> reach;     // empty if it does not fall off
  Channel<glm::dvec3> at;    // where a spot aims; of others empty
  Channel<glm::dvec2> cone;  // how wide a spot opens, degrees: fully lit within x, dark outside y; of others empty
  bool casts = false;        // shadows
  Channel<double> size;      // of what casts, how wide it is: of a directional light in degrees, else a length
};

struct MaterialMotion {
  std::string name;
  Channel<glm::dvec3> color;
  std::array<Channel<double>, modeler::kMaterialNumbers.size()> numbers;  // as in kMaterialNumbers
  wire::Material shading = modeler::default_material();                   // what is not keyed
};

// Light from all around, from above and from below.
struct Ambient {
  glm::dvec3 sky{1, 1, 1};
  glm::dvec3 ground{1, 1, 1};
};

// Along the view axis.
struct Fog {
  glm::dvec3 color;
  double start;
  double end;
};

// What carries an actor: another one, by a joint or as a whole.
struct Attachment {
  std::size_t actor;                   // of the film
  std::size_t joint = modeler::kNone;  // of its model; none: the actor itself
  glm::dvec3 place{0, 0, 0};           // in the frame of the joint or the actor
  glm::dvec3 turn{0, 0, 0};            // against it, degrees as a free joint's pose

  bool operator==(const Attachment&) const = default;
};

// A model in the film. Either `motion` moves its joints, or `matrices` its segments.
struct Actor {
  std::string name;
  std::size_t model;
  FigureMotion motion;
  Channel<std::optional<Attachment>> attach;  // each holds until the next; before the first nothing carries it
  // Of each joint, with a key at frame 0 where it has a segment; or empty.
  std::vector<Channel<modeler::Axes>> matrices;
  std::string material;  // of the film, for all segments; "": the model's
  // Else: names of the model's materials, and of the film's instead.
  std::vector<std::pair<std::string, std::string>> materials;
};

struct Film {
  std::string source;  // file, for messages
  std::uint32_t frames = 1;
  double rate = 24;
  std::uint32_t width = 960;
  std::uint32_t height = 540;
  double pixel_aspect = 1;    // width of a pixel by its height
  std::uint32_t samples = 4;  // a pixel
  wire::ColorSpace color = wire::ColorSpace::linear;
  wire::Curve curve = wire::Curve::filmic;  // of linear films
  glm::dvec3 background{0, 0, 0};
  Ambient ambient;
  std::optional<Fog> fog;
  Cutting cutting = Cutting::automatic;
  std::filesystem::path audio;  // the sound of its videos, which may be missing; "": none
  std::uint32_t dice = 0;       // 0: adaptive; N: every patch N x N quads
  CameraMotion camera;
  std::vector<LightMotion> lights;
  std::vector<MaterialMotion> materials;
  std::vector<modeler::Model> models;
  std::vector<Actor> actors;

  const modeler::Model& model_of(std::size_t actor) const { return models[actors[actor].model]; }
};

}  // namespace mars::animator
