// A film's light, from what a person picked: colours as they are shown become light where the film is linear. An ease
// that overshoots leaves everything within what a compiled film may hold.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "host/content/animator/pose/film.h"
#include "host/content/film/track_writer.h"
#include "node/wire/film.h"

namespace mars::film {

// What a colour is in the film's colour space.
std::array<float, 3> light_of(const glm::dvec3& color, wire::ColorSpace space);

// The colour that the light is shown as, without exposure and curve: light_of's inverse.
std::array<float, 3> shown_of(const std::array<float, 3>& light, wire::ColorSpace space);

// Samples, colour space, curve, background, ambient light and fog.
void write_light_settings(const animator::Film& film, wire::FilmSettings& settings);

// Adds the lights and their tracks.
void write_lights(const animator::Film& film, WrittenFrames frames, wire::FilmData& data);

}  // namespace mars::film
