// Memory that one process offers to others of its machine: a file in memory, which has no place in any file system and
// no limit but the machine's memory. It is attached through /proc/PID/fd, so a process sees only those of its own user,
// user namespace and pid namespace. Files are sealed: no process can cut one short, which would end others by SIGBUS.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "hal/messages/offer.h"

namespace mars::messages {

// `bytes` zeroed bytes of rank `rank`, which others can attach as long as the block lives. Where the block is null,
// `refusal` says why.
Offer offer_file(int rank, std::size_t bytes, std::string& refusal);

// That rank's, seen as long as the result lives. nullptr where it cannot be seen, or where it is not what rank and
// bytes say: then `refusal` says why.
std::shared_ptr<std::byte> attach_file(int rank, const MemoryName& name, std::size_t bytes, std::string& refusal);

}  // namespace mars::messages
