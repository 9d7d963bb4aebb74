#include "node/color/kernels/functions.h"

namespace mars::color::MARS_SET {

extern const ColorKernels color_kernels;
const ColorKernels color_kernels = {encode};

}  // namespace mars::color::MARS_SET
