// The film's camera and lights as things in a view: symbols with what the camera sees, where lights shine, and what
// pulls them (docs/studio-protocol.md, "Marks"). Rig lights are none.
#pragma once

#include <string>
#include <vector>

#include "host/studio/stage/handles.h"
#include "host/studio/stage/moments.h"
#include "host/studio/stage/screen.h"

namespace mars::studio {

// One mark as it stands at the frame.
struct MarkState {
  glm::dvec3 place;                 // the eye, or where the light's symbol stands
  std::optional<glm::dvec3> aim{};  // a camera's or spot's
  glm::dvec3 side{1, 0, 0};         // unit vectors: across its axis, to which its size is pulled
  glm::dvec3 up{0, 0, 1};
  double angle = 0;        // field of view or outer cone, degrees; 0: it has none
  double height = 0;       // of what an orthographic camera shows; 0: it is none
  glm::dvec2 shift{0, 0};  // a camera's
  double inner = 0;        // cone
  double reach = 0;        // 0: it has none
  bool far = false;        // a direction: its symbol stands on this side of `center`
  glm::dvec3 center{0, 0, 0};
};

// Whether the film has it.
bool there_is(const Project& project, const Mark& mark);
MarkState state_of(const Project& project, const Moments& moments, const Mark& mark);

// "camera", "light/1", and back; none: no such name.
std::string name_of(const Mark& mark);
std::optional<Mark> mark_named(const std::string& name);

// All there are. What the selected one has more, arrows included, is seen in every tool but these are not in `none`.
std::vector<Handle> marks_of(const Project& project, const Moments& moments, const Selection& selection, Tool tool,
                             const Screen& screen);

}  // namespace mars::studio
