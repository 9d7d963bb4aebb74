// Patch files (.bpt).
#include "host/content/modeler/patch_file.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz {

const Form kForm = Form::text;

void take(std::string_view input) { modeler::read_patch_file(scratch().file("patches.bpt", input)); }

}  // namespace mars::fuzz
