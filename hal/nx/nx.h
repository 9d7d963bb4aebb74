/* What programs of the Paragon include: the calls of cube.h. */
#pragma once

#include "cube.h"
