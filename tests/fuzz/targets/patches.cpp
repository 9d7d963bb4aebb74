// Patch files (.bpt).
#include "host/content/modeler/patch_file.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::patches {

void take(std::string_view input) { modeler::read_patch_file(scratch().file("patches.bpt", input)); }

const Target target("patches", Form::text, take);

}  // namespace mars::fuzz::patches
