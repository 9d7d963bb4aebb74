// What pages show of a film or a model, as JSON (docs/studio-protocol.md, "project"): actors with their joints,
// materials, shapes. Of a film's joints only what moves them is said, and what is nothing is left out: it may have
// thousands.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "host/content/animator/pose/film.h"
#include "host/content/document/json_file.h"

namespace mars::studio {

using document::Json;

// Into `project`. `json`: the file that the film is read from.
void describe_film(Json& project, const animator::Film& film, const Json& json, std::uint32_t frame);
// Those that keys of the camera or of a light, as a film has it, change at any frame.
std::set<std::string> keyed_parts(const Json& thing);
// "camera" and "lights", with what has a key at the frame; of rig lights none.
void describe_camera_and_lights(Json& project, const animator::Film& film, const Json& json, std::uint32_t frame);
// `film`: of model_film.h. `json`: the model's.
void describe_model(Json& project, const animator::Film& film, const Json& json, std::uint32_t frame);

// Where an actor stands at the frame, and the turns of all its joints ("poses").
Json poses_of(const animator::Film& film, std::size_t actor, std::uint32_t frame);

}  // namespace mars::studio
