// What readers make of a surface of patches.
#pragma once

#include <optional>
#include <vector>

#include "host/content/modeler/control_net.h"

namespace mars::modeler {

struct PatchShape {
  std::vector<wire::Patch> patches;  // never none
  std::optional<ControlNet> net{};   // of a skin
};

}  // namespace mars::modeler
