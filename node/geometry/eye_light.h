// A light as shading takes it. A plain struct: kernels of several instruction sets share it.
#pragma once

#include "node/wire/film_parts.h"

namespace mars::geometry {

// Its vector and its axis are in eye space.
using EyeLight = wire::Light;

}  // namespace mars::geometry
