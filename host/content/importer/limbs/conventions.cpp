#include "host/content/importer/limbs/conventions.h"

namespace mars::importer {
namespace {

// clang-format off
constexpr Convention kConventions[] = {
    {"Mixamo or MotionBuilder",
     "mixamo.com's rig; Autodesk MotionBuilder, naming conventions of characters; cgspeed's BVH files of CMU's motions",
     "left", "right", "hips|hip", "neck", "head",
     {"%upleg", "%leg", "%foot", "%toebase|%toe", "%arm", "%forearm", "%hand", "%fingerbase"}},
    {"VRM, Unity or Godot",
     "github.com/vrm-c/vrm-specification, humanoid bones; Unity's HumanBodyBones; Godot's SkeletonProfileHumanoid",
     "left", "right", "hips", "neck", "head",
     {"%upperleg", "%lowerleg", "%foot", "%toes|%toe", "%upperarm", "%lowerarm", "%hand", ""}},
    {"VRoid", "VRoid Studio's J_Bip_L_UpperLeg",
     "l", "r", "chips", "cneck", "chead",
     {"%upperleg", "%lowerleg", "%foot", "%toebase", "%upperarm", "%lowerarm", "%hand", ""}},
    {"Rigify", "Blender's add-on Rigify, its metarig and its bones DEF- and ORG-",
     "l", "r", "hips|spine", "neck|spine004", "head|spine006|spine005",
     {"thigh%", "shin%", "foot%", "toe%", "upperarm%", "forearm%", "hand%", ""}},
    {"Unreal's mannequin", "dev.epicgames.com, skeleton of the mannequin",
     "l", "r", "pelvis", "neck01", "head",
     {"thigh%", "calf%", "foot%", "ball%", "upperarm%", "lowerarm%", "hand%", ""}},
    {"Biped", "3ds Max' Biped: Bip01 L Thigh",
     "l", "r", "pelvis", "neck", "head",
     {"%thigh", "%calf", "%foot", "%toe0", "%upperarm", "%forearm", "%hand", ""}},
    {"Character Creator", "Reallusion's Character Creator: CC_Base_L_Thigh",
     "l", "r", "hip", "necktwist01", "head",
     {"%thigh", "%calf", "%foot", "%toebase", "%upperarm", "%forearm", "%hand", ""}},
    {"Daz Genesis", "Daz 3D's Genesis 3 and 8: lThighBend",
     "l", "r", "hip", "necklower|neck", "head",
     {"%thighbend|%thigh", "%shin", "%foot", "%toe", "%shldrbend|%shldr", "%forearmbend|%forearm", "%hand", ""}},
    {"CMU", "the ASF files of mocap.cs.cmu.edu",
     "l", "r", "root|hips", "lowerneck", "head",
     {"%femur", "%tibia", "%foot", "%toes", "%humerus", "%radius", "%hand", "%fingers"}},
    {"Biovision", "M. Meredith, S. Maddock: Motion Capture File Formats Explained, Sheffield 2001: LeftCollar, LeftHip",
     "left", "right", "hips", "neck", "head",
     {"%hip", "%knee", "%ankle", "%toe", "%shoulder", "%elbow", "%wrist", ""}},
    {"joints with L and R", "joints of the body by their own names: L_hip, L_knee_01, R_wrist",
     "l", "r", "hips|pelvis|root", "neck|neck01", "head",
     {"%hip", "%knee|%knee01", "%ankle", "%toeball|%ball|%toes|%toe", "%shoulder", "%elbow", "%wrist", ""}},
    {"MakeHuman", "MakeHuman's default rig: upperleg01.L",
     "l", "r", "root", "neck01", "head",
     {"upperleg01%", "lowerleg01%", "foot%", "toe11%", "upperarm01%", "lowerarm01%", "wrist%", ""}},
    {"Quaternius", "quaternius.com's figures: UpperLeg.L",
     "l", "r", "hips|pelvis", "neck", "head",
     {"upperleg%", "lowerleg%", "foot%", "toes%|toe%", "upperarm%", "lowerarm%", "hand%|palm%|wrist%", ""}},
    {"MARS's library", "the figures of this program: left-thigh",
     "left", "right", "pelvis", "neck", "head",
     {"%thigh", "%shin", "%foot", "%toes", "%upperarm", "%forearm", "%hand", ""}},
    {"numbered legs", "PixelMannen's Fox, in the glTF sample models: b_RightLeg01",
     "left", "right", "hips|hip", "neck", "head",
     {"%leg01|%leg1", "%leg02|%leg2", "%foot01|%foot1|%leg03|%foot", "%foot02|%foot2|%toe01|%toe",
      "%upperarm|%arm01|%arm1", "%forearm|%arm02|%arm2", "%hand|%hand01|%arm03", ""}},
    {"upper and lower", "plain words: left_leg_upper, upper_leg_left",
     "left", "right", "pelvis|hips|hip", "neck", "head",
     {"%legupper|leg%upper|upperleg%", "%leglower|leg%lower|lowerleg%", "foot%|%foot", "toes%|%toes|toe%|%toe",
      "%armupper|arm%upper|upperarm%", "%armlower|arm%lower|lowerarm%", "hand%|%hand", ""}},
};
// clang-format on

}  // namespace

std::span<const Convention> conventions() { return kConventions; }

}  // namespace mars::importer
