#include "host/content/animator/keys/part_setting.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/tracks.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

constexpr const char* kAxes[] = {".x", ".y", ".z"};

// A setting taken apart: "elbow.y-=10" is the part "elbow", axis 1, relative, -10.
struct Typed {
  std::string part;
  std::optional<std::size_t> axis{};
  bool relative = false;
  std::vector<double> numbers{};
};

[[noreturn]] void refuse_setting(const std::string& text) {
  throw Failure("is not PART=NUMBERS", "'" + text + "'",
                "write it like elbow.y=90, elbow.y+=10, elbow=0,90,0, place=2,0,0 or turn.z=45");
}

// How the part is written, by what it is now.
std::string remedy_for(const std::string& part, const document::Json& now) {
  if (!now.is_array()) return "write one number: " + part + "=" + now.dump();
  std::vector<std::string> all;
  for (const document::Json& number : now) all.push_back(number.dump());
  return "write one number for one axis, like " + part + ".y=" + all[1] + ", or " +
         (all.size() == 3 ? "three" : std::to_string(all.size())) + " for all: " + part + "=" +
         document::joined(all, ",");
}

double number_of(std::string_view digits, const std::string& text) {
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  const auto number = document::number_in<double>(digits);
  if (!number || !(*number >= -document::kFarthest && *number <= document::kFarthest))
    throw Failure("has '" + std::string(digits) + "' where a number belongs", "'" + text + "'",
                  "write numbers with commas between them, like 90 or 0,90,0");
  return *number;
}

std::vector<double> typed_numbers(const std::string& list, const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    numbers.push_back(number_of(std::string_view(list).substr(at, comma - at), text));
    at = comma + 1;
  }
  return numbers;
}

bool has_part(const Thing& thing, const std::string& name) {
  return std::ranges::any_of(thing.parts,
                             [&](const KeyedPart& part) { return part.name == name || part.name == "/" + name; });
}

// Names of joints may end in what is an axis or a sign elsewhere.
Typed taken_apart(const std::string& text, const Thing& thing) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) refuse_setting(text);
  Typed typed{text.substr(0, equals)};
  const char sign = typed.part.back();
  typed.relative = (sign == '+' || sign == '-') && typed.part.size() > 1 && !has_part(thing, typed.part);
  if (typed.relative) typed.part.pop_back();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (typed.part.size() > 2 && typed.part.ends_with(kAxes[axis]) && !has_part(thing, typed.part)) typed.axis = axis;
  if (typed.axis) typed.part.resize(typed.part.size() - 2);
  typed.numbers = typed_numbers(text.substr(equals + 1), text);
  if (typed.relative && sign == '-')
    for (double& number : typed.numbers) number = -number;
  return typed;
}

// Whether the part has such numbers.
bool has_numbers(const document::Json& now, const Typed& typed) {
  if (!now.is_array()) return now.is_number() && !typed.axis && typed.numbers.size() == 1;
  if (typed.axis) return *typed.axis < now.size() && typed.numbers.size() == 1;
  return typed.numbers.size() == now.size();
}

PartSetting setting_of(const std::string& part, const Typed& typed) {
  PartSetting setting{part, {}, typed.relative};
  for (std::size_t i = 0; i < typed.numbers.size(); ++i) setting.numbers[typed.axis.value_or(0) + i] = typed.numbers[i];
  return setting;
}

[[noreturn]] void refuse_numbers(const Typed& typed, const std::string& text, const document::Json& now) {
  if (now.is_null())
    throw Failure("is not set by numbers", "'" + text + "'", "use mars animate FILM attach and detach");
  const bool axis = typed.axis && typed.numbers.size() == 1;
  throw Failure(axis ? std::string("has no ") + kAxes[*typed.axis][1]
                     : "has " + document::counted(typed.numbers.size(), "number"),
                "'" + text + "'", remedy_for(typed.part, now));
}

[[noreturn]] void refuse_pattern(const Typed& typed, const std::string& text, const Thing& thing,
                                 const std::vector<std::string>& like) {
  std::vector<std::string> names;
  for (const std::string& name : like) names.push_back(shown_part(name));
  throw Failure("names no part that " + (typed.axis ? std::string("can change in ") + kAxes[*typed.axis][1]
                                                    : "has " + document::counted(typed.numbers.size(), "number")),
                thing.name + ", '" + text + "'", "like it are: " + document::joined(names));
}

[[noreturn]] void refuse_relative(const Typed& typed, const std::string& text, const Thing& thing) {
  throw Failure("has no " + typed.part + " yet, to which a number could be added", thing.name + ", '" + text + "'",
                "write what it is to be: " + typed.part + "=NUMBER");
}

}  // namespace

std::vector<PartSetting> read_axes(const std::string& text, const Thing& thing) {
  const Typed typed = taken_apart(text + "=0", thing);
  const document::Json now = thing.part(parts_named(thing, typed.part).front()).value_at(0);
  const std::size_t axes = now.is_array() && !typed.axis ? now.size() : 1;
  return read_settings(text + "=" + document::joined(std::vector<std::string>(axes, "0"), ","), thing);
}

std::vector<PartSetting> read_settings(const std::string& text, const Thing& thing) {
  const Typed typed = taken_apart(text, thing);
  const bool unset = thing.can_get(typed.part);
  if (unset && typed.relative) refuse_relative(typed, text, thing);
  const std::vector<std::string> names = unset ? std::vector{typed.part} : parts_named(thing, typed.part);
  std::vector<PartSetting> settings;
  for (const std::string& name : names) {
    const KeyedPart& part = thing.part(name);
    const document::Json now = part.value_at(0);
    const bool fits = has_numbers(now, typed);
    if (!is_pattern(thing, typed.part)) {
      if (!fits) refuse_numbers(typed, text, now);
    } else if (!fits || (part.joint && typed.axis && !part.joint->limits[*typed.axis].free())) {
      continue;
    }
    settings.push_back(setting_of(name, typed));
  }
  if (settings.empty()) refuse_pattern(typed, text, thing, names);
  return settings;
}

}  // namespace mars::animator
