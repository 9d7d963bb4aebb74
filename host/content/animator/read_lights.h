// Lights of a film file, and its light from all around.
#pragma once

#include <string_view>
#include <vector>

#include "host/content/animator/film.h"
#include "host/content/document/fields.h"

namespace mars::animator {

inline constexpr std::string_view kLightNames[] = {"direction", "place", "at",        "cone",
                                                   "reach",     "color", "intensity", "keys"};
inline constexpr std::string_view kLightKeyNames[] = {"frame", "direction", "place",     "at",  "cone",
                                                      "reach", "color",     "intensity", "ease"};
inline constexpr std::string_view kAmbientNames[] = {"sky", "ground"};
inline constexpr std::string_view kFogNames[] = {"color", "start", "end"};
inline constexpr document::Keys kLightKeys{"light", kLightNames};
inline constexpr document::Keys kLightKeyKeys{"light_key", kLightKeyNames};
inline constexpr document::Keys kAmbientKeys{"ambient", kAmbientNames};
inline constexpr document::Keys kFogKeys{"fog", kFogNames};

inline constexpr std::size_t kMostLights = 64;
inline constexpr document::Range kIntensities{0, 1000};
inline constexpr document::Range kReaches{1e-6, document::kFarthest};
inline constexpr document::Range kCones{0.01, 180};  // degrees

std::vector<LightMotion> read_lights(const document::Element& list);

// One colour, or one from above and one from below.
Ambient read_ambient(const document::Element& element);

// Without a colour it has that of the background.
Fog read_fog(const document::Element& element, const glm::dvec3& background);

}  // namespace mars::animator
