#include "host/content/animator/keys/reduce.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/rotation.h"
#include "host/content/animator/keys/spline_fit.h"
#include "host/content/animator/keys/track_splines.h"
#include "host/content/animator/keys/written.h"
#include "host/content/elementary/elementary.h"
#include "host/content/modeler/frames.h"

namespace mars::animator {
namespace {

constexpr double kGrains = 20;  // of an allowed error: what keys are rounded to
constexpr std::size_t kMostReduced = 100'000;

// A power of ten, so that keys have few digits.
double grain_for(double error) { return elementary::pow(10, std::floor(elementary::log10(error / kGrains))); }

document::Json like(const document::Json& value, const glm::dvec3& numbers) {
  return value.is_array() ? written(numbers) : written(numbers.x);
}

double angle_between(const glm::dmat3& one, const glm::dmat3& other) {
  return turn_between(one, other).angle / modeler::kDegree;
}

// The actor's size, or how far the camera is from what it looks at; 1 for other things, of which nothing is reduced.
double size_of(const Film& film, const Chosen& chosen) {
  if (!chosen.thing.actor) {
    if (chosen.thing.name != "camera") return 1;
    const Thing& camera = chosen.thing;
    return glm::length(numbers_of(camera.part("eye").value_at(0)) - numbers_of(camera.part("at").value_at(0)));
  }
  const std::string name = chosen.thing.json->at("name").get<std::string>();
  const auto actor = std::ranges::find(film.actors, name, &Actor::name);
  const auto bounds = modeler::rest_bounds(film.models[actor->model]);
  return bounds ? glm::length(bounds->max - bounds->min) : 1;
}

bool reducible(const Chosen& chosen, const std::string& part) {
  if (chosen.thing.actor) return part != "attach";
  return chosen.thing.name == "camera" && (part == "eye" || part == "at" || part == "fov" || part == "height");
}

class Reducer {
 public:
  Reducer(const Film& film, const Chosen& chosen, const ReductionError& error) : chosen_(chosen), error_(error) {
    distance_ = error.distance.value_or(error.degrees * modeler::kDegree * size_of(film, chosen));
  }

  // Parts with keys to spare.
  void choose_parts(const Tracks& tracks, FrameRange range) {
    for (const std::string& name : chosen_.parts) {
      const auto track = tracks.find(name);
      if (track == tracks.end() || !reducible(chosen_, name)) continue;
      const auto inside = std::ranges::count_if(track->second, [&](const TrackKey& k) { return range.holds(k.frame); });
      if (inside > 2) parts_.push_back(name);
    }
  }

  const std::vector<std::string>& parts() const { return parts_; }

  void reduce(Tracks& tracks, FrameRange range) const {
    std::vector<DenseCurve> curves;
    for (const std::string& name : parts_) curves.push_back(curve_of(chosen_.thing.part(name), range));
    const auto fitted = fit_splines(curves);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      put(chosen_.thing.part(parts_[i]), tracks.at(parts_[i]), fitted[i], range);
  }

 private:
  DenseCurve curve_of(const KeyedPart& part, FrameRange range) const {
    DenseCurve curve;
    for (std::uint32_t frame = range.first; frame <= range.last; ++frame)
      curve.values.push_back(numbers_of(part.value_at(frame)));
    const modeler::Joint* joint = part.joint != nullptr ? part.joint : part.turns;
    const double allowed = joint != nullptr || part.name == "fov" ? error_.degrees : distance_;
    curve.grain = grain_for(allowed);
    if (joint == nullptr)
      curve.error = [values = curve.values, allowed](std::size_t frame, const glm::dvec3& value) {
        return glm::length(value - values[frame]) / allowed;
      };
    else
      curve.error = error_of_turns(*joint, curve.values);
    return curve;
  }

  std::function<double(std::size_t, const glm::dvec3&)> error_of_turns(const modeler::Joint& joint,
                                                                       const std::vector<glm::dvec3>& poses) const {
    std::vector<glm::dmat3> turns;
    for (const glm::dvec3& pose : poses) turns.push_back(modeler::orientation(joint, pose));
    return [&joint, turns = std::move(turns), allowed = error_.degrees](std::size_t frame, const glm::dvec3& pose) {
      return angle_between(turns[frame], modeler::orientation(joint, clamped(joint, pose))) / allowed;
    };
  }

