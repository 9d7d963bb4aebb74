#include "host/content/animator/keys/pops.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/keys/written.h"
#include "host/content/animator/pose/figure.h"
#include "host/content/document/fields.h"
#include "host/content/modeler/frames.h"

namespace mars::animator {
namespace {

constexpr std::uint32_t kNear = 4;  // frames between keys that are dense
constexpr double kCalm = 5;         // degrees a frame that nobody calls a pop
constexpr int kFalloff = 8;         // frames that the remark offers

// Degrees of what turns, else a length.
double way_between(const modeler::Joint* joint, const document::Json& from, const document::Json& to) {
  if (joint == nullptr) return glm::distance(vector_of(from), vector_of(to));
  return turn_between(modeler::orientation(*joint, vector_of(from)), modeler::orientation(*joint, vector_of(to)))
             .angle /
         modeler::kDegree;
}

bool holds_numbers(const TrackKey& key) { return key.value.is_array() && key.value.size() == 3; }

bool is_near(std::uint32_t one, std::uint32_t other) { return std::max(one, other) - std::min(one, other) <= kNear; }

// The farthest that the part goes in a frame between the keys around.
double usual_way(const modeler::Joint* joint, const Track& track, std::uint32_t frame) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < track.size(); ++i) {
    const TrackKey &from = track[i], &to = track[i + 1];
    if (from.ease.hold || to.frame + kNear < frame || from.frame > frame + kNear || !holds_numbers(from) ||
        !holds_numbers(to))
      continue;
    most = std::max(most, way_between(joint, from.value, to.value) / (to.frame - from.frame));
  }
  return most;
}

}  // namespace

std::optional<Pop> pop_at(const KeyedPart& part, const Track& before, const Track& after, std::uint32_t frame) {
  const modeler::Joint* joint = part.turns != nullptr ? part.turns : part.joint;
  const auto key = std::ranges::find(after, frame, &TrackKey::frame);
  if (key == after.end() || !holds_numbers(*key)) return std::nullopt;
  if (std::ranges::count_if(after, [&](const TrackKey& each) { return is_near(each.frame, frame); }) < 3)
    return std::nullopt;
  std::uint32_t from = frame, to = frame, apart = kNear;
  if (key != after.begin() && !std::prev(key)->ease.hold && is_near(std::prev(key)->frame, frame))
    from = std::prev(key)->frame;
  if (std::next(key) != after.end() && !key->ease.hold && is_near(std::next(key)->frame, frame))
    to = std::next(key)->frame;
  for (const std::uint32_t beside : {from, to})
    if (beside != frame) apart = std::min(apart, std::max(beside, frame) - std::min(beside, frame));
  if (from == to) return std::nullopt;  // between two cuts
  const double way = way_between(joint, part.value_at(frame), key->value);
  const double calm = usual_way(joint, before, frame) + (joint != nullptr ? kCalm : 0);
  if (way / apart <= calm * (1 + 1e-9)) return std::nullopt;
  return Pop{shown_part(part.name), way, joint != nullptr, from, to};
}

std::string remark_of(const std::string& thing, const std::vector<Pop>& pops) {
  if (pops.empty()) return "";
  const Pop& pop = *std::ranges::max_element(pops, {}, &Pop::way);
  const std::string way = document::shown(std::round(pop.way * 100) / 100);
  const std::string falloff = std::to_string(kFalloff);
  return thing + ": " + pop.part + " pops by " + way + (pop.turns ? (way == "1" ? " degree" : " degrees") : "") +
         " between its keys at frames " + std::to_string(pop.from) + " and " + std::to_string(pop.to) +
         (pops.size() > 1 ? ", with " + document::counted(pops.size() - 1, "other part") : "") + " (--falloff " +
         falloff + " blends the change over " + falloff + " frames to both sides)";
}

}  // namespace mars::animator
