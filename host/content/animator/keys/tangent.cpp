#include "host/content/animator/keys/tangent.h"

#include <set>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/frame_words.h"
#include "host/content/animator/keys/part_setting.h"
#include "host/content/animator/keys/track_splines.h"

namespace mars::animator {
namespace {

using Slope = document::Json TrackKey::*;

std::vector<PartSetting> read(const std::string& part, const std::optional<std::string>& numbers, const Thing& thing) {
  return numbers ? read_settings(part + "=" + *numbers, thing) : read_axes(part, thing);
}

// What is not set of a slope stays; where there was none, it is that of the spline.
void set_slope(Track& track, std::size_t key, Slope slope, const PartSetting& setting) {
  document::Json& now = track[key].*slope;
  glm::dvec3 numbers = numbers_of(now.is_null() ? own_slope(track, key) : now);
  for (int axis = 0; axis < 3; ++axis) numbers[axis] = setting.numbers[axis].value_or(numbers[axis]);
  now = shaped_like(track[key].value, numbers);
  // A slope counts on splines alone; what jumps to the key goes on doing so.
  if (slope == &TrackKey::out) track[key].ease = kSpline;
  if (slope == &TrackKey::in && key > 0 && !track[key - 1].ease.hold) track[key - 1].ease = kSpline;
}

// Of several axes, those that are not set keep their slopes.
void forget_slope(Track& track, std::size_t key, Slope slope, const PartSetting& setting) {
  document::Json& now = track[key].*slope;
  if (now.is_null()) return;
  glm::dvec3 numbers = numbers_of(now);
  const glm::dvec3 own = numbers_of(own_slope(track, key));
  const std::size_t axes = now.is_array() ? now.size() : 1;
  bool all = true;
  for (std::size_t i = 0; i < axes; ++i) {
    const int axis = static_cast<int>(i);
    setting.numbers[i] ? void(numbers[axis] = own[axis]) : void(all = false);
  }
  now = all ? document::Json() : shaped_like(track[key].value, numbers);
}

class Slopes {
 public:
  Slopes(Tracks& tracks, FrameRange range) : tracks_(tracks), range_(range) {}

  template <typename Change>
  void change(const std::vector<PartSetting>& settings, Slope slope, Change change) {
    for (const PartSetting& setting : settings) {
      const auto track = tracks_.find(setting.part);
      if (track == tracks_.end()) continue;
      for (std::size_t key = 0; key < track->second.size(); ++key) {
        if (!range_.holds(track->second[key].frame)) continue;
        change(track->second, key, slope, setting);
        changed.insert(setting.part);
      }
    }
  }

  std::set<std::string> changed;

 private:
  Tracks& tracks_;
  FrameRange range_;
};

}  // namespace

Remarks set_slopes(document::Json& film, const Film& meaning, const std::string& thing, const std::string& part,
                   FrameRange range, const SlopeChange& change) {
  Chosen chosen = std::move(choose(film, meaning, {false, thing, {}}).front());
  Tracks tracks = tracks_of(*chosen.thing.json);
  Slopes slopes(tracks, range);
  for (const auto& [slope, numbers] : {std::pair(&TrackKey::in, change.in), std::pair(&TrackKey::out, change.out)}) {
    if (numbers || change.flat) slopes.change(read(part, numbers, chosen.thing), slope, set_slope);
    if (change.automatic) slopes.change(read_axes(part, chosen.thing), slope, forget_slope);
  }
  if (slopes.changed.empty())
    throw Failure("has no key of '" + part + "' " + shown_range(range), chosen.thing.name,
                  "make one with key or pose; `mars animate FILM list` shows what is keyed");
  chosen.parts.assign(slopes.changed.begin(), slopes.changed.end());
  return put(chosen, tracks);
}

}  // namespace mars::animator