  // Instead of the track's keys in the range.
  static void put(const KeyedPart& part, Track& track, const std::vector<FittedKey>& keys, FrameRange range) {
    const document::Json shape = track.front().value;
    Track inside;
    for (const FittedKey& key : keys) {
      const glm::dvec3 value = part.joint != nullptr ? clamped(*part.joint, key.value) : key.value;
      TrackKey& made =
          inside.emplace_back(TrackKey{static_cast<std::uint32_t>(range.first + key.at), like(shape, value), kSpline});
      if (key.in) made.in = like(shape, *key.in);
      if (key.out) made.out = like(shape, *key.out);
    }
    drop_still_ends(inside, track.front().frame >= range.first, track.back().frame <= range.last);
    std::erase_if(track, [&](const TrackKey& key) { return range.holds(key.frame); });
    for (TrackKey& key : inside) put_key(track, std::move(key));
  }

  // A part that begins to move later needs no key before that.
  static void drop_still_ends(Track& track, bool begins, bool ends) {
    const auto still = [](const TrackKey& from, const TrackKey& to) {
      return from.value == to.value && is_zero(from.out) && is_zero(to.in);
    };
    while (ends && track.size() > 1 && still(track[track.size() - 2], track.back())) track.pop_back();
    while (begins && track.size() > 1 && still(track[0], track[1])) track.erase(track.begin());
  }

  static bool is_zero(const document::Json& slope) { return !slope.is_null() && numbers_of(slope) == glm::dvec3(0); }

  const Chosen& chosen_;
  ReductionError error_;
  double distance_;
  std::vector<std::string> parts_;
};

// Counts keys of the parts in the range, and their frames.
void count(const Tracks& tracks, const std::vector<std::string>& parts, FrameRange range, std::size_t& keys,
           std::size_t& frames) {
  std::set<std::uint32_t> at;
  for (const std::string& part : parts)
    for (const TrackKey& key : tracks.at(part))
      if (range.holds(key.frame)) at.insert(key.frame), ++keys;
  frames += at.size();
}

// From the first to the last key of the parts in the range.
FrameRange span_of(const Tracks& tracks, const std::vector<std::string>& parts, FrameRange range) {
  FrameRange span{range.last, range.first};
  for (const std::string& part : parts)
    for (const TrackKey& key : tracks.at(part))
      if (range.holds(key.frame)) span = {std::min(span.first, key.frame), std::max(span.last, key.frame)};
  if (span.last - span.first > kMostReduced)
    throw Failure("has keys in " + std::to_string(span.last - span.first + 1) + " frames", "what is to be reduced",
                  "reduce " + std::to_string(kMostReduced) + " frames at a time (--frame)");
  return span;
}

}  // namespace

Reduction reduce_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range,
                      const ReductionError& error) {
  document::Json changed = film;
  Reduction done;
  for (const Chosen& chosen : choose(changed, meaning, choice)) {
    Reducer reducer(meaning, chosen, error);
    reducer.choose_parts(tracks_of(*chosen.thing.json), range);
    const std::vector<std::string>& parts = reducer.parts();
    if (parts.empty()) continue;
    const FrameRange span = span_of(tracks_of(*chosen.thing.json), parts, range);
    count(tracks_of(*chosen.thing.json), parts, span, done.keys_before, done.frames_before);
    Tracks tracks = tracks_of(*chosen.thing.json);
    for (const std::string& part : parts)
      for (const std::uint32_t frame : {span.first, span.last})
        if (tracks.at(part).front().frame < frame && frame < tracks.at(part).back().frame)
          split_way(tracks.at(part), frame, chosen.thing.part(part).value_at);
    reducer.reduce(tracks, span);
    count(tracks, parts, span, done.keys_after, done.frames_after);
    const Remarks remarks = put(chosen, tracks);
    done.remarks.insert(done.remarks.end(), remarks.begin(), remarks.end());
  }
  if (done.frames_before == 0)
    throw Failure("has no part with three keys or more there", choice.all ? meaning.source : "'" + choice.thing + "'",
                  "`mars animate FILM list` shows the keys");
  film = std::move(changed);
  return done;
}

}  // namespace mars::animator
