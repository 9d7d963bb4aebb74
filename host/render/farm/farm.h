// The host's side of a rendering: has the engine draw a film on all nodes. The buffers that there are decide how many
// frames are under way: a strip whose frame has no buffer waits in its slot, and a node never has more strips in the
// host's memory than it has credits.
#pragma once

#include <cstddef>
#include <span>

#include "host/render/farm/film_run.h"

namespace mars::farm {

// The calling HAL process is the host. When all frames are with the sinks, or when it is cancelled, Stop has been sent
// to all nodes. Throws Failure when a node or a sink fails; the nodes are then still waiting, and the caller must end
// the run.
FarmReport render_film(std::span<const std::byte> film_block, const Plan& plan, const FarmOptions& options,
                       sinks::SinkPool& sinks, const FarmListener& listener);

// Where there is nothing to draw: once all nodes are there, they are stopped without a film.
void dismiss_nodes();

}  // namespace mars::farm
