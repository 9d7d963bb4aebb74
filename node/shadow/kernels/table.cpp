#include "node/shadow/kernels/functions.h"

namespace mars::shadow::MARS_SET {

extern const ShadowKernels shadow_kernels;
const ShadowKernels shadow_kernels = {project, put_points, set_up, find, find_below, block, touch};

}  // namespace mars::shadow::MARS_SET
