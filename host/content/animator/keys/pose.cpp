#include "host/content/animator/keys/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/matrix.hpp>
#include <map>
#include <set>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/pose/axis_turn.h"
#include "host/content/animator/pose/rotation.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/keys/frame_words.h"
#include "host/content/animator/keys/pops.h"
#include "host/content/animator/keys/set_key.h"
#include "host/content/animator/keys/tracks.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/fields.h"
#include "host/content/modeler/frames.h"

namespace mars::animator {
namespace {

constexpr double kNoChange = 1e-7;  // of a number: less is what nine digits leave out
constexpr double kAsAsked = 1e-3;   // degrees: a turn that misses less is the one that was asked for

double number_after(const PartSetting& setting, std::size_t axis, double now) {
  if (!setting.numbers[axis]) return now;
  return setting.relative ? rounded(now + *setting.numbers[axis]) : *setting.numbers[axis];
}

// A point that goes along with an actor (`now`) goes on along with it: its offset changes.
document::Json point_after(const PartSetting& setting, document::Json now) {
  glm::dvec3 offset = now.contains("offset") ? vector_of(now.at("offset")) : glm::dvec3(0);
  for (int axis = 0; axis < 3; ++axis) offset[axis] = number_after(setting, axis, offset[axis]);
  now["offset"] = written(offset);
  return now;
}

// The joint, where the part turns about three axes; else null.
const modeler::Joint* joint_of(const KeyedPart& part) { return part.joint ? part.joint : part.turns; }

// A value of the part, as its key holds it.
document::Json held(const Thing& thing, const KeyedPart& part, const glm::dvec3& pose, Beyond beyond, Remarks& remarks,
                    const std::string& asked = "") {
  return written(part.joint ? within_limits(thing.name, *part.joint, pose, beyond, remarks, asked) : pose);
}

// The axis of a turn about one, as require_own_turn() has checked.
int axis_of(const PartSetting& setting) {
  int axis = 0;
  while (!setting.numbers[static_cast<std::size_t>(axis)]) ++axis;
  return axis;
}

// Turned about its own axis. The setting names one.
document::Json value_after_own_turn(const PartSetting& setting, const Thing& thing, const document::Json& now,
                                    Beyond beyond, Remarks& remarks) {
  const KeyedPart& part = thing.part(setting.part);
  const int axis = axis_of(setting);
  const double degrees = *setting.numbers[static_cast<std::size_t>(axis)];
  const Turned turned = turned_about_own(*joint_of(part), vector_of(now), axis, degrees);
  const std::string asked = "turned " + document::shown(degrees) + " degrees about its own " + "xyz"[axis];
  if (!turned.reached()) {
    const std::string what = asked + ", stands as its skewed axes do not reach",
                      name = thing.name + ", joint '" + shown_part(part.name) + "'";
    if (beyond == Beyond::refused)
      throw Failure(what, name, "--clamp takes what comes near, or turn it about another axis");
    remarks.push_back(name + ": " + what + ": keyed near that");
  }
  return held(thing, part, rounded(turned.pose), beyond, remarks, asked);
}

// What the part is to be: its numbers `now`, those given exchanged.
document::Json value_after(const PartSetting& setting, const Thing& thing, document::Json now, const PoseManner& manner,
                           Remarks& remarks) {
  if (manner.local) return value_after_own_turn(setting, thing, now, manner.beyond, remarks);
  if (now.is_object()) return point_after(setting, std::move(now));
  if (!now.is_array()) return written(number_after(setting, 0, now.get<double>()));
  for (std::size_t axis = 0; axis < now.size(); ++axis)
    now[axis] = written(number_after(setting, axis, now[axis].get<double>()));
  const KeyedPart& part = thing.part(setting.part);
  return part.joint ? held(thing, part, vector_of(now), manner.beyond, remarks) : now;
}

// Refuses what is no turn about one axis.
void require_own_turn(const PartSetting& setting, const std::string& text, const Thing& thing) {
  const auto given = std::ranges::count_if(setting.numbers, [](const auto& number) { return number.has_value(); });
  if (!joint_of(thing.part(setting.part)))
    throw Failure("is no joint that could turn about its own axis", thing.name + ", '" + shown_part(setting.part) + "'",
                  "--local turns joints and whole actors; leave it out here");
  if (!setting.relative || given != 1)
    throw Failure("is no turn about one axis", "'" + text + "'", "with --local write it like elbow.x+=30");
}

// A pattern that matches parts that turn means these alone: degrees are no lengths.
std::vector<PartSetting> settings_of(const std::string& text, const Thing& thing) {
  std::vector<PartSetting> settings = read_settings(text, thing);
  const auto turns = [&](const PartSetting& setting) { return joint_of(thing.part(setting.part)) != nullptr; };
  if (std::ranges::any_of(settings, turns)) std::erase_if(settings, std::not_fn(turns));
  return settings;
}

// Refuses an axis that an earlier setting has set; `set` are the parts and axes of those.
void refuse_twice(const PartSetting& setting, const std::string& text, std::set<std::pair<std::string, int>>& set) {
  for (int axis = 0; axis < 3; ++axis)
    if (setting.numbers[axis] && !set.emplace(setting.part, axis).second)
      throw Failure("sets what an earlier word has set", "'" + text + "'", "give each part and axis once");
}

// A new key goes on as the way did on which it stands, else linearly, whatever eases other parts have there.
Ease ease_there(const Track& track, std::uint32_t frame) {
  for (std::size_t i = 0; i + 1 < track.size(); ++i)
    if (track[i].frame <= frame && frame < track[i + 1].frame) return track[i].ease;
  return kLinear;
}

// From a key's value to another: its numbers. Of a point that goes along with an actor none.
std::array<double, 3> change_between(const document::Json& from, const document::Json& to) {
  std::array<double, 3> change{};
  if (from.is_number() && to.is_number()) change[0] = to.get<double>() - from.get<double>();
  if (from.is_array() && to.is_array())
    for (std::size_t axis = 0; axis < from.size(); ++axis)
      change[axis] = to[axis].get<double>() - from[axis].get<double>();
  return change;
}

// A change of a key, as the keys beside it take a part of it.
struct Change {
  std::array<double, 3> numbers;
  std::optional<Turn> own{};  // instead: a turn about an axis in the joint's own frame, of any angle
};

// Gathers settings of one thing, then makes them its keys.
class Posing {
 public:
  Posing(document::Json& film, const Film& meaning, const std::string& name, const PoseManner& manner)
      : chosen_(std::move(choose(film, meaning, {false, name, {}}).front())),
        before_(tracks_of(*chosen_.thing.json)),
        tracks_(before_),
        last_frame_(meaning.frames - 1),
        manner_(manner) {}

