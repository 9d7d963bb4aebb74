#include "node/shape/kernels/functions.h"

namespace mars::shape::MARS_SET {

extern const ShapeKernels shape_kernels;
const ShapeKernels shape_kernels = {estimate_curvature, evaluate, move, project};

}  // namespace mars::shape::MARS_SET
