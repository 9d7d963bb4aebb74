// Lists of joints as the usual rigs have them, and which of them are which limb.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "host/content/importer/limbs/find_limbs.h"
#include "tests/host/content/importer/limbs/rig.h"

namespace mars::importer {
namespace {

// Each line a joint, a blank further in than its parent.
FigureTree tree_of(const std::string& text) {
  FigureTree tree;
  std::vector<std::size_t> depths;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t depth = line.find_first_not_of(' ');
    if (depth == std::string::npos) continue;
    std::size_t parent = tree.size();
    while (parent > 0 && depths[parent - 1] >= depth) --parent;
    depths.push_back(depth);
    tree.push_back({line.substr(depth), parent == 0 ? modeler::kNone : parent - 1, glm::dvec3(0, 0, 0)});
  }
  return tree;
}

struct KnownRig {
  const char* convention;  // part of the report
  const char* joints;
  const char* trunk;                // pelvis, spine, chest, neck, head; "-": none; '~' is a blank in a name
  const char *left_leg, *left_arm;  // hip, knee, ankle, toes; shoulder, elbow, wrist, fingers
  const char *right_leg, *right_arm;
};

// Without fingers and eyes, of which the tables say nothing.
const KnownRig kRigs[] = {
    {"Mixamo",
     R"(
Armature
 mixamorig:Hips
  mixamorig:Spine
   mixamorig:Spine1
    mixamorig:Spine2
     mixamorig:Neck
      mixamorig:Head
       mixamorig:HeadTop_End
     mixamorig:LeftShoulder
      mixamorig:LeftArm
       mixamorig:LeftForeArm
        mixamorig:LeftHand
         mixamorig:LeftHandThumb1
         mixamorig:LeftHandIndex1
     mixamorig:RightShoulder
      mixamorig:RightArm
       mixamorig:RightForeArm
        mixamorig:RightHand
  mixamorig:LeftUpLeg
   mixamorig:LeftLeg
    mixamorig:LeftFoot
     mixamorig:LeftToeBase
      mixamorig:LeftToe_End
  mixamorig:RightUpLeg
   mixamorig:RightLeg
    mixamorig:RightFoot
     mixamorig:RightToeBase
)",
     "mixamorig:Hips mixamorig:Spine mixamorig:Spine2 mixamorig:Neck mixamorig:Head",
     "mixamorig:LeftUpLeg mixamorig:LeftLeg mixamorig:LeftFoot mixamorig:LeftToeBase",
     "mixamorig:LeftArm mixamorig:LeftForeArm mixamorig:LeftHand -",
     "mixamorig:RightUpLeg mixamorig:RightLeg mixamorig:RightFoot mixamorig:RightToeBase",
     "mixamorig:RightArm mixamorig:RightForeArm mixamorig:RightHand -"},
    {"Mixamo",  // as three.js and Sketchfab leave it
     R"(
root
 mixamorigHips_01
  mixamorigSpine_02
   mixamorigNeck_03
    mixamorigHead_04
   mixamorigLeftArm_05
    mixamorigLeftForeArm_06
   mixamorigRightArm_07
    mixamorigRightForeArm_08
  mixamorigLeftUpLeg_09
   mixamorigLeftLeg_010
    mixamorigLeftFoot_011
  mixamorigRightUpLeg_012
   mixamorigRightLeg_013
    mixamorigRightFoot_014
)",
     "mixamorigHips_01 mixamorigSpine_02 - mixamorigNeck_03 mixamorigHead_04",
     "mixamorigLeftUpLeg_09 mixamorigLeftLeg_010 mixamorigLeftFoot_011 -",
     "mixamorigLeftArm_05 mixamorigLeftForeArm_06 - -",
     "mixamorigRightUpLeg_012 mixamorigRightLeg_013 mixamorigRightFoot_014 -",
     "mixamorigRightArm_07 mixamorigRightForeArm_08 - -"},
    {"CMU",
     R"(
root
 lhipjoint
  lfemur
   ltibia
    lfoot
     ltoes
 rhipjoint
  rfemur
   rtibia
    rfoot
     rtoes
 lowerback
  upperback
   thorax
    lowerneck
     upperneck
      head
    lclavicle
     lhumerus
      lradius
       lwrist
        lhand
         lfingers
        lthumb
    rclavicle
     rhumerus
      rradius
       rwrist
        rhand
         rfingers
        rthumb
)",
     "root lowerback thorax lowerneck head", "lfemur ltibia lfoot ltoes", "lhumerus lradius lhand lfingers",
     "rfemur rtibia rfoot rtoes", "rhumerus rradius rhand rfingers"},
    {"Mixamo or MotionBuilder",  // CMU's motions as BVH files have these names
     R"(
Hips
 LHipJoint
  LeftUpLeg
   LeftLeg
    LeftFoot
     LeftToeBase
 RHipJoint
  RightUpLeg
   RightLeg
    RightFoot
     RightToeBase
 LowerBack
  Spine
   Spine1
    Neck
     Neck1
      Head
    LeftShoulder
     LeftArm
      LeftForeArm
       LeftHand
        LeftFingerBase
         LeftHandIndex1
        LThumb
    RightShoulder
     RightArm
      RightForeArm
       RightHand
        RightFingerBase
)",
     "Hips LowerBack Spine1 Neck Head", "LeftUpLeg LeftLeg LeftFoot LeftToeBase",
     "LeftArm LeftForeArm LeftHand LeftFingerBase", "RightUpLeg RightLeg RightFoot RightToeBase",
     "RightArm RightForeArm RightHand RightFingerBase"},
    {"Biovision",
     R"(
Hips
 Chest
  Chest2
   LeftCollar
    LeftShoulder
     LeftElbow
      LeftWrist
   RightCollar
    RightShoulder
     RightElbow
      RightWrist
   Neck
    Head
 LeftHip
  LeftKnee
   LeftAnkle
    LeftToe
 RightHip
  RightKnee
   RightAnkle
    RightToe
)",
     "Hips Chest Chest2 Neck Head", "LeftHip LeftKnee LeftAnkle LeftToe", "LeftShoulder LeftElbow LeftWrist -",
     "RightHip RightKnee RightAnkle RightToe", "RightShoulder RightElbow RightWrist -"},
    {"Rigify",
     R"(
rig
 root
  DEF-spine
   DEF-pelvis.L
   DEF-pelvis.R
   DEF-spine.001
    DEF-spine.002
     DEF-spine.003
      DEF-spine.004
       DEF-spine.005
        DEF-spine.006
      DEF-shoulder.L
       DEF-upper_arm.L
        DEF-upper_arm.L.001
         DEF-forearm.L
          DEF-forearm.L.001
           DEF-hand.L
            DEF-f_index.01.L
      DEF-shoulder.R
       DEF-upper_arm.R
        DEF-upper_arm.R.001
         DEF-forearm.R
          DEF-forearm.R.001
           DEF-hand.R
   DEF-thigh.L
    DEF-thigh.L.001
     DEF-shin.L
      DEF-shin.L.001
       DEF-foot.L
        DEF-toe.L
   DEF-thigh.R
    DEF-thigh.R.001
     DEF-shin.R
      DEF-shin.R.001
       DEF-foot.R
        DEF-toe.R
  ORG-thigh.L
   ORG-shin.L
  ORG-thigh.R
   ORG-shin.R
)",
     "DEF-spine DEF-spine.001 DEF-spine.003 DEF-spine.004 DEF-spine.006", "DEF-thigh.L DEF-shin.L DEF-foot.L DEF-toe.L",
     "DEF-upper_arm.L DEF-forearm.L DEF-hand.L -", "DEF-thigh.R DEF-shin.R DEF-foot.R DEF-toe.R",
     "DEF-upper_arm.R DEF-forearm.R DEF-hand.R -"},
    {"Rigify",  // the metarig
     R"(
metarig
 spine
  spine.001
   spine.002
    spine.003
     spine.004
      spine.005
       spine.006
     shoulder.L
      upper_arm.L
       forearm.L
        hand.L
     shoulder.R
      upper_arm.R
       forearm.R
        hand.R
  pelvis.L
  pelvis.R
  thigh.L
   shin.L
    foot.L
     toe.L
     heel.02.L
  thigh.R
   shin.R
    foot.R
     toe.R
)",
     "spine spine.001 spine.003 spine.004 spine.006", "thigh.L shin.L foot.L toe.L", "upper_arm.L forearm.L hand.L -",
     "thigh.R shin.R foot.R toe.R", "upper_arm.R forearm.R hand.R -"},
    {"VRM, Unity or Godot",
     R"(
Hips
 Spine
  Chest
   UpperChest
    Neck
     Head
    LeftShoulder
     LeftUpperArm
      LeftLowerArm
       LeftHand
    RightShoulder
     RightUpperArm
      RightLowerArm
       RightHand
 LeftUpperLeg
  LeftLowerLeg
   LeftFoot
    LeftToes
 RightUpperLeg
  RightLowerLeg
   RightFoot
    RightToes
)",
     "Hips Spine UpperChest Neck Head", "LeftUpperLeg LeftLowerLeg LeftFoot LeftToes",
     "LeftUpperArm LeftLowerArm LeftHand -", "RightUpperLeg RightLowerLeg RightFoot RightToes",
     "RightUpperArm RightLowerArm RightHand -"},
    {"VRoid",
     R"(
Root
 J_Bip_C_Hips
  J_Bip_C_Spine
   J_Bip_C_Chest
    J_Bip_C_UpperChest
     J_Bip_C_Neck
      J_Bip_C_Head
     J_Bip_L_Shoulder
      J_Bip_L_UpperArm
       J_Bip_L_LowerArm
        J_Bip_L_Hand
     J_Bip_R_Shoulder
      J_Bip_R_UpperArm
       J_Bip_R_LowerArm
        J_Bip_R_Hand
  J_Bip_L_UpperLeg
   J_Bip_L_LowerLeg
    J_Bip_L_Foot
     J_Bip_L_ToeBase
  J_Bip_R_UpperLeg
   J_Bip_R_LowerLeg
    J_Bip_R_Foot
     J_Bip_R_ToeBase
)",
     "J_Bip_C_Hips J_Bip_C_Spine J_Bip_C_UpperChest J_Bip_C_Neck J_Bip_C_Head",
     "J_Bip_L_UpperLeg J_Bip_L_LowerLeg J_Bip_L_Foot J_Bip_L_ToeBase",
     "J_Bip_L_UpperArm J_Bip_L_LowerArm J_Bip_L_Hand -",
     "J_Bip_R_UpperLeg J_Bip_R_LowerLeg J_Bip_R_Foot J_Bip_R_ToeBase",
     "J_Bip_R_UpperArm J_Bip_R_LowerArm J_Bip_R_Hand -"},
    {"Unreal",
     R"(
root
 ik_foot_root
  ik_foot_l
  ik_foot_r
 pelvis
  spine_01
   spine_02
    spine_03
     neck_01
      head
     clavicle_l
      upperarm_l
       upperarm_twist_01_l
       lowerarm_l
        lowerarm_twist_01_l
        hand_l
     clavicle_r
      upperarm_r
       lowerarm_r
        hand_r
  thigh_l
   thigh_twist_01_l
   calf_l
    calf_twist_01_l
    foot_l
     ball_l
  thigh_r
   calf_r
    foot_r
     ball_r
)",
     "pelvis spine_01 spine_03 neck_01 head", "thigh_l calf_l foot_l ball_l", "upperarm_l lowerarm_l hand_l -",
     "thigh_r calf_r foot_r ball_r", "upperarm_r lowerarm_r hand_r -"},
    {"Biped",  // whose thighs hang from the spine
     R"(
Bip01
 Bip01 Pelvis
  Bip01 Spine
   Bip01 L Thigh
    Bip01 L Calf
     Bip01 L Foot
      Bip01 L Toe0
   Bip01 R Thigh
    Bip01 R Calf
     Bip01 R Foot
      Bip01 R Toe0
   Bip01 Spine1
    Bip01 Neck
     Bip01 Head
     Bip01 L Clavicle
      Bip01 L UpperArm
       Bip01 L Forearm
        Bip01 L Hand
     Bip01 R Clavicle
      Bip01 R UpperArm
       Bip01 R Forearm
        Bip01 R Hand
)",
     "Bip01~Pelvis Bip01~Spine1 - - Bip01~Head", "Bip01~L~Thigh Bip01~L~Calf Bip01~L~Foot Bip01~L~Toe0",
     "Bip01~L~UpperArm Bip01~L~Forearm Bip01~L~Hand -", "Bip01~R~Thigh Bip01~R~Calf Bip01~R~Foot Bip01~R~Toe0",
     "Bip01~R~UpperArm Bip01~R~Forearm Bip01~R~Hand -"},
    {"Character Creator",
     R"(
CC_Base_BoneRoot
 CC_Base_Hip
  CC_Base_Pelvis
   CC_Base_L_Thigh
    CC_Base_L_ThighTwist01
    CC_Base_L_Calf
     CC_Base_L_Foot
      CC_Base_L_ToeBase
   CC_Base_R_Thigh
    CC_Base_R_Calf
     CC_Base_R_Foot
      CC_Base_R_ToeBase
  CC_Base_Waist
   CC_Base_Spine01
    CC_Base_Spine02
     CC_Base_NeckTwist01
      CC_Base_NeckTwist02
       CC_Base_Head
     CC_Base_L_Clavicle
      CC_Base_L_Upperarm
       CC_Base_L_Forearm
        CC_Base_L_Hand
     CC_Base_R_Clavicle
      CC_Base_R_Upperarm
       CC_Base_R_Forearm
        CC_Base_R_Hand
)",
     "CC_Base_Hip CC_Base_Waist CC_Base_Spine02 CC_Base_NeckTwist01 CC_Base_Head",
     "CC_Base_L_Thigh CC_Base_L_Calf CC_Base_L_Foot CC_Base_L_ToeBase",
     "CC_Base_L_Upperarm CC_Base_L_Forearm CC_Base_L_Hand -",
     "CC_Base_R_Thigh CC_Base_R_Calf CC_Base_R_Foot CC_Base_R_ToeBase",
     "CC_Base_R_Upperarm CC_Base_R_Forearm CC_Base_R_Hand -"},
    {"numbered legs",
     R"(
_rootJoint
 b_Root_00
  b_Hip_01
   b_Spine01_02
    b_Spine02_03
     b_Neck_04
      b_Head_05
     b_RightUpperArm_06
      b_RightForeArm_07
       b_RightHand_08
     b_LeftUpperArm_09
      b_LeftForeArm_010
       b_LeftHand_011
   b_Tail01_012
   b_LeftLeg01_015
    b_LeftLeg02_016
     b_LeftFoot01_017
      b_LeftFoot02_018
   b_RightLeg01_019
    b_RightLeg02_020
     b_RightFoot01_021
      b_RightFoot02_022
)",
     "b_Hip_01 b_Spine01_02 b_Spine02_03 b_Neck_04 b_Head_05",
     "b_LeftLeg01_015 b_LeftLeg02_016 b_LeftFoot01_017 b_LeftFoot02_018",
     "b_LeftUpperArm_09 b_LeftForeArm_010 b_LeftHand_011 -",
     "b_RightLeg01_019 b_RightLeg02_020 b_RightFoot01_021 b_RightFoot02_022",
     "b_RightUpperArm_06 b_RightForeArm_07 b_RightHand_08 -"},
    {"upper and lower",
     R"(
pelvis
 belly
  neck
   head
  arm_left_upper
   arm_left_lower
    hand_left
  arm_right_upper
   arm_right_lower
    hand_right
 leg_left_upper
  leg_left_lower
   foot_left
 leg_right_upper
  leg_right_lower
   foot_right
)",
     "pelvis belly - neck head", "leg_left_upper leg_left_lower foot_left -",
     "arm_left_upper arm_left_lower hand_left -", "leg_right_upper leg_right_lower foot_right -",
     "arm_right_upper arm_right_lower hand_right -"},
    {"joints with L and R",
     R"(
root
 hips
  spine01
   spine02
    neck01
     head
    L_clavicle
     L_shoulder
      L_bicep
       L_elbow
        L_forearm
         L_wrist
          L_index_01
    R_clavicle
     R_shoulder
      R_elbow
       R_wrist
  L_hip
   L_knee_01
    L_knee_02
     L_ankle
      L_toeBall
  R_hip
   R_knee_01
    R_ankle
     R_toeBall
)",
     "hips spine01 spine02 neck01 head", "L_hip L_knee_01 L_ankle L_toeBall", "L_shoulder L_elbow L_wrist -",
     "R_hip R_knee_01 R_ankle R_toeBall", "R_shoulder R_elbow R_wrist -"}};

