/* What programs of the Touchstone Delta include: the calls of cube.h. */
#pragma once

#include "cube.h"
