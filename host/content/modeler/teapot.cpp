#include "host/content/modeler/teapot.h"

#include "host/content/modeler/teapot_data.h"

namespace mars::modeler {
namespace {

bool is_lid(std::size_t patch) { return patch >= 20 && patch < 28; }

}  // namespace

std::vector<wire::Patch> make_teapot(double lid) {
  std::vector<wire::Patch> patches(kTeapotPatches.size());
  for (std::size_t number = 0; number < patches.size(); ++number)
    for (std::size_t i = 0; i < 16; ++i) {
      const auto& point = kTeapotPoints[kTeapotPatches[number][i]];
      for (int axis = 0; axis < 3; ++axis) {
        const double wide = is_lid(number) && axis < 2 ? lid * point[axis] : point[axis];
        const double extent = kTeapotBounds.max[axis] - kTeapotBounds.min[axis];
        patches[number].points[i][axis] = static_cast<float>((wide - kTeapotBounds.min[axis]) / extent);
      }
    }
  return patches;
}

}  // namespace mars::modeler
