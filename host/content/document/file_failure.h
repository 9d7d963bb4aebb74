// A file that cannot be read or written, with the system's own reason: whoever can wait learns from it whether that may
// pass.
#pragma once

#include <string>
#include <utility>

#include "hal/failure/failure.h"

namespace mars::document {

class FileFailure : public Failure {
 public:
  FileFailure(std::string what, std::string where, std::string remedy, int error)
      : Failure(std::move(what), std::move(where), std::move(remedy)), error(error) {}

  int error;  // an errno
};

}  // namespace mars::document
