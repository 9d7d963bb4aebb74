// What may be varied in shapes of the library: keys of segments.
#pragma once

#include <cstddef>

#include "host/content/keys/key.h"

namespace mars::keys {

inline constexpr Key kTop{.name = "top",
                          .meaning = "of a cone: radius of its upper end divided by that of its lower end",
                          .number = 0,
                          .range = {0, 1},
                          .example = "0.5"};
inline constexpr Key kEnds{.name = "ends",
                           .meaning = "of a capsule: height of each round end divided by that of the sbb",
                           .number = 0.25,
                           .range = {0.001, 0.5}};
inline constexpr Key kRim{.name = "rim",
                          .meaning = "of a disc: radius of its rim divided by the width of the sbb",
                          .number = 0.05,
                          .range = {0.001, 0.49}};
inline constexpr Key kEdge{.name = "edge",
                           .type = "edge",
                           .meaning =
                               "of a rounded box: radius of its edges over the size of the sbb, one number or "
                               "one for each axis, 0.001 to 0.5",
                           .number = 0.1,
                           .range = {0.001, 0.5}};
inline constexpr Key kTube{.name = "tube",
                           .meaning = "of a torus: radius of its tube divided by the width of the sbb",
                           .number = 0.125,
                           .range = {0.001, 0.2499}};
inline constexpr Key kLid{
    .name = "lid",
    .meaning = "of the teapot: width of its lid divided by that of Newell's lid; with 1.077 the lid meets the rim",
    .number = 1.077,
    .range = {0.1, 1.5}};

inline constexpr const Key* kShapeOptions[] = {&kTop, &kEnds, &kRim, &kEdge, &kTube, &kLid};

// Of numbers, which stand as a list if they differ.
constexpr std::size_t count_of(const Key& option) { return option.type == "edge" ? 3 : 1; }

}  // namespace mars::keys
