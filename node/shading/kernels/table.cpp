#include "node/shading/kernels/functions.h"

namespace mars::node::MARS_SET {

extern const ShadingKernels shading_kernels;
const ShadingKernels shading_kernels = {shade};

}  // namespace mars::node::MARS_SET