  const Thing& thing() const { return chosen_.thing; }

  void set(const PartSetting& setting, std::uint32_t frame) {
    const KeyedPart& part = thing().part(setting.part);
    Track& track = tracks_[part.name];
    touch(part, {frame, frame});
    if (track.empty() && frame > 0 && !part.unset) track.push_back({0, part.key_at(0), kLinear});
    TrackKey* key = key_at(track, frame);
    // A second setting for the part keeps what the first one set.
    const bool again = !set_.insert(part.name).second;
    settings_[part.name].push_back(setting);
    const document::Json now = again ? key->value : setting.relative ? part.key_at(frame) : part.value_at(frame);
    document::Json value = value_after(setting, thing(), now, manner_, remarks_);
    if (key != nullptr)
      key->value = std::move(value);
    else
      put_key(track, {frame, std::move(value), ease_there(track, frame)});
    frames_.insert(frame);
  }

  // All keys that the part has there; whether it has any.
  bool turn_keys(const PartSetting& setting, FrameRange range) {
    const auto track = tracks_.find(setting.part);
    if (track == tracks_.end()) return false;
    const auto held = [&](const TrackKey& key) { return range.holds(key.frame); };
    const Track& keys = track->second;
    const auto first = std::find_if(keys.begin(), keys.end(), held);
    if (first == keys.end()) return false;
    touch(thing().part(setting.part), {first->frame, std::find_if(keys.rbegin(), keys.rend(), held)->frame});
    settings_[setting.part].push_back(setting);
    for (TrackKey& key : track->second) {
      if (!range.holds(key.frame)) continue;
      key.value = value_after(setting, thing(), key.value, manner_, remarks_);
      frames_.insert(key.frame);
    }
    return true;
  }

