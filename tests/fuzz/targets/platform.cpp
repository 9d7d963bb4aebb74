// Platform files.
#include "host/experiments/platform.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz {

const Form kForm = Form::text;

void take(std::string_view input) {
  experiments::read_platform(scratch().file("platform.json", input), scratch().path(""));
}

}  // namespace mars::fuzz
