#include "host/preview/pose_keys.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "hal/failure/explain.h"
#include "host/content/animator/keys/edit.h"
#include "host/content/animator/pose/angles.h"
#include "host/content/animator/pose/axis_turn.h"
#include "host/content/document/text.h"

namespace mars::preview {
namespace {

constexpr std::string_view kCharacters = "\t\rioxyzXYZ0dua";
constexpr std::string_view kCompiled =
    "a .mars film has no joints to pose: preview the film file that it was made from";
constexpr double kTurnStep = 5, kFineTurnStep = 1;  // degrees

// "x 10 (-40..40)" of each axis about which the joint turns.
std::string angles_of(const modeler::Joint& joint, const glm::dvec3& pose) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    const modeler::Limits& limits = joint.limits[static_cast<std::size_t>(axis)];
    if (!limits.free()) continue;
    text += std::string("  ") + "xyz"[axis] + " " + document::shown(document::rounded_to(pose[axis], 4)) + " (" +
            document::shown(limits.lower) + ".." + document::shown(limits.upper) + ")";
  }
  return text;
}

}  // namespace

bool is_pose_key(const KeyPress& key) {
  if (key.special != Special::none) return key.special == Special::back_tab || key.special == Special::escape;
  return key.character != 0 && kCharacters.find(key.character) != std::string_view::npos;
}

PoseKeys::PoseKeys(Previewed& film, std::filesystem::path path) : film_(&film), file_(std::move(path)) {
  if (film.source) order_.emplace(*film.source);
}

void PoseKeys::change_film(Previewed& film) {
  std::optional<std::pair<std::string, std::string>> names;
  if (selected_) names = {film_->source->actors[selected_->actor].name, joint().name};
  film_ = &film;
  order_.reset();
  selected_.reset();
  pose_.leave_out(written_);
  written_.clear();
  if (!film.source) return pose_.clear();
  order_.emplace(*film.source);
  pose_.keep_those_of(*film.source);
  if (names) selected_ = joint_named(*film.source, *names);
  if (selected_ && joint().freedoms() == 0) selected_.reset();
}

const modeler::Joint& PoseKeys::joint() const {
  const animator::Film& film = *film_->source;
  return film.model_of(selected_->actor).joints[selected_->joint];
}

bool PoseKeys::handle_key(const KeyPress& key, std::uint32_t frame) {
  said_.clear();
  if (!is_pose_key(key)) return false;
  if (!film_->source)
    said_ = kCompiled;
  else if (order_->empty())
    said_ = "no joint of this film can be posed";
  else
    said_ = done_by(key, frame);
  return true;
}

// What there is to report about it.
std::string PoseKeys::done_by(const KeyPress& key, std::uint32_t frame) {
  if (key.special == Special::escape) return give_up();
  if (key.special == Special::back_tab || key.character == '\t') {
    selected_ = order_->beside(selected_, key.character == '\t' ? 1 : -1);
    return "";
  }
  if (key.character == 'u') return undo();
  if (key.character == 'd') {
    fine_ = !fine_;
    return fine_ ? "steps of 1 degree" : "steps of 5 degrees";
  }
  if (key.character == 'a') {
    own_axes_ = !own_axes_;
    return own_axes_ ? "turns about the joint's own axes as they stand" : "turns by the joint's three numbers";
  }
  if (!selected_) return "Tab selects a joint";
  const double step = fine_ ? kFineTurnStep : kTurnStep;
  switch (key.character) {
    case 'o': selected_ = order_->above(*selected_); return "";
    case 'i': selected_ = order_->below(*selected_); return "";
    case '0': return rest(frame);
    case '\r': return set_key(frame);
    default: break;
  }
  const bool back = std::isupper(static_cast<unsigned char>(key.character)) != 0;
  return turn(key.character - (back ? 'X' : 'x'), back ? -step : step, frame);
}

