#include "host/content/animator/keys/keys.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/channel.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/frame_words.h"
#include "host/content/animator/keys/side_effects.h"
#include "host/content/animator/keys/track_splines.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/fields.h"
#include "node/wire/film.h"

namespace mars::animator {
namespace {

using wire::kMostFrames;

std::string listed_frames(const std::set<std::uint32_t>& frames) {
  std::string text;
  for (const std::uint32_t frame : frames) {
    if (text.size() > 60) return text + " ...";
    text += (text.empty() ? "" : ", ") + std::to_string(frame);
  }
  return text;
}

void append(Remarks& remarks, const Remarks& more) { remarks.insert(remarks.end(), more.begin(), more.end()); }

std::string name_of(const std::vector<Chosen>& chosen, const Film& meaning) {
  return chosen.size() == 1 ? chosen[0].thing.name : meaning.source;
}

std::vector<std::string> left_out(const Film& meaning, const Choice& choice) {
  std::vector<std::string> remarks;
  for (const Actor& actor : meaning.actors)
    if (choice.all && !actor.matrices.empty())
      remarks.push_back("actor '" + actor.name + "' is moved by matrices and stays as it is");
  return remarks;
}

// Changes tracks by `change(chosen, part, track)`, all of them in memory before the film changes. `change` returns
// whether the choice names any key of the track; if none does, that is an error.
template <typename Change>
Remarks change_tracks(document::Json& film, const Film& meaning, const Choice& choice, const std::string& sought,
                      Change change) {
  std::vector<Chosen> chosen = choose(film, meaning, choice);
  std::vector<Tracks> changed;
  std::set<std::uint32_t> standing;
  bool any = false;
  for (const Chosen& one : chosen) {
    Tracks& tracks = changed.emplace_back(tracks_of(*one.thing.json));
    for (const std::string& part : one.parts) {
      const auto track = tracks.find(part);
      if (track == tracks.end()) continue;
      for (const TrackKey& key : track->second) standing.insert(key.frame);
      if (change(one, part, track->second)) any = true;
    }
  }
  if (!any)
    throw Failure("has no key " + sought, name_of(chosen, meaning),
                  standing.empty() ? "it has no keys at all: make some with pose or key"
                                   : "its keys stand at " + listed_frames(standing));
  Remarks remarks = left_out(meaning, choice);
  for (std::size_t i = 0; i < chosen.size(); ++i) append(remarks, put(chosen[i], changed[i]));
  return remarks;
}

// Takes the keys in the range out of the track.
Track taken(Track& track, FrameRange range) {
  Track keys;
  for (const TrackKey& key : track)
    if (range.holds(key.frame)) keys.push_back(key);
  std::erase_if(track, [&](const TrackKey& key) { return range.holds(key.frame); });
  return keys;
}

std::uint32_t frame_from(std::int64_t frame, const std::string& where) {
  if (frame < 0 || frame > kMostFrames)
    throw Failure("would have a key at frame " + std::to_string(frame), where,
                  "keys stand at frames 0 to " + std::to_string(kMostFrames));
  return static_cast<std::uint32_t>(frame);
}

Remarks displace(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range, std::uint32_t to,
                 bool copies) {
  const std::int64_t by = std::int64_t{to} - range.first;
  return change_tracks(film, meaning, choice, shown_range(range),
                       [&](const Chosen& one, const std::string&, Track& track) {
                         const Track whole = track;
                         const Track moved = taken(track, range);
                         if (copies) track = whole;
                         for (TrackKey key : moved) {
                           key.frame = frame_from(key.frame + by, one.thing.name);
                           put_key(track, key);
                         }
                         return !moved.empty();
                       });
}

// The frames of a track's keys by `map`, which never goes back. Two keys on one frame are an error.
template <typename Map>
void remap(Track& track, const std::string& thing, Map map) {
  for (std::size_t i = track.size(); i-- > 0;) {
    const std::uint32_t was = track[i].frame;
    track[i].frame = frame_from(map(was), thing);
    if (i + 1 < track.size() && track[i].frame >= track[i + 1].frame)
      throw Failure("would lose keys: two would stand at frame " + std::to_string(track[i + 1].frame), thing,
                    "move less, or delete the key at frame " + std::to_string(was) + " first");
  }
}

Ease rounded_curve(const Ease& ease) {
  return {rounded(ease.x1), rounded(ease.y1), rounded(ease.x2), rounded(ease.y2)};
}

// Whether it could.
bool split_ease(TrackKey& before, std::uint32_t next, TrackKey& key) {
  const double time = double(key.frame - before.frame) / double(next - before.frame);
  const auto halves = split(before.ease, time);
  if (!halves) return false;
  before.ease = rounded_curve(halves->first);
  key.ease = rounded_curve(halves->second);
  return true;
}

// From a point that goes along with an actor to another's, or to a place: that way has no keys of its kind.
bool changes_carrier(const document::Json& from, const document::Json& to) {
  if (!from.is_object() && !to.is_object()) return false;
  if (!from.is_object() || !to.is_object()) return true;
  return from.value("actor", "") != to.value("actor", "") || from.value("joint", "") != to.value("joint", "");
}

// A spline's numbers are the keys' own; a light's direction is shown at its length, 1.
bool shows_its_numbers(const TrackKey& key, const ValueAt& value_at) {
  constexpr double kAlike = 1e-6;
  const document::Json shown = value_at(key.frame);
  return !key.value.is_object() && !shown.is_object() &&
         glm::length(numbers_of(key.value) - numbers_of(shown)) < kAlike;
}

// Whether the key could be put on the way from the one before, with all else as it is.
bool split_between(Track& track, std::size_t before, TrackKey& key, const ValueAt& value_at) {
  TrackKey &from = track[before], &to = track[before + 1];
  if (from.ease.hold) {
    key.ease = kHold;
    return true;
  }
  if (changes_carrier(from.value, to.value)) return false;
  if (!from.ease.spline) return split_ease(from, to.frame, key);
  if (!shows_its_numbers(from, value_at) || !shows_its_numbers(to, value_at)) return false;
  split_spline(track, before, key);
  return true;
}

// Keys at all frames between the key `before` and the next.
void key_between(Track& track, std::size_t before, const ValueAt& value_at) {
  TrackKey &from = track[before], &to = track[before + 1];
  from.ease = kLinear;
  from.out = to.in = nullptr;
  Track keys;
  for (std::uint32_t frame = from.frame + 1; frame < to.frame; ++frame)
    keys.push_back({frame, value_at(frame), kLinear});
  track.insert(track.begin() + static_cast<std::ptrdiff_t>(before) + 1, keys.begin(), keys.end());
}

// The same, and on splines beside them, which depend on what has no numbers.
FrameRange key_all(Track& track, std::size_t before, const ValueAt& value_at) {
  std::size_t first = before, last = before;
  const auto hangs = [&](std::size_t key) { return track[key].ease.spline && track[before].ease.spline; };
  if (changes_carrier(track[before].value, track[before + 1].value)) {
    if (first > 0 && hangs(first - 1)) --first;
    if (last + 2 < track.size() && hangs(last + 1)) ++last;
  }
  const FrameRange keyed{track[first].frame + 1, track[last + 1].frame - 1};
  for (std::size_t key = last + 1; key-- > first;) key_between(track, key, value_at);
  return keyed;
}

// Of a part as it is at the frame.
document::Json key_there(const std::string& thing, const KeyedPart& part, std::uint32_t frame, Beyond beyond,
                         Remarks& remarks) {
  document::Json value = part.key_at(frame);
  return part.joint ? written(within_limits(thing, *part.joint, vector_of(value), beyond, remarks)) : value;
}

// A choice of all makes no keys where nothing is keyed but of actors.
bool keyable(const Chosen& one, const std::string& part, const Tracks& tracks, const Choice& choice) {
  if (part == "attach" && !tracks.contains(part)) return false;
  if (const modeler::Joint* joint = one.thing.part(part).joint) return joint->freedoms() != 0;
  return !choice.all || one.thing.actor || tracks.contains(part);
}

// Changes by `make(thing's name, part, track)` the tracks of chosen parts, also of those that have no key yet.
template <typename Make>
Remarks key_parts(document::Json& film, const Film& meaning, const Choice& choice, Make make) {
  std::vector<Chosen> chosen = choose(film, meaning, choice);
  std::vector<Tracks> changed;
  for (const Chosen& one : chosen) {
    Tracks& tracks = changed.emplace_back(tracks_of(*one.thing.json));
    for (const std::string& part : one.parts)
      if (keyable(one, part, tracks, choice)) make(one.thing.name, one.thing.part(part), tracks[part]);
  }
  Remarks remarks = left_out(meaning, choice);
  for (std::size_t i = 0; i < chosen.size(); ++i) append(remarks, put(chosen[i], changed[i]));
  return remarks;
}

}  // namespace

std::optional<FrameRange> split_way(Track& track, std::uint32_t frame, const ValueAt& value_at) {
  const auto next = std::find_if(track.begin(), track.end(), [&](const TrackKey& k) { return k.frame >= frame; });
  if (next != track.end() && next->frame == frame) {
    next->value = value_at(frame);
    return std::nullopt;
  }
  const auto before = static_cast<std::size_t>(next - track.begin()) - 1;  // of none: not used
  if (next != track.begin()) keep_slopes(track, track[before].frame);
  if (next != track.end()) keep_slopes(track, next->frame);
  TrackKey key{frame, value_at(frame), kLinear};
  if (next == track.end() && !track.empty() && track.back().ease.spline) {  // it led nowhere, and still does
    track.back().ease = kLinear;
    track.back().out = nullptr;
  }
  if (next != track.begin() && next != track.end() && !split_between(track, before, key, value_at))
    return key_all(track, before, value_at);
  put_key(track, std::move(key));
  return std::nullopt;
}

std::string remark_of_split(const std::string& thing, const KeyedPart& part, FrameRange keyed) {
  return thing + ", " + shown_part(part.name) + ": has a key at each of the frames " + std::to_string(keyed.first) +
         " to " + std::to_string(keyed.last) + ", for its way there cannot be split (reduce may thin them out)";
}

Remarks put(const Chosen& chosen, const Tracks& tracks) {
  const Thing& thing = chosen.thing;
  const Tracks before = tracks_of(*thing.json, chosen.parts);
  put_tracks(*thing.json, tracks);
  return side_effects(chosen, before, tracks_of(*thing.json, chosen.parts));
}

Remarks make_keys(document::Json& film, const Film& meaning, const Choice& choice, std::uint32_t frame,
                  const std::optional<Ease>& ease, Beyond beyond) {
  Remarks clamped;
  Remarks remarks =
      key_parts(film, meaning, choice, [&](const std::string& thing, const KeyedPart& part, Track& track) {
        const auto there = [&](std::uint32_t at) { return key_there(thing, part, at, beyond, clamped); };
        if (const auto all = split_way(track, frame, there)) clamped.push_back(remark_of_split(thing, part, *all));
        if (ease) key_at(track, frame)->ease = *ease;
      });
  append(clamped, remarks);
  return clamped;
}

Remarks cut(document::Json& film, const Film& meaning, const Choice& choice, std::uint32_t frame) {
  if (frame == 0) throw Failure("has nothing before it", "frame 0", "cut at a later frame");
  Remarks remarks;
  const auto cut_part = [&](const std::string& thing, const KeyedPart& part, Track& track) {
    if (part.name == "attach") return;  // holds anyway
    const auto there = [&](std::uint32_t at) { return key_there(thing, part, at, Beyond::refused, remarks); };
    const auto later = std::ranges::find_if(track, [&](const TrackKey& key) { return key.frame >= frame; });
    const bool holds = later != track.begin() && (std::prev(later)->ease.hold || !leads_on(track, *std::prev(later)));
    const std::uint32_t last = holds ? std::prev(later)->frame : later == track.begin() ? 0 : frame - 1;
    const auto all = holds ? std::nullopt : split_way(track, last, there);
    if (all) remarks.push_back(remark_of_split(thing, part, *all));
    split_way(track, frame, there);
    keep_slopes(track, last);
    keep_slopes(track, frame);
    TrackKey& stays = *key_at(track, last);
    stays.ease = kHold;
    stays.out = key_at(track, frame)->in = nullptr;
  };
  append(remarks, key_parts(film, meaning, choice, cut_part));
  return remarks;
}

Remarks move_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range, std::uint32_t to) {
  return displace(film, meaning, choice, range, to, false);
}