void expect_limbs(std::map<std::string, std::string>& expected, const std::string& names,
                  const std::vector<std::string>& limbs) {
  std::istringstream words(names);
  for (const std::string& limb : limbs) {
    std::string word;
    words >> word;
    std::ranges::replace(word, '~', ' ');
    if (word != "-") expected[limb] = word;
  }
}

TEST(LimbNames, OfTheUsualRigs) {
  for (const KnownRig& rig : kRigs) {
    std::map<std::string, std::string> expected;
    expect_limbs(expected, rig.trunk, {"pelvis", "spine", "chest", "neck", "head"});
    expect_limbs(expected, rig.left_leg, {"left.hip", "left.knee", "left.ankle", "left.toes"});
    expect_limbs(expected, rig.left_arm, {"left.shoulder", "left.elbow", "left.wrist", "left.fingers"});
    expect_limbs(expected, rig.right_leg, {"right.hip", "right.knee", "right.ankle", "right.toes"});
    expect_limbs(expected, rig.right_arm, {"right.shoulder", "right.elbow", "right.wrist", "right.fingers"});
    const FigureTree tree = tree_of(rig.joints);
    const FiguresLimbs found = find_limbs(tree, {}, false);
    EXPECT_EQ(names_of(tree, found.limbs), expected) << rig.convention;
    EXPECT_NE(found.limbs_made.find(rig.convention), std::string::npos) << found.limbs_made;
    EXPECT_FALSE(found.is_guess);
  }
}

