// Says what work was done, as Backend::charge.
#pragma once

#include <cstdint>

#include "hal/messages/process.h"
#include "node/wire/work.h"

namespace mars::node {

inline void charge(wire::Work kind, std::uint64_t units) { messages::charge(static_cast<int>(kind), units); }

}  // namespace mars::node
