// What a page has selected, and what lies under its mouse.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/studio/stage/handles.h"
#include "host/studio/stage/moments.h"
#include "host/studio/stage/picking.h"
#include "host/studio/stage/screen.h"

namespace mars::studio {

// By names, for the film may change under it.
struct Named {
  std::optional<std::string> actor{}, joint{};
  std::optional<std::string> thing{};  // "camera", "light/1"; there is no actor beside it
  std::vector<std::string> more{};     // joints beside `joint`

  bool operator==(const Named&) const = default;
};

// What there is of it.
Selection selection_of(const Project& project, const Named& named);
Named names_of(const Project& project, const Selection& selection);
// "actor", "joint" and "thing", null where there is none.
void put_names(const Project& project, const Selection& selection, Json& message);
// "elbow y 45": a joint with the angles that it can change; a mark's name.
std::string text_of(const Project& project, const Selection& selection);

// The joint, or the nearest above it that can turn; kNone where none can.
std::size_t turning_joint(const modeler::Model& model, std::size_t joint);
// The selection that a click on it makes. In a film joints can only turn: one that cannot gives way to the nearest
// above it that can, else to the actor as a whole.
Selection clicked(const Project& project, const Selection& picked);

struct Picked {
  Selection selection;
  std::optional<Hit> hit;
};

// The visible surface under the pixel, of a skin the joint that the place follows most; else the joint that is nearest
// on the screen. Of a model, what is its own.
Picked pick(const Project& project, const Moments& moments, const Screen& screen, const glm::dvec2& pixel);

}  // namespace mars::studio
