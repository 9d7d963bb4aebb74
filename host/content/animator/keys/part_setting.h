// What a person types to set parts of a thing: "elbow.y=90", "elbow=0,90,0", "elbow.y+=10", "*-shin.y-=10", "fov=30".
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/content/animator/keys/things.h"

namespace mars::animator {

// One part and its new numbers; what is none stays as it is.
struct PartSetting {
  std::string part;  // "place", "fov"; a joint is "/" and its name
  std::array<std::optional<double>, 3> numbers;
  bool relative = false;  // added to what the part is
};

// Of each part that the text names: of a pattern, of those that have such numbers and can turn there. Throws where no
// part fits.
std::vector<PartSetting> read_settings(const std::string& text, const Thing& thing);

// The same of a text without numbers, "elbow.y" or "place": each that it names is 0.
std::vector<PartSetting> read_axes(const std::string& text, const Thing& thing);

}  // namespace mars::animator
