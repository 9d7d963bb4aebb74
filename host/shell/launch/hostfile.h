// A hostfile as Open MPI reads it: a line a machine, "n1 slots=4 max_slots=8  # of four cores", also "user@n1" and
// "n1 port=22 username=ada". MARS refuses beforehand what mpirun would, and nothing that it takes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "host/shell/launch/slots.h"

namespace mars::launch {

inline constexpr std::uint32_t kMostSlots = 999999;  // of one machine

// Its machines with their slots, 1 for each line that names none. None where lines are relative to an allocation (+n1):
// mpirun alone knows which machines these are. Throws Failure with the line where it is wrong.
std::vector<Slots> read_hostfile(const std::filesystem::path& hostfile);

}  // namespace mars::launch
