#include "host/content/modeler/model.h"

namespace mars::modeler {

bool is_at_or_below(std::span<const Joint> joints, std::size_t joint, std::size_t above) {
  while (joint != kNone && joint != above) joint = joints[joint].parent;
  return above != kNone && joint == above;
}

}  // namespace mars::modeler
