// A figure as other programs draw it: arms held out to the sides, and joints between those that are limbs.
#pragma once

#include "tests/host/content/animator/motion/bodies.h"

namespace mars::motion {

// `wide`: of the trunk, half; the shoulders' distance is that of a slim one.
inline document::Json stranger(double wide = 15) {
  const document::Json back{{"x", {-12, 12}}, {"y", {-10, 27}}, {"z", {-15, 15}}}, free = nullptr;
  document::Json joints =
      document::Json::array({jointed("hips", "", {0, 0, 95}, free, {{-10, -wide, -8}, {10, wide, 8}}),
                             jointed("spine", "hips", {0, 0, 10}, back, {{-10, -wide, 0}, {10, wide, 15}}),
                             jointed("spine1", "spine", {0, 0, 15}, back, {{-10, -wide, 0}, {10, wide, 15}}),
                             jointed("spine2", "spine1", {0, 0, 15}, back, {{-10, -wide, 0}, {10, wide, 10}}),
                             jointed("neck", "spine2", {0, 0, 18}, free, {{-4, -4, 0}, {4, 4, 8}}),
                             jointed("head", "neck", {0, 0, 8}, free, {{-9, -8, 0}, {9, 8, 22}}, "sphere")});
  document::Json limbs{{"pelvis", "hips"}, {"spine", "spine"}, {"chest", "spine2"}, {"neck", "neck"}, {"head", "head"}};
  for (const std::string side : {"left", "right"}) {
    const double s = side == "left" ? 1 : -1;
    const auto box = [&](double near, double far, double thick) {
      return document::Json{{-thick, std::min(s * near, s * far), -thick}, {thick, std::max(s * near, s * far), thick}};
    };
    const document::Json knee{{"y", {0, 150}}}, ankle{{"x", {-30, 30}}, {"y", {-70, 60}}, {"z", {-30, 30}}};
    joints.push_back(jointed(side + "-up-leg", "hips", {0, s * 9, -5}, free, {{-7, -7, -42}, {7, 7, 4}}));
    joints.push_back(jointed(side + "-leg", side + "-up-leg", {0, 0, -42}, knee, {{-6, -6, -42}, {6, 6, 4}}));
    joints.push_back(jointed(side + "-foot", side + "-leg", {0, 0, -42}, ankle, {{-6, -5, -6}, {20, 5, 3}}));
    joints.push_back(
        jointed(side + "-collar", "spine2", {0, s * 5, 14}, {{"x", {-10, 40}}, {"z", {-20, 20}}}, box(0, 12, 3)));
    joints.push_back(jointed(side + "-arm", side + "-collar", {0, s * 13, 0}, free, box(0, 28, 4)));
    joints.push_back(jointed(side + "-fore-arm", side + "-arm", {0, s * 28, 0}, free, box(0, 26, 4)));
    joints.push_back(jointed(side + "-hand", side + "-fore-arm", {0, s * 26, 0}, free, box(0, 18, 3)));
    limbs[side] = {{"hip", side + "-up-leg"},   {"knee", side + "-leg"},       {"ankle", side + "-foot"},
                   {"shoulder", side + "-arm"}, {"elbow", side + "-fore-arm"}, {"wrist", side + "-hand"}};
  }
  return {{"limbs", limbs}, {"joints", joints}};
}

}  // namespace mars::motion
