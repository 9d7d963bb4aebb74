// The end of summing up light, in plain code: the twin of ShadingKernels::sum_up, for a few samples.
#pragma once

#include "node/shading/shading.h"

namespace mars::shading {

// Mixes fog into light by `share` of it, and bounds it.
void finish_light(const Shading& shading, float share, float (&light)[3]);

}  // namespace mars::shading
