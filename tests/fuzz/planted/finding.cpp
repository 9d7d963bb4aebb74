// A target that has a bug, and two that have none, for driver_test.py.
#include <cstdlib>

#include "tests/fuzz/target.h"

namespace mars::fuzz::finding {

void take(std::string_view input) {
  if (input == "deadly") std::abort();
}

void take_anything(std::string_view) {}

const Target before("before", Form::text, take_anything);
const Target target("finding", Form::text, take);
const Target later("later", Form::text, take_anything);

}  // namespace mars::fuzz::finding
