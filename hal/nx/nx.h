/* What programs of the Paragon include: the calls of cube.h, and those that the Paragon added. */
#pragma once

#include "cube.h"
#include "nx_paragon.h"
