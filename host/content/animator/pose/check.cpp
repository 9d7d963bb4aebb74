#include "host/content/animator/pose/check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/pose/check_pictures.h"
#include "host/content/animator/pose/joint_frames.h"
#include "host/content/animator/pose/limits_left.h"
#include "host/content/document/fields.h"
#include "host/content/document/shell_word.h"

namespace mars::animator {
namespace {

constexpr std::size_t kMostWarnings = 10;  // of joints
constexpr double kAlike = 0.5;             // of a step: as much of it is in the one beside it where a thing flies
constexpr int kFlight = 2;                 // such steps beside it
constexpr double kFall = 0.1;              // of its size: less is no jump when an actor is let go

std::string rounded_text(double number) { return document::shown(std::round(number * 100) / 100); }

// "actor 'anna', joint 'knee': turns 95 degrees about y between keys, outside its limits 0 to 90, in frame 12"
std::string words_of(const Film& film, const WorstExcess& worst) {
  const Actor& actor = film.actors[worst.actor];
  const modeler::Joint& joint = film.models[actor.model].joints[worst.joint];
  std::string text = "actor '" + actor.name + "', joint '" + joint.name + "': ";
  if (worst.axis == 3) {
    text += "its skewed axes do not reach where it turns between keys, by " + rounded_text(worst.angle) + " degrees";
  } else {
    const modeler::Limits& limits = joint.limits[worst.axis];
    text += "turns " + rounded_text(worst.angle) + " degrees about " + "xyz"[worst.axis] + " between keys, ";
    text += limits.free()
                ? "outside its limits " + document::shown(limits.lower) + " to " + document::shown(limits.upper)
                : "where it is locked at " + document::shown(limits.lower);
  }
  return text + ", in frame " + std::to_string(worst.frame);
}

// What to type, after `program`.
std::string remedy_of(const Film& film, const WorstExcess& worst, const std::string& program) {
  const Actor& actor = film.actors[worst.actor];
  const modeler::Joint& joint = film.models[actor.model].joints[worst.joint];
  return " (fix it with: " + program + "key " + document::shell_word(actor.name) + " " +
         document::shell_word(joint.name) + " --frame " + std::to_string(worst.frame) + " --clamp)";
}

std::string line_of(const Film& film, const LimitsLeft& left) {
  std::string text = words_of(film, left.worst);
  if (left.frames > 1)
    text += ", the worst of " + std::to_string(left.frames) + " from " + std::to_string(left.first) + " to " +
            std::to_string(left.last);
  return text + remedy_of(film, left.worst, "");
}

template <typename Value>
bool changes(const Channel<Value>& channel) {
  for (std::size_t i = 0; i + 1 < channel.size(); ++i)
    if (moves_after(channel, i)) return true;
  return false;
}

bool keyed(const Actor& actor) {
  const auto several = [](const auto& channel) { return channel.size() > 1; };
  return several(actor.motion.place) || several(actor.motion.turn) ||
         std::any_of(actor.motion.pose.begin(), actor.motion.pose.end(), several);
}

bool moves(const Actor& actor) {
  return changes(actor.motion.place) || changes(actor.motion.turn) ||
         std::any_of(actor.motion.pose.begin(), actor.motion.pose.end(), [](const auto& c) { return changes(c); });
}

// How far a figure reaches, about: all its bones in a row, and the longest edge of its boxes.
double size_of(const modeler::Model& model) {
  double bones = 0, edge = 0;
  for (const modeler::Joint& joint : model.joints) {
    if (joint.parent != modeler::kNone) bones += glm::length(joint.place);
    if (!joint.segment) continue;
    const glm::dvec3 box = joint.segment->sbb.max - joint.segment->sbb.min;
    edge = std::max({edge, box.x, box.y, box.z});
  }
  return bones + edge;
}

// What flies fast goes about as far in the frames beside it, two at least, and in one of them in the same direction; in
// another it may meet a floor.
bool flies(const Channel<glm::dvec3>& place, std::uint32_t frame, const glm::dvec3& step) {
  const auto step_from = [&](std::uint32_t from) { return value_at(place, from + 1) - value_at(place, from); };
  int as_far = 0;
  bool on = false;
  const auto looks_on = [&](std::uint32_t from) {
    const glm::dvec3 other = step_from(from);
    if (glm::length(other) < kAlike * glm::length(step)) return false;
    on = on || glm::dot(other, step) >= kAlike * glm::dot(step, step);
    return ++as_far < kFlight;
  };
  for (std::uint32_t from = frame; from > 0 && looks_on(from - 1);) --from;
  for (std::uint32_t from = frame + 1; looks_on(from);) ++from;
  return on && as_far >= kFlight;
}

void find_jumps(const Film& film, const Actor& actor, std::vector<std::string>& lines) {
  const double size = size_of(film.models[actor.model]);
  const auto& place = actor.motion.place;
  for (std::size_t i = 0; i + 1 < place.size(); ++i) {
    if (place[i].ease.hold) continue;  // it is meant to jump
    const glm::dvec3 step = place[i + 1].value - place[i].value;
    const double way = glm::length(step);
    if (place[i + 1].frame != place[i].frame + 1 || way <= size || size == 0) continue;
    if (flies(place, place[i].frame, step)) continue;
    if (attachment_at(actor, place[i].frame) || attachment_at(actor, place[i + 1].frame)) continue;
    lines.push_back("actor '" + actor.name + "': jumps " + document::shown(std::round(way * 1000) / 1000) +
                    " from frame " + std::to_string(place[i].frame) + " to the next, farther than it is long");
  }
}

// Where nothing carries it any more, it should be where it would have been carried to.
void find_falls(const Film& film, std::size_t number, std::vector<std::string>& lines) {
  const Actor& actor = film.actors[number];
  const double size = size_of(film.models[actor.model]);
  JointFrames frames(film);
  for (std::size_t i = 1; i < actor.attach.size(); ++i) {
    const std::uint32_t frame = actor.attach[i].frame;
    if (!actor.attach[i - 1].value || actor.attach[i].value || frame >= film.frames) continue;
    const Attachment& carrier = *actor.attach[i - 1].value;
    const modeler::Axes carried = within(frames.frame_of(carrier.actor, carrier.joint, frame), axes_of(carrier));
    const double way = glm::length(frames.root_of(number, frame).place - carried.place);
    if (way <= kFall * size) continue;
    lines.push_back("actor '" + actor.name + "': jumps " + document::shown(std::round(way * 1000) / 1000) +
                    " where it is detached at frame " + std::to_string(frame) + " (fix it with: detach " +
                    document::shell_word(actor.name) + " --frame " + std::to_string(frame) + ")");
  }
}

template <typename... Channels>
std::uint32_t last_of(const Channels&... channels) {
  return std::max({(channels.empty() ? 0u : channels.back().frame)...});
}

std::uint32_t last_key(const CameraMotion& c) {
  return last_of(c.eye, c.at, c.up, c.fov, c.height, c.shift, c.exposure);
}

std::uint32_t last_key(const LightMotion& l) {
  return last_of(l.vector, l.color, l.intensity, l.reach, l.at, l.cone, l.size);
}

std::uint32_t last_key(const MaterialMotion& material) {
  std::uint32_t last = last_of(material.color);
  for (const Channel<double>& numbers : material.numbers) last = std::max(last, last_of(numbers));
  return last;
}

// A key just behind the end is where a film that is played round and round begins again.
void find_late_keys(const Film& film, const std::string& name, std::uint32_t last, std::vector<std::string>& lines) {
  if (last > film.frames)
    lines.push_back(name + ": has keys up to frame " + std::to_string(last) + ", behind the film's last, " +
                    std::to_string(film.frames - 1) + " (give the film more frames, or delete them)");
}

void find_late_keys(const Film& film, std::vector<std::string>& lines) {
  find_late_keys(film, "camera", last_key(film.camera), lines);
  for (std::size_t i = 0; i < film.lights.size(); ++i)
    find_late_keys(film, "light/" + std::to_string(i + 1), last_key(film.lights[i]), lines);
  for (const MaterialMotion& material : film.materials)
    find_late_keys(film, "material/" + material.name, last_key(material), lines);
}

void find_missing_sound(const Film& film, std::vector<std::string>& lines) {
  const std::string trouble = film.audio.empty() ? "" : document::file_trouble(film.audio);
  if (trouble.empty()) return;
  lines.push_back("audio: is " + document::in_quotes(document::printable(film.audio.string(), 1000)) + ", " + trouble +
                  ": no video can be made (name another file: mars film " + document::shell_word(film.source) +
                  " set audio=FILE)");
}

}  // namespace

Findings check_film(const Film& film) {
  Findings findings;
  std::vector<std::string>& lines = findings.lines;
  std::size_t small = 0;
  for (const LimitsLeft& left : limits_left(film))
    left.worst.outside > kExcessSeen ? lines.push_back(line_of(film, left)) : void(++small);
  for (std::size_t number = 0; number < film.actors.size(); ++number) {
    const Actor& actor = film.actors[number];
    const std::string name = "actor '" + actor.name + "'";
    find_late_keys(film, name, last_key(actor), lines);
    if (actor.attach.empty() && keyed(actor) && !moves(actor))
      lines.push_back(name + ": has keys that are all the same: it never moves");
    find_jumps(film, actor, lines);
    find_falls(film, number, lines);
  }
  find_late_keys(film, lines);
  find_missing_sound(film, lines);
  find_lost_shadows(film, lines);
  find_unfit_planes(film, lines);
  findings.trouble = !lines.empty();
  if (small > 0)
    lines.push_back(std::to_string(small) + (lines.empty() ? "" : " more") +
                    (small == 1 ? " joint is outside its" : " joints are outside their") +
                    " limits between keys by less than " + document::shown(kExcessSeen) + " degrees");
  return findings;
}

std::vector<std::string> warnings_of(const Film& film) {
  std::vector<std::string> lines;
  const std::string animate = "mars animate " + document::shell_word(film.source) + " ";
  const std::vector<WorstExcess> worst = worst_excesses(film);
  for (const WorstExcess& each : worst) {
    if (lines.size() == kMostWarnings) {
      const std::size_t more = worst.size() - kMostWarnings;
      lines.push_back(film.source + ": " + std::to_string(more) +
                      (more == 1 ? " more joint leaves its limits" : " more joints leave their limits") +
                      " between keys (" + animate + "check lists all)");
      break;
    }
    lines.push_back(film.source + ": " + words_of(film, each) + remedy_of(film, each, animate));
  }
  std::vector<std::string> others;
  find_missing_sound(film, others);
  find_unfit_planes(film, others);
  for (const std::string& line : others) lines.push_back(film.source + ": " + line);
  return lines;
}

}  // namespace mars::animator
