// Tells a host and nodes of other versions apart, by the stamps of Hello and Load (stamp.h).
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "node/wire/stamp.h"

namespace mars::wire {

// Of this program.
WireStamp own_stamp();

// Throws Failure unless `message` begins with the caller's own stamp. `sender` and `receiver` name the two
// programs: "n3 (node 17)", "the host".
void check_stamp(std::span<const std::byte> message, const std::string& sender, const std::string& receiver);

}  // namespace mars::wire
