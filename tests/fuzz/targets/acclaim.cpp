// ASF files and AMC files: the skeleton, a line of four dots, and its motion.
#include <algorithm>

#include "host/content/importer/motions/asf_file.h"
#include "host/content/importer/motions/motion_frames.h"
#include "host/content/importer/motions/skeleton_model.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::acclaim {

void take(std::string_view input) {
  constexpr std::string_view kBetween = "....\n";
  const std::size_t between = std::min(input.find(kBetween), input.size());
  importer::AsfFile asf = importer::read_asf(scratch().file("bones.asf", input.substr(0, between)));
  importer::skeleton_model(asf.skeleton, "bones.asf");
  if (between == input.size()) return;
  const auto path = scratch().file("motion.amc", input.substr(between + kBetween.size()));
  importer::Motion motion = importer::at_rate(asf.skeleton.joints, importer::read_amc(path, asf, 120), 50);
  importer::fit_limits(asf.skeleton.joints, motion);
}

const Target target("acclaim", Form::text, take);

}  // namespace mars::fuzz::acclaim
