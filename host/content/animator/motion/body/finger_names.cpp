#include "host/content/animator/motion/body/finger_names.h"

#include <cctype>
#include <string_view>

namespace mars::motion {
namespace {

// In names of fingers' joints, in small letters: those of Mixamo, VRM, Unity, VRoid, Rigify (f_index.01.L), Unreal, Daz
// (lMid1), Character Creator, Quaternius and MARS's library; "finger" and a number, of Biped and MakeHuman, the thumb's
// the lowest; "fingers", a mitten.
constexpr std::string_view kWords[] = {"thumb", "index", "middle", "mid", "ring", "pinky", "little", "finger"};
constexpr std::string_view kInPalm = "carpal";  // which does not bend, but in a thumb

}  // namespace

std::string finger_of(const std::string& name) {
  std::string letters;
  for (const char each : name) letters += static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
  for (const std::string_view word : kWords) {
    const std::size_t at = letters.find(word);
    if (at == std::string::npos || (word != "thumb" && letters.find(kInPalm) != std::string::npos)) continue;
    return std::string(word) + (word == "finger" ? letters.substr(at + word.size(), 1) : "");
  }
  return "";
}

std::vector<std::size_t> finger_joints_below(const modeler::Model& model, std::size_t hand) {
  std::vector<std::size_t> joints;
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint)
    if (joint != hand && modeler::is_at_or_below(model.joints, joint, hand) &&
        !finger_of(model.joints[joint].name).empty())
      joints.push_back(joint);
  return joints;
}

}  // namespace mars::motion
