// What a viewer needs of a film, computed once: for each representation of thesis 2.4 the lines of every shape or
// joint in coordinates of their own, and per frame the matrices that take them to the world, where they change.
// Values only: arrays of numbers and of numbers of others, to draw from or to send to a browser as they are.
//
// Control vertices and prisms use the compiled film's T-matrices (from the unit cube) as they stand, by the same
// numbers; so do the sticks of joints that have a segment, whose lines are therefore given in the unit cube too.
// Only joints without a segment add matrices, behind the film's.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "host/content/animator/pose/film.h"
#include "host/content/film/compile.h"
#include "host/preview/lines.h"
#include "node/wire/film.h"

namespace mars::preview {

enum class As { stick, vertices, prisms, surface };
inline constexpr std::size_t kLineRepresentations = 3;  // representations before `surface`, which the renderer draws

// A joint of a film by the numbers of its actor and, in the actor's model, of its own.
struct JointNumber {
  std::size_t actor = modeler::kNone;
  std::size_t joint = modeler::kNone;

  bool operator==(const JointNumber&) const = default;
};

// One instance of lines: numbers of `lines`, and tracks over `changes` of numbers of `matrices` and `colors`.
struct Part {
  std::uint32_t lines;
  wire::Track motion;
  wire::Track look;
  JointNumber joint{};                      // that moves it, where joints are known
  std::vector<wire::Track> bones{};         // of a skin, which move its lines instead
  wire::Blend blend = wire::Blend::linear;  // of a skin
};

// Affine map, row by row, as wire::Matrix.
using Placing = std::array<float, 12>;
Placing placing(const wire::Matrix& matrix);
Placing placing(const modeler::Axes& frame);
wire::Matrix matrix_of(const Placing& placing);

using Color = std::array<float, 3>;  // 0..1

struct Ball {
  glm::dvec3 center{0, 0, 0};
  double radius = 0;
};

struct Wireframe {
  std::uint32_t frames = 1;
  double rate = 24;  // frames a second
  std::uint32_t width = 0, height = 0;
  Color background{};
  std::vector<Lines> lines;
  std::array<std::vector<Part>, kLineRepresentations> parts;  // by As
  std::vector<Placing> matrices;
  std::vector<Color> colors;
  std::vector<wire::Camera> cameras;
  std::vector<wire::Change> changes;
  wire::Track camera{};           // numbers of `cameras`
  Ball whole;                     // holds every segment at every frame
  Ball subject;                   // around what moves, or around everything where nothing does
  bool sticks_of_prisms = false;  // a .mars file knows no joints: each stick is its prism's long axis

  // The number that a track has at `frame`.
  std::uint32_t value_at(const wire::Track& track, std::uint32_t frame) const;
  const wire::Camera& camera_at(std::uint32_t frame) const { return cameras[value_at(camera, frame)]; }
};

// `source`: what `film` was compiled from, which alone knows the joints; nullptr where that is not at hand.
Wireframe wireframe_of(const film::CompiledFilm& film, const animator::Film* source);

}  // namespace mars::preview
