// What may be varied in shapes of the library: keys of segments.
#pragma once

#include <cstddef>
#include <string_view>

#include "host/content/keys/key.h"

namespace mars::keys {

// Several numbers stand as a list; one number stands for all of them.
struct ShapeOption {
  std::string_view key;  // "": there is nothing to vary
  std::string_view what;
  std::size_t count = 1;  // of numbers
  double otherwise = 0;   // each number's default
  Range range{};
};

inline constexpr ShapeOption kTop{
    "top", "of a cone: radius of its upper end divided by that of its lower end", 1, 0, {0, 1}};
inline constexpr ShapeOption kEnds{
    "ends", "of a capsule: height of each round end divided by that of the sbb", 1, 0.25, {0.001, 0.5}};
inline constexpr ShapeOption kRim{
    "rim", "of a disc: radius of its rim divided by the width of the sbb", 1, 0.05, {0.001, 0.49}};
inline constexpr ShapeOption kEdge{
    "edge",
    "of a rounded box: radius of its edges divided by the size of the sbb, one number or one "
    "for each axis, 0.001 to 0.5",
    3,
    0.1,
    {0.001, 0.5}};
inline constexpr ShapeOption kTube{
    "tube", "of a torus: radius of its tube divided by the width of the sbb", 1, 0.125, {0.001, 0.2499}};
inline constexpr ShapeOption kLid{
    "lid", "of the teapot: width of its lid divided by that of Newell's lid", 1, 1.077, {0.1, 1.5}};

inline constexpr const ShapeOption* kShapeOptions[] = {&kTop, &kEnds, &kRim, &kEdge, &kTube, &kLid};

}  // namespace mars::keys
