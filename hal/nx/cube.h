/* What iPSC programs include: all of NX/2. */
#pragma once

#include "nx_global.h"
#include "nx_messages.h"
