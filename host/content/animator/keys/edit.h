// Changes of a film file's keys, as values: nothing is read or written here, and nobody else knows how keys
// stand in a film file. `film` is what read_film accepts; read_film checks the result, too (write_json).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "host/content/animator/pose/ease.h"
#include "host/content/document/json_file.h"

namespace mars::animator {

// What carries an actor from a frame on.
struct AttachKey {
  std::string actor{};  // "": nothing
  std::string joint{};  // "": the actor itself
  glm::dvec3 place{0, 0, 0}, turn{0, 0, 0};
};

// What an actor's keys hold at one frame. What is not set is not keyed there.
struct ActorKey {
  std::uint32_t frame = 0;
  std::optional<glm::dvec3> place, turn;   // as in the film file: the world, degrees
  std::map<std::string, glm::dvec3> pose;  // joint to its three turns, degrees
  std::optional<Ease> ease;                // of what is keyed there; none: as it was, or linear
  // Slopes of splines (channel.h), of what is keyed there: "place", "turn", "/" and a joint.
  std::map<std::string, glm::dvec3> in{}, out{};
  std::optional<AttachKey> attach{};
};

// As a key of the film holds it.
document::Json written(const AttachKey& attach);

// Puts the keys, in any order, into the actor's "keys": values of the same frame are replaced, others stay. A
// still value of what is now keyed, beside the keys, becomes a key of frame 0, unless that frame is keyed.
// Throws where the film has no such actor or matrices move it; the film is then as it was.
void put_keys(document::Json& film, const std::string& actor, std::span<const ActorKey> keys);

// Takes out what the actor's keys of frames `first` to `last` hold of the same kinds as `like`: place, turn, what
// carries it, and its joints' poses.
void clear_keys(document::Json& film, const std::string& actor, std::uint32_t first, std::uint32_t last,
                const ActorKey& like);

// The film's own object for the actor.
document::Json& actor_of(document::Json& film, const std::string& actor);

// To nine digits, and 0 where there is less than 1e-9: for computed values that a person will read. It may
// round beyond a limit: clamp after it.
double rounded(double value);
glm::dvec2 rounded(const glm::dvec2& value);
glm::dvec3 rounded(const glm::dvec3& value);

}  // namespace mars::animator