TEST(LimbNames, BonesCountBeforeJointsOfTheirName) {
  FigureTree tree = tree_of(kRigs[5].joints);
  for (TreeJoint& joint : tree) joint.is_bone = joint.name.starts_with("DEF-");
  EXPECT_EQ(names_of(tree, find_limbs(tree, {}, false).limbs)["left.hip"], "DEF-thigh.L");
  for (TreeJoint& joint : tree)
    if (joint.name.starts_with("DEF-thigh")) joint.name = "x";
  const auto names = names_of(tree, find_limbs(tree, {}, false).limbs);
  EXPECT_EQ(names.at("left.knee"), "DEF-shin.L");
  EXPECT_EQ(names.count("left.hip"), 0u) << "one rig's names alone";
}

TEST(LimbNames, AJointThatDoesNotHangBelowIsNoLimb) {
  FigureTree tree = tree_of(kRigs[0].joints);
  for (TreeJoint& joint : tree)
    if (joint.name == "mixamorig:LeftFoot") joint.parent = 0;
  const FiguresLimbs found = find_limbs(tree, {}, false);
  const auto names = names_of(tree, found.limbs);
  EXPECT_EQ(names.count("left.ankle"), 0u);
  EXPECT_EQ(names.count("right.ankle"), 1u);
  ASSERT_EQ(found.doubts.size(), 3u);
  EXPECT_NE(found.doubts[0].find("'mixamorig:LeftFoot' does not hang below"), std::string::npos) << found.doubts[0];
  EXPECT_EQ(found.doubts[2], "not found: left.ankle");
}

TEST(LimbNames, WordsThatAreNoRig) {
  for (const char* joints : {"box\n lid\n", "LeftWing\n RightWing\n", "Hips\n Spine\n  Head\n"})
    EXPECT_EQ(find_limbs(tree_of(joints), {}, false).limbs_made, "") << joints;
}

TEST(LimbNames, AMapCountsBeforeNames) {
  const FigureTree tree = tree_of(kRigs[0].joints);
  const auto joint = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(tree, name, &TreeJoint::name) - tree.begin());
  };
  const LimbMap map{"map of a file",
                    {{"left.hip", joint("mixamorig:LeftLeg")}, {"left.knee", joint("mixamorig:LeftFoot")}}};
  const FiguresLimbs found = find_limbs(tree, map, true);
  EXPECT_EQ(names_of(tree, found.limbs), (std::map<std::string, std::string>{{"left.hip", "mixamorig:LeftLeg"},
                                                                             {"left.knee", "mixamorig:LeftFoot"}}));
  EXPECT_NE(found.limbs_made.find("map of a file"), std::string::npos);
}

}  // namespace
}  // namespace mars::importer
