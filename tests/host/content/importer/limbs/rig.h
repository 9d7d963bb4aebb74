// Figures as bones alone, for tests: a person of 1.8 m who looks along x, left along y, z up.
#pragma once

#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <vector>

#include "host/content/importer/limbs/figure_tree.h"

namespace mars::importer {

enum class ArmsAtRest { hang, a_pose, t_pose, bent };

struct Rig {
  FigureTree tree;
  std::map<std::string, std::size_t> joints;  // by limb, and others by what they are

  std::size_t add(const std::string& what, const std::string& parent, const glm::dvec3& place) {
    tree.push_back({what, parent.empty() ? modeler::kNone : joints.at(parent), place});
    return joints[what] = tree.size() - 1;
  }
};

inline glm::dvec3 arm_direction(ArmsAtRest arms, double side) {
  if (arms == ArmsAtRest::hang) return {0, 0, -1};
  return glm::normalize(glm::dvec3(0, side, arms == ArmsAtRest::t_pose ? 0 : -1));
}

// With collar bones, joints in the thighs that twist them, and fingers; names say which joint it is.
inline Rig person(ArmsAtRest arms) {
  Rig rig;
  rig.add("root", "", {0, 0, 0});
  rig.add("pelvis", "root", {0, 0, 0.95});
  rig.add("spine", "pelvis", {0, 0, 1.05});
  rig.add("rib", "spine", {0, 0, 1.2});
  rig.add("chest", "rib", {0, 0, 1.35});
  rig.add("neck", "chest", {0, 0, 1.5});
  rig.add("head", "neck", {0.01, 0, 1.6});
  rig.add("top", "head", {0.02, 0, 1.8});
  for (const double s : {1.0, -1.0}) {
    const std::string side = s > 0 ? "left." : "right.";
    rig.add(side + "hip", "pelvis", {0, 0.1 * s, 0.92});
    rig.add(side + "twist", side + "hip", {0, 0.1 * s, 0.7});
    rig.add(side + "knee", side + "twist", {0, 0.1 * s, 0.5});
    rig.add(side + "ankle", side + "knee", {0, 0.1 * s, 0.08});
    rig.add(side + "toes", side + "ankle", {0.13, 0.1 * s, 0.02});
    rig.add(side + "tip", side + "toes", {0.2, 0.1 * s, 0.02});
    const glm::dvec3 shoulder(0, 0.18 * s, 1.45), along = arm_direction(arms, s);
    const glm::dvec3 fore = arms == ArmsAtRest::bent ? glm::normalize(along + glm::dvec3(0, -0.9 * s, 0)) : along;
    rig.add(side + "collar", "chest", {0, 0.03 * s, 1.45});
    rig.add(side + "shoulder", side + "collar", shoulder);
    rig.add(side + "elbow", side + "shoulder", shoulder + 0.28 * along);
    rig.add(side + "wrist", side + "elbow", shoulder + 0.28 * along + 0.25 * fore);
    for (const double finger : {-0.03, 0.0, 0.03})
      rig.add(side + "finger" + std::to_string(finger), side + "wrist",
              shoulder + 0.28 * along + 0.35 * fore + glm::dvec3(finger, 0, 0));
  }
  return rig;
}

// Limbs to names of joints.
inline std::map<std::string, std::string> names_of(const FigureTree& tree, const modeler::Limbs& limbs) {
  std::map<std::string, std::string> names;
  for (const auto& [limb, joint] : named(limbs)) names[limb] = tree[joint].name;
  return names;
}

}  // namespace mars::importer
