// Host and nodes check each other's stamp (stamp.h) before they use anything else that the other sends.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "node/wire/stamp.h"

namespace mars::wire {

WireStamp own_stamp();

// Whether `message` begins as every version's does from 0.2.0 on.
bool is_stamped(std::span<const std::byte> message);

// Throws Failure unless `message` begins with the caller's own stamp. `sender` and `receiver` name who sent it and who
// reads it: "n3 (node 17)", "the host".
void check_stamp(std::span<const std::byte> message, const std::string& sender, const std::string& receiver);

}  // namespace mars::wire
