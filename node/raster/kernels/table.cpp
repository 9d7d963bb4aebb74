#include "node/raster/kernels/functions.h"

namespace mars::raster::MARS_SET {

extern const RasterKernels raster_kernels;
const RasterKernels raster_kernels = {classify, set_up_planes, emit, draw, group, add_groups, add_background};

}  // namespace mars::raster::MARS_SET