  Remarks put() {
    std::set<std::string> parts;
    for (const auto& [part, range] : touched_) {
      parts.insert(part);
      manner_.falloff > 0 ? blend(part, range) : find_pops(part, range);
    }
    for (const std::uint32_t frame : frames_)
      if (manner_.ease) set_ease(tracks_, parts, frame, *manner_.ease);
    if (const std::string remark = remark_of(thing().name, pops_); !remark.empty()) remarks_.push_back(remark);
    chosen_.parts.assign(parts.begin(), parts.end());
    const Remarks more = animator::put(chosen_, tracks_);
    remarks_.insert(remarks_.end(), more.begin(), more.end());
    return std::move(remarks_);
  }

 private:
  // Before its first change. Keys where its blend ends keep what is beyond them as it is.
  void touch(const KeyedPart& part, FrameRange range) {
    if (!touched_.emplace(part.name, range).second || manner_.falloff == 0) return;
    Track& track = tracks_[part.name];
    const auto hold = [&](std::uint32_t frame) {
      const auto value_at = [&](std::uint32_t at) { return part.key_at(at); };
      if (const auto all = split_way(track, frame, value_at))
        remarks_.push_back(remark_of_split(thing().name, part, *all));
    };
    const FrameRange shot = shot_of(track, range), later{range.last + 1, range.last + manner_.falloff};
    // The first pose of a shot is where its motion begins: without keys near by, there is none to which to go back.
    const bool begins_shot = shot.first == range.last &&
                             std::ranges::none_of(track, [&](const TrackKey& key) { return later.holds(key.frame); });
    hold(std::max(shot.first, range.first - std::min(range.first, manner_.falloff)));
    if (!begins_shot && later.last <= std::min(shot.last, last_frame_)) hold(later.last);
  }

  // The frames between the cuts around the range: no change is blended across one, nor along a value that is held to
  // the next cut.
  static FrameRange shot_of(const Track& track, FrameRange range) {
    FrameRange shot{0, wire::kMostFrames};
    for (std::size_t i = 0; i < track.size(); ++i) {
      if (!track[i].ease.hold) continue;
      const std::uint32_t cut = i + 1 < track.size() ? track[i + 1].frame : wire::kMostFrames;
      if (track[i].frame < range.first) shot.first = std::min(cut, range.first);
      if (cut > range.last) shot.last = std::min(shot.last, std::max(track[i].frame, range.last));
    }
    return shot;
  }

  // The keys beside the range change with its end, the less the farther they are from it.
  void blend(const std::string& part, FrameRange range) {
    Track& track = tracks_[part];
    const auto change_at = [&](std::uint32_t frame) {
      return change_of(thing().part(part), thing().part(part).value_at(frame), key_at(track, frame)->value);
    };
    const Change at_first = change_at(range.first), at_last = change_at(range.last);
    Remarks clamped;
    const FrameRange shot = shot_of(before_[part], range);
    for (TrackKey& key : track) {
      if (range.holds(key.frame) || !shot.holds(key.frame)) continue;
      const bool earlier = key.frame < range.first;
      const std::uint32_t away = earlier ? range.first - key.frame : key.frame - range.last;
      if (away < manner_.falloff) change(key, part, earlier ? at_first : at_last, share_at(away), clamped);
    }
    if (clamped.size() > 1) clamped.front() += ", and so " + document::counted(clamped.size() - 1, "other number");
    if (!clamped.empty()) remarks_.push_back(clamped.front());
  }

  double share_at(std::uint32_t away) const {
    const double near = 1 - double(away) / manner_.falloff;
    return near * near * (3 - 2 * near);
  }

