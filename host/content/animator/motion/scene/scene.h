// What an action starts from and what comes of it: each action is a function from a Scene to a Motion.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/content/animator/keys/edit.h"
#include "host/content/animator/pose/film.h"
#include "host/content/animator/motion/scene/arguments.h"
#include "host/content/animator/motion/body/posture.h"

namespace mars::motion {

// The actor of the action, and the frame at which it begins.
struct Scene {
  const animator::Film& film;
  const animator::Actor& actor;  // of the film
  std::uint32_t at;
  const Arguments& arguments;
  std::string_view action;  // its name

  std::string where() const { return "actor '" + actor.name + "', " + std::string(action); }  // for messages
  const modeler::Model& model() const { return film.models[actor.model]; }
  double frames(double seconds) const { return seconds * film.rate; }
  // The frame that is `frames` later. Throws where a film has no such frame: to be asked before any work for it is
  // done.
  std::uint32_t last_after(double frames) const;
};

// How the actor stands when the action begins: in the world, also where another actor carries it.
Posture posture_of(const Scene& scene);

// What comes of it. Keys of what it drives make way: up to the last frame, and all later ones if the figure's
// place is driven.
struct Motion {
  std::vector<animator::ActorKey> keys;
  std::uint32_t last = 0;  // frame, as Scene::last_after() allows
  std::string report{};    // more for the person who asked: "the seat is ..."; "" if nothing
  // Of other actors, by their names: what is picked up or tossed. Later keys of what these drive make way.
  std::map<std::string, std::vector<animator::ActorKey>> others{};
};

}  // namespace mars::motion
