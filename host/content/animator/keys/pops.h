// What a pose among dense keys does besides what a person asked for: the part goes away and comes back within a frame
// or two.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/content/animator/keys/things.h"
#include "host/content/animator/keys/tracks.h"

namespace mars::animator {

struct Pop {
  std::string part;  // as people name it
  double way;        // degrees of what turns, else a length
  bool turns;
  std::uint32_t from, to;  // frames of the keys beside it
};

// Where the part's new key at the frame is farther from what the part was there than the part goes in the frames
// around. It still has the values from `before`; none where few keys are near.
std::optional<Pop> pop_at(const KeyedPart& part, const Track& before, const Track& after, std::uint32_t frame);

// A line about the largest of them, with what to do; "" of none.
std::string remark_of(const std::string& thing, const std::vector<Pop>& pops);

}  // namespace mars::animator