Remarks copy_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range, std::uint32_t to) {
  return displace(film, meaning, choice, range, to, true);
}

Remarks delete_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range) {
  return change_tracks(film, meaning, choice, shown_range(range),
                       [&](const Chosen&, const std::string&, Track& track) { return !taken(track, range).empty(); });
}

Remarks ease_keys(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range, const Ease& ease) {
  return change_tracks(film, meaning, choice, shown_range(range), [&](const Chosen&, const std::string&, Track& track) {
    bool any = false;
    for (TrackKey& key : track)
      if (range.holds(key.frame)) {
        key.ease = ease;
        any = true;
      }
    return any;
  });
}

Remarks hold(document::Json& film, const Film& meaning, const Choice& choice, std::uint32_t frame,
             std::uint32_t frames) {
  Remarks none;
  return change_tracks(film, meaning, choice, "to hold", [&](const Chosen& one, const std::string& name, Track& track) {
    const bool moves_there = track.front().frame <= frame && frame < track.back().frame;
    if (moves_there) {
      const KeyedPart& part = one.thing.part(name);
      split_way(track, frame,
                [&](std::uint32_t at) { return key_there(one.thing.name, part, at, Beyond::refused, none); });
      keep_slopes(track, frame);
    }
    remap(track, one.thing.name, [&](std::uint32_t f) { return std::int64_t{f} + (f > frame ? frames : 0); });
    if (moves_there) {
      TrackKey& start = *key_at(track, frame);
      TrackKey end = start;
      end.frame = frame_from(std::int64_t{frame} + frames, one.thing.name);
      if (start.ease.spline) start.ease = kLinear;
      start.out = end.in = nullptr;
      put_key(track, end);
    }
    return true;
  });
}

