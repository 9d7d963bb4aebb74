// For ranks that SimGrid simulates: a sleep that a bell ends takes no processor.
#include "hal/mpi/patience.h"

#include <chrono>
#include <optional>

namespace mars::mpi {

void prepare_to_wait() {}

std::optional<std::chrono::microseconds> pause_of(int, bool) { return std::chrono::seconds(1); }

int turns_at_once(bool) { return 0; }

bool mpi_waits_well() { return true; }

}  // namespace mars::mpi
