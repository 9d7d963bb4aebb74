// Controls over a picture, where the view's camera shows them: rings about a joint's free axes with its limits, arrows,
// a box to pull, control points. The page draws them; a hand takes them (hand.h).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/content/animator/pose/actor_state.h"
#include "host/studio/project/project.h"
#include "host/studio/stage/screen.h"
#include "host/studio/stage/selected.h"

namespace mars::studio {

enum class Tool { none, turn, move, box, points, reach };
inline constexpr const char* kTools[] = {"none", "turn", "move", "box", "points", "reach"};

// Rings turn about each of the three numbers of a pose, within its limits; the joint's own axes as they stand;
// its parent's; the world's. Rings of a joint with at most one freedom are by its number, whatever is chosen.
enum class RingAxes { numbers, joint, parent, world };
inline constexpr const char* kRingAxes[] = {"numbers", "joint", "parent", "world"};
RingAxes ring_axes_of(const modeler::Joint& joint, RingAxes chosen);
// Whether the joint has a ring about the axis (0 x, 1 y, 2 z).
bool has_ring(const modeler::Joint& joint, int axis, RingAxes chosen);

// What a hand takes hold of.
struct Grip {
  enum class What { ring, arrow, plane, face, point, size } what;
  int axis = 0;           // ring, arrow, face: x, y, z
  int side = 0;           // face: 0 lower, 1 upper
  std::size_t patch = 0;  // point
  std::size_t i = 0, j = 0;
  // Of a mark: arrow and plane move it, or what it aims at; size is its field of view, cone or reach.
  std::optional<Mark> mark{};
  bool aim = false;

  bool operator==(const Grip&) const = default;
};

// One line or place on the screen. A control may have several of the same id.
struct Handle {
  std::string id;
  const char* kind;  // docs/studio-protocol.md
  Polyline points;
  std::string axis{};  // "x", "y", "z" or ""
  std::string text{};
  std::optional<Grip> grip{};  // none: only to be seen
  bool selected = false;
  bool fine = true;  // to a hundredth of a pixel, else to a tenth: of many
};

// An axis about which a pose turns.
struct TurnAxis {
  glm::dvec3 center;
  glm::dvec3 axis;              // a unit vector; of a number, as turned by the numbers before it
  glm::dvec3 zero;              // across it: where the ring's angle is 0
  std::optional<double> angle;  // degrees, of a number
  modeler::Limits limits;       // of a number
};

// A joint's, or a whole actor's, as it stands.
struct Posed {
  const modeler::Joint* joint;  // animator::free_joint() for an actor as a whole
  modeler::Axes parent;         // the frame in which the joint's place and turn are
  glm::dvec3 center;            // in the world
  glm::dvec3 pose;

  TurnAxis axis(int number, RingAxes axes = RingAxes::numbers) const;
};

// None: nothing is selected, or matrices move the actor.
std::optional<Posed> posed(const Project& project, const Selection& selection);

// The frame of the joint's segment, from its sbb to the world; none where it has no segment.
std::optional<modeler::Axes> segment_frame_of(const Project& project, const Selection& selection);

// From the unit cube to the world: of a control point of the joint's segment, whose bones it may follow.
wire::Matrix matrix_of_point(const modeler::Model& model, std::size_t joint, const animator::ActorState& state,
                             const Grip& point);

std::vector<Handle> handles_of(const Project& project, const Selection& selection, Tool tool, RingAxes axes,
                               const Screen& screen);

// The radius of the ring about an axis, as it is seen from before.
double ring_pixels(int axis);

// The handle under the pixel that a hand would take.
const Handle* handle_at(const std::vector<Handle>& handles, const glm::dvec2& pixel);
const Handle* handle_at(const std::vector<Handle>&&, const glm::dvec2&) = delete;

// As the page reads them: what is empty or false is left out. `hot`: the id under the mouse.
Json described(const std::vector<Handle>& handles, const std::string& hot);

}  // namespace mars::studio