Remarks stretch(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range, double factor) {
  if (range.last <= range.first || !(factor > 0))
    throw Failure("cannot be stretched " + document::shown(factor) + " times", "what is keyed " + shown_range(range),
                  "name two frames and a factor above 0, like 24-48 and 1.5");
  const double length = double(range.last) - range.first;
  const auto added = static_cast<std::int64_t>(std::llround(length * factor - length));
  return change_tracks(film, meaning, choice, shown_range({range.first, kMostFrames}),
                       [&](const Chosen& one, const std::string&, Track& track) {
                         scale_slopes(track, range.first, range.last, length / (length + added));
                         remap(track, one.thing.name, [&](std::uint32_t f) -> std::int64_t {
                           if (f <= range.first) return f;
                           if (f >= range.last) return f + added;
                           return range.first + std::llround((f - range.first) * (length + added) / length);
                         });
                         return track.back().frame > range.first;
                       });
}

Remarks shift(document::Json& film, const Film& meaning, const Choice& choice, std::uint32_t frame, std::int64_t by) {
  return change_tracks(film, meaning, choice, shown_range({frame, kMostFrames}),
                       [&](const Chosen& one, const std::string&, Track& track) {
                         const bool any = track.back().frame >= frame;
                         remap(track, one.thing.name, [&](std::uint32_t f) { return f + (f >= frame ? by : 0); });
                         return any;
                       });
}

std::uint32_t last_key(const document::Json& film) {
  std::uint32_t last = 0;
  const auto look = [&](const document::Json& thing) {
    if (const auto keys = thing.find("keys"); keys != thing.end() && !keys->empty())
      last = std::max(last, keys->back().at("frame").get<std::uint32_t>());
  };
  look(film.at("camera"));
  for (const char* group : {"lights", "materials", "actors"})
    if (const auto found = film.find(group); found != film.end())
      for (const document::Json& thing : *found) look(thing);
  return last;
}

}  // namespace mars::animator
