// A target that has a bug, for driver_test.py.
#include <cstdlib>

#include "tests/fuzz/target.h"

namespace mars::fuzz {

const Form kForm = Form::text;

void take(std::string_view input) {
  if (input == "deadly") std::abort();
}

}  // namespace mars::fuzz
