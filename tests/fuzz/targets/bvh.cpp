// BVH files, the models and the frames of films made of them.
#include "host/content/importer/motions/bvh_file.h"
#include "host/content/importer/motions/motion_frames.h"
#include "host/content/importer/motions/skeleton_model.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::bvh {

void take(std::string_view input) {
  importer::BvhFile file = importer::read_bvh(scratch().file("motion.bvh", input));
  importer::skeleton_model(file.skeleton, "motion.bvh");
  if (file.motion.poses.empty()) return;
  importer::Motion motion = importer::at_rate(file.skeleton.joints, file.motion, file.motion.rate * 0.8);
  importer::fit_limits(file.skeleton.joints, motion);
}

const Target target("bvh", Form::text, take);

}  // namespace mars::fuzz::bvh
