// Platform files.
#include "host/experiments/platform.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::platform {

void take(std::string_view input) {
  experiments::read_platform(scratch().file("platform.json", input), scratch().path(""));
}

const Target target("platform", Form::text, take);

}  // namespace mars::fuzz::platform
