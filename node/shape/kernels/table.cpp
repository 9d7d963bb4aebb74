#include "node/shape/kernels/functions.h"

namespace mars::shape::MARS_SET {

extern const ShapeKernels shape_kernels;
const ShapeKernels shape_kernels = {estimate_curvature, evaluate, move, move_skin, project};

}  // namespace mars::shape::MARS_SET