  // The turn that took `from` to `to`, as one setting asked for it, which may be more than half a turn. None where
  // several settings turned the part, or limits kept it from the turn.
  std::optional<Turn> asked_turn(const KeyedPart& part, const glm::dvec3& from, const glm::dvec3& to) const {
    const std::vector<PartSetting>& settings = settings_.at(part.name);
    if (settings.size() != 1) return std::nullopt;
    const int axis = axis_of(settings.front());
    const double degrees = *settings.front().numbers[static_cast<std::size_t>(axis)];
    const glm::dvec3 present = present_axis(*part.turns, from, axis);
    const glm::dmat3 turned = modeler::rotation_by_degrees(present, degrees) * modeler::orientation(*part.turns, from);
    const Turn missed = turn_between(turned, modeler::orientation(*part.turns, to));
    if (missed.angle > kAsAsked * modeler::kDegree) return std::nullopt;
    return Turn{present_axis(*part.turns, {}, axis), degrees * modeler::kDegree};
  }

  // A turn about an own axis may change all three numbers: keys beside it take a part of the turn, not of the numbers.
  Change change_of(const KeyedPart& part, const document::Json& from, const document::Json& to) const {
    Change change{change_between(from, to)};
    if (!manner_.local || !part.turns) return change;
    const glm::dvec3 before = vector_of(from), after = vector_of(to);
    const auto seen_from_joint = [&](const glm::dvec3& pose) {
      return glm::transpose(modeler::orientation(*part.turns, pose));
    };
    change.own = asked_turn(part, before, after);
    if (!change.own) change.own = turn_between(seen_from_joint(after), seen_from_joint(before));
    return change;
  }

  void change(TrackKey& key, const std::string& name, const Change& by, double share, Remarks& remarks) {
    const KeyedPart& part = thing().part(name);
    if (by.own) {
      const glm::dvec3 pose = vector_of(key.value);
      const glm::dvec3 axis = modeler::orientation(*part.turns, pose) * by.own->axis;
      const Turned turned = turned_about(*part.turns, pose, axis, share * by.own->angle / modeler::kDegree, pose);
      key.value = held(thing(), part, rounded(turned.pose), manner_.beyond, remarks);
      return;
    }
    PartSetting setting{name, {}, true};
    for (std::size_t axis = 0; axis < by.numbers.size(); ++axis)
      if (std::abs(by.numbers[axis]) > kNoChange) setting.numbers[axis] = share * by.numbers[axis];
    key.value = value_after(setting, thing(), key.value, {.beyond = manner_.beyond}, remarks);
  }

  void find_pops(const std::string& part, FrameRange range) {
    if (range.first != range.last) return;
    if (const auto pop = pop_at(thing().part(part), before_[part], tracks_[part], range.first)) pops_.push_back(*pop);
  }

