// What messages cost over MPI on this machine: starts mars-messages.
#pragma once

#include <filesystem>
#include <optional>

#include "host/experiments/message_costs.h"

namespace mars::launch {

// `self`: the running program's own file. None where MPI is not installed. Throws Failure where the job fails.
std::optional<experiments::MessageCosts> mpi_message_costs(const std::filesystem::path& self);

}  // namespace mars::launch
