// Runs of pixels put into pictures.
#pragma once

#include <cstdint>
#include <span>

#include "host/render/compositor/blocks.h"
#include "node/wire/run.h"

namespace mars::compositor {

// Copies the runs' pixels, which begin at `source`, into the picture, within which the runs lie; returns where they
// end.
const std::uint32_t* copy_runs(std::span<const wire::Run> runs, const std::uint32_t* source, const Extent& extent,
                               std::uint32_t* picture);

}  // namespace mars::compositor