  Chosen chosen_;
  Tracks before_, tracks_;
  std::uint32_t last_frame_;  // of the film
  const PoseManner& manner_;
  std::map<std::string, FrameRange> touched_;                 // parts, and of each where its keys are set
  std::set<std::string> set_;                                 // parts
  std::map<std::string, std::vector<PartSetting>> settings_;  // of each part
  std::set<std::uint32_t> frames_;
  std::vector<Pop> pops_;
  Remarks remarks_;
};

void turn_all_keys(Posing& posing, const std::vector<PartSetting>& settings, FrameRange range,
                   const std::string& text) {
  if (!settings.front().relative)
    throw Failure("sets numbers " + shown_range(range), "'" + text + "'",
                  "name one frame, or turn what is keyed there by += or -=");
  bool any = false;
  for (const PartSetting& setting : settings) any |= posing.turn_keys(setting, range);
  if (!any)
    throw Failure("finds no key of " + posing.thing().name + " " + shown_range(range), "'" + text + "'",
                  "name one frame to make a key there; `mars animate FILM list` shows what is keyed");
}

// Keys of its place and turn may be meant for later; there they count for nothing.
void remark_carried(const Film& meaning, const std::string& name, std::span<const PartSetting> settings,
                    std::uint32_t frame, Remarks& remarks) {
  const auto actor = std::ranges::find(meaning.actors, name, &Actor::name);
  const Attachment* const carrier = actor == meaning.actors.end() ? nullptr : attachment_at(*actor, frame);
  const auto moves = [](const PartSetting& setting) { return setting.part == "place" || setting.part == "turn"; };
  if (!carrier || std::ranges::none_of(settings, moves)) return;
  remarks.push_back(
      "actor '" + name + "': '" + meaning.actors[carrier->actor].name + "' carries it at frame " +
      std::to_string(frame) +
      ", where its own place and turn count for nothing (detach it, or attach it with --place and --turn)");
}

bool is_turn(const glm::dvec3& degrees) {
  return std::ranges::all_of(std::array{degrees.x, degrees.y, degrees.z},
                             [](double angle) { return std::abs(angle) <= keys::kDegrees.highest; });
}

void show_key(Actor& actor, const modeler::Model& model, const std::string& part, const glm::dvec3& value,
              std::uint32_t frame) {
  if (part == "place") return set_key(actor.motion.place, value, frame, {});
  if (part == "turn") return set_key(actor.motion.turn, value, frame, {});
  const auto joint = std::ranges::find(model.joints, part.substr(1), &modeler::Joint::name);
  set_key(actor.motion.pose[static_cast<std::size_t>(joint - model.joints.begin())], value, frame, joint->rest());
}

}  // namespace

Remarks pose(document::Json& film, const Film& meaning, const std::string& name, std::span<const PartSetting> settings,
             std::uint32_t frame, const PoseManner& manner) {
  Posing posing(film, meaning, name, manner);
  for (const PartSetting& setting : settings) posing.set(setting, frame);
  Remarks remarks = posing.put();
  remark_carried(meaning, name, settings, frame, remarks);
  return remarks;
}

Remarks pose(document::Json& film, const Film& meaning, const std::string& name, std::span<const std::string> settings,
             FrameRange range, const PoseManner& manner) {
  Posing posing(film, meaning, name, manner);
  std::set<std::pair<std::string, int>> set;
  std::vector<PartSetting> all;
  for (const std::string& text : settings) {
    const std::vector<PartSetting> parts = settings_of(text, posing.thing());
    for (const PartSetting& part : parts) {
      refuse_twice(part, text, set);
      if (manner.local) require_own_turn(part, text, posing.thing());
    }
    all.insert(all.end(), parts.begin(), parts.end());
    if (range.first != range.last)
      turn_all_keys(posing, parts, range, text);
    else
      for (const PartSetting& part : parts) posing.set(part, range.first);
  }
  Remarks remarks = posing.put();
  remark_carried(meaning, name, all, range.first, remarks);
  return remarks;
}

bool show_pose(Film& film, document::Json& json, const std::string& name, std::span<const std::string> settings,
               std::uint32_t frame, Beyond beyond, Remarks& remarks) {
  const auto actor = std::ranges::find(film.actors, name, &Actor::name);
  if (actor == film.actors.end()) return false;
  const Thing thing = std::move(choose(json, film, {false, name, {}}).front().thing);
  std::set<std::pair<std::string, int>> set;
  std::map<std::string, glm::dvec3> values;
  std::vector<PartSetting> all;
  for (const std::string& text : settings)
    for (const PartSetting& setting : read_settings(text, thing)) {
      refuse_twice(setting, text, set);
      const auto again = values.find(setting.part);
      const document::Json now =
          again == values.end() ? thing.part(setting.part).value_at(frame) : written(again->second);
      values[setting.part] = vector_of(value_after(setting, thing, now, {.beyond = beyond}, remarks));
      all.push_back(setting);
    }
  for (const auto& [part, value] : values)
    if (part == "turn" && !is_turn(value)) return false;
  for (const auto& [part, value] : values) show_key(*actor, film.models[actor->model], part, value, frame);
  remark_carried(film, name, all, frame, remarks);
  return true;
}

}  // namespace mars::animator
