// Changes of a film file's keys: what carries an actor, and what the camera's points go along with. As keys.h: they
// change the JSON of which `meaning` was read, or throw; it is then as it was.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "host/content/animator/keys/keys.h"

namespace mars::animator {

// Where it hangs on its carrier; what is none is as it is at the frame, so that nothing jumps.
struct Hold {
  std::optional<glm::dvec3> place, turn;
};

// `to` is an actor, or an actor and its joint: "tom/right-hand".
void attach(document::Json& film, const Film& meaning, const std::string& actor, const std::string& to,
            std::uint32_t frame, const Hold& hold);
// From the frame on it stays where it is carried to then.
void detach(document::Json& film, const Film& meaning, const std::string& actor, std::uint32_t frame);

// A point of the camera: "eye" or "at".
struct Following {
  std::string part;
  // None: as "eye" is at the frame; "at" looks at the joint, or at the middle of the actor's height.
  std::optional<glm::dvec3> offset;
  bool joint_axes = false, level = false;
};

// From the frame on the point goes along with `to`; before, all stays as it is.
Remarks follow(document::Json& film, const Film& meaning, const std::string& to, std::uint32_t frame,
               const Following& following);
// From the frame on it stays where it is then.
Remarks unfollow(document::Json& film, const Film& meaning, const std::string& part, std::uint32_t frame);

}  // namespace mars::animator