std::string PoseKeys::turn(int axis, double degrees, std::uint32_t frame) {
  const modeler::Limits& limits = joint().limits[static_cast<std::size_t>(axis)];
  const std::string name = std::string(1, "xyz"[axis]);
  if (!limits.free()) return "does not turn about " + name;
  const glm::dvec3 pose = pose_.pose_at(*film_->source, *selected_, frame);
  if (own_axes_ && !animator::turns_by_number(joint(), pose, axis)) return turn_own(axis, degrees, frame);
  const double now = pose[axis];
  const double wanted = animator::rounded(now + degrees), to = std::clamp(wanted, limits.lower, limits.upper);
  if (to != now) pose_.set(*film_->source, *selected_, axis, to);
  return to == wanted ? "" : name + " stops at its limit";
}

// A step that the limits do not allow is not made in part, which would be another turn.
std::string PoseKeys::turn_own(int axis, double degrees, std::uint32_t frame) {
  const glm::dvec3 now = pose_.pose_at(*film_->source, *selected_, frame);
  const animator::Turned turned = animator::turned_about_own(joint(), now, axis, degrees);
  if (!turned.reached()) return "its skewed axes do not reach that turn";
  const glm::dvec3 outside = animator::excess_of(joint(), turned.pose);
  for (int number = 0; number < 3; ++number)
    if (outside[number] > animator::kAngleRounding)
      return std::string(1, "xyz"[number]) +
             (joint().limits[static_cast<std::size_t>(number)].free() ? " stops at its limit" : " is locked");
  const glm::dvec3 pose = animator::clamped(joint(), animator::rounded(turned.pose));
  for (int number = 0; number < 3; ++number)
    if (pose[number] != now[number]) pose_.set(*film_->source, *selected_, number, pose[number]);
  return "";
}

std::string PoseKeys::rest(std::uint32_t frame) {
  const glm::dvec3 now = pose_.pose_at(*film_->source, *selected_, frame), rest = joint().rest();
  for (int axis = 0; axis < 3; ++axis)
    if (now[axis] != rest[axis]) pose_.set(*film_->source, *selected_, axis, rest[axis]);
  return "";
}

std::string PoseKeys::set_key(std::uint32_t frame) {
  if (!under_way()) return "no joint has been turned";
  if (film_->is_model) return "a model has no keys: its poses are only shown";
  std::string report = "key set at frame " + std::to_string(frame);
  try {
    for (const std::string& remark : file_.set(pose_, frame)) report += "; " + remark;
  } catch (const std::exception& failure) {
    return "no key is set: " + reason_of(failure);
  }
  written_ = pose_.angles();
  return report;
}

std::string PoseKeys::undo() {
  try {
    return file_.undo() ? "the last key is undone" : "no key is left to undo";
  } catch (const std::exception& failure) {
    return "nothing is undone: " + reason_of(failure);
  }
}

// Without a pose, the selection.
std::string PoseKeys::give_up() {
  if (!under_way()) {
    selected_.reset();
    return "";
  }
  pose_.clear();
  written_.clear();
  return "the pose is given up";
}

Posed PoseKeys::posed_at(std::uint32_t frame) const {
  Posed posed;
  if (selected_) posed.selected = *selected_;
  if (!pose_.empty()) posed.figures = pose_.figures(*film_->source, frame);
  return posed;
}

std::string PoseKeys::note(std::uint32_t frame) const {
  if (!selected_) return said_;
  const animator::Film& film = *film_->source;
  std::string text = film.actors[selected_->actor].name + " " + joint().name +
                     angles_of(joint(), pose_.pose_at(film, *selected_, frame));
  if (!said_.empty()) return text + "  " + said_;
  if (!under_way()) return text;
  return text + (film_->is_model ? "  only shown  Esc give up" : "  Enter set key  Esc give up");
}

std::string PoseKeys::keys() {
  return " Tab next joint  Shift-Tab previous joint  o out  i in  x y z X Y Z turn\n"
         " d degrees 5, 1  a own axes  0 rest  Enter key  u undo  Esc give up the pose\n";
}

}  // namespace mars::preview
