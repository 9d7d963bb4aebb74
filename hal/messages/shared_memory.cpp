#include "hal/messages/shared_memory.h"

#include "hal/messages/process.h"

namespace mars::messages {

Neighbourhood neighbourhood() { return process().backend().neighbourhood(); }

SharedMemory::SharedMemory(std::size_t bytes) : block_(process().backend().share(bytes)), size_(bytes) {}

}  // namespace mars::messages
