#include "host/content/importer/gltf_limbs.h"

#include <nlohmann/json.hpp>

#include "host/content/modeler/joint.h"

namespace mars::importer {
namespace {

struct BoneOfVrm {
  const char* bone;
  const char* limb;
};

// github.com/vrm-c/vrm-specification, VRMC_vrm-1.0, humanoid: the bones that MARS has limbs for. The chest follows from
// the arms.
constexpr BoneOfVrm kBones[] = {{"hips", "pelvis"},
                                {"neck", "neck"},
                                {"head", "head"},
                                {"leftUpperLeg", "left.hip"},
                                {"leftLowerLeg", "left.knee"},
                                {"leftFoot", "left.ankle"},
                                {"leftToes", "left.toes"},
                                {"leftUpperArm", "left.shoulder"},
                                {"leftLowerArm", "left.elbow"},
                                {"leftHand", "left.wrist"},
                                {"rightUpperLeg", "right.hip"},
                                {"rightLowerLeg", "right.knee"},
                                {"rightFoot", "right.ankle"},
                                {"rightToes", "right.toes"},
                                {"rightUpperArm", "right.shoulder"},
                                {"rightLowerArm", "right.elbow"},
                                {"rightHand", "right.wrist"}};

// VRM 0 has a list of {bone, node}, VRM 1 an object of bones with their nodes.
std::size_t node_of(const Tree& bones, const char* bone) {
  if (bones.is_object()) return number(at(at(bones, bone), "node"), modeler::kNone);
  for (const Tree& each : bones)
    if (at(each, "bone") == bone) return number(at(each, "node"), modeler::kNone);
  return modeler::kNone;
}

}  // namespace

std::optional<LimbMap> limb_map(const Tree& gltf) {
  for (const char* extension : {"VRMC_vrm", "VRM"}) {
    const Tree& bones = at(at(at(at(gltf, "extensions"), extension), "humanoid"), "humanBones");
    LimbMap map{"map of " + std::string(extension) + " in the file", {}};
    for (const BoneOfVrm& each : kBones)
      if (const std::size_t node = node_of(bones, each.bone); node != modeler::kNone)
        map.limbs.emplace_back(each.limb, node);
    if (!map.limbs.empty()) return map;
  }
  return std::nullopt;
}

}  // namespace mars::importer
