// The failure of one NX call, with the errno that its twin leaves (nx/nx_errno.h).
#pragma once

#include <string>
#include <utility>

#include "hal/failure/failure.h"

namespace mars::hal {

class CallFailure : public Failure {
 public:
  CallFailure(int errno_code, std::string what, std::string at, std::string mend)
      : Failure(std::move(what), std::move(at), std::move(mend)), code(errno_code) {}

  int code;  // one of nx_errno.h, or of the system's
};

}  // namespace mars::hal
