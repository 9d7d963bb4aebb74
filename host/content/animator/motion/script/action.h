// The actions that a command or a line of a script starts: walk, turn, sit ... Each is an entry of one table,
// with its parameters, from which command line, scripts and help come.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/content/animator/keys/edit.h"
#include "host/content/animator/motion/scene/arguments.h"
#include "host/content/animator/motion/scene/parameter.h"
#include "host/content/animator/motion/scene/scene.h"

namespace mars::motion {

struct Action {
  std::string_view name;
  std::string_view purpose;
  std::string_view needs;  // limbs that the actor's model must name: "hips, ankles"; "": none, any actor can
  std::span<const Parameter> parameters;
  Motion (*perform)(const Scene& scene);
};

std::span<const Action> actions();
const Action* find_action(std::string_view name);

struct Performed {
  std::uint32_t first, last;  // frames of the actor
  std::uint32_t film_last;    // of others, too: what is tossed moves on
  std::string report;
};

// Has an actor of the film do something; the film stays as long as it is. `film` is what `json` means. Without `at` the
// action begins at the actor's last key.
Performed perform(document::Json& json, const animator::Film& film, const std::string& name, const Action& action,
                  std::optional<std::uint32_t> at, const Arguments& arguments);

}  // namespace mars::motion
