// What a failing call tells, for tests of error messages.
#pragma once

#include <string>

#include "hal/failure/failure.h"

namespace mars::document {

// The whole message of the Failure that `call` throws; "" if it throws none.
template <typename Call>
std::string failure_of(Call call) {
  try {
    call();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

inline bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace mars::document
