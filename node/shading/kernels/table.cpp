#include "node/shading/kernels/functions.h"

namespace mars::shading::MARS_SET {

extern const ShadingKernels shading_kernels;
const ShadingKernels shading_kernels = {shade, shade_fragments, shade_unsummed, sum_up, shade_vertices};

}  // namespace mars::shading::MARS_SET
