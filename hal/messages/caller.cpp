#include "hal/messages/caller.h"

#include "hal/messages/call_failure.h"

namespace mars::messages {

std::string rank_name(int rank, int host) { return rank == host ? "the host" : "node " + std::to_string(rank); }

void Caller::fail(const char* call, int code, const std::string& what, const std::string& remedy) const {
  throw CallFailure(code, what, rank_name(backend_.rank(), backend_.host()) + ", " + call, remedy);
}

}  // namespace mars::messages
