// Bicubic patches of POV-Ray and RIB. The input's first word is the ending that the file gets.
#include <algorithm>

#include "host/content/importer/patches/patch_scene.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::patch_scenes {

void take(std::string_view input) {
  const std::size_t end = std::min(input.find('\n'), input.size());
  const std::string_view text = input.substr(std::min(end + 1, input.size()));
  if (input.substr(0, end) == "rib")
    importer::read_rib(scratch().file("scene.rib", text));
  else
    importer::read_pov(scratch().file("scene.pov", text));
}

const Target target("patch_scenes", Form::text, take);

}  // namespace mars::fuzz::patch_scenes
