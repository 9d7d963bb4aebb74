// The failure of one NX call, with the number that its twin leaves in errno.
#pragma once

#include <string>
#include <utility>

#include "hal/failure/failure.h"

namespace mars::messages {

// The errors of a call: the numbers that nx_errno.h has under NX's names (hal/nx/guard.cpp compares them).
enum CallError : int {
  kMessageTooLong = 3001,  // for the receive's buffer
  kBadType = 3002,
  kNoSuchNode = 3003,
  kNoSuchPid = 3004,
  kBadLength = 3005,
  kNoSuchId = 3006,
  kNoFreeId = 3007,
  kNullBuffer = 3008,
};

class CallFailure : public Failure {
 public:
  CallFailure(int errno_code, std::string what, std::string at, std::string mend)
      : Failure(std::move(what), std::move(at), std::move(mend)), code(errno_code) {}

  int code;  // a CallError, or an errno of the system
};

}  // namespace mars::messages
