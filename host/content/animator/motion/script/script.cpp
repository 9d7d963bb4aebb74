#include "host/content/animator/motion/script/script.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/carry.h"
#include "host/content/animator/reading/film_version.h"
#include "host/content/animator/motion/script/script_line.h"
#include "host/content/animator/keys/pose.h"
#include "host/content/animator/reading/read_film.h"

namespace mars::motion {
namespace {

constexpr std::string_view kCues[] = {"at", "then", "after"};
constexpr const char* kCamera = "camera";

animator::Film meaning_of(const document::Json& json, const std::filesystem::path& path) {
  document::Json newest = json;
  animator::write_version(newest);
  const document::Document document(document::laid_out(newest), path.string());
  return animator::read_film(document.root(), path.parent_path());
}

std::string list_of(const std::vector<std::string>& words, char between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : std::string(1, between)) + word;
  return text;
}

class Player {
 public:
  Player(document::Json& film, const std::filesystem::path& path, std::string name)
      : film_(film), path_(path), name_(std::move(name)), meaning_(meaning_of(film, path)), rate_(meaning_.rate) {
    for (const document::Json& actor : film.at("actors")) actors_.push_back(actor.at("name").get<std::string>());
  }

  void play(std::string_view text, int number) {
    ScriptLine line(text, name_ + ":" + std::to_string(number));
    if (line.empty()) return;
    if (line.take_if("let")) return let(line);
    const std::uint32_t at = line.next_is("cut") ? last_ : take_cue(line);
    if (line.next_is("cut")) return cut_film(line, at);
    const std::string name = line.take("an actor, or cut,");
    const bool camera = name == kCamera && !is_actor(name);
    if (!camera) require_actor(line, name);
    if (line.next_is("pose"))
      last_ = pose(line, name, at);
    else
      last_ = camera ? move_camera(line, at) : start(line, name, at);
    if (line.take_if("as")) times_[line.take("a name")] = last_;
    if (!line.empty()) line.refuse("goes on with '" + line.take("") + "'", "take it out");
    played_.last = std::max(played_.last, last_);
  }

  Played played() { return std::move(played_); }

 private:
  // Of the film as it is now; its models stay what they are.
  const animator::Film& meaning() {
    const document::Document document(document::laid_out(film_), path_.string());
    meaning_ = animator::read_film(document.root(), meaning_.models);
    return meaning_;
  }

  bool is_actor(const std::string& name) const { return std::count(actors_.begin(), actors_.end(), name) > 0; }

  void let(ScriptLine& line) {
    const std::string name = line.take("a name");
    if (!line.take_if("=")) line.refuse("has no '=' after the name", "write: let midpoint = runtime / 2");
    times_[name] = line.take_time(times_, rate_);
    if (!line.empty()) line.refuse("goes on with '" + line.take("") + "'", "write one time, as in: let end = 4s + 12");
  }

  std::uint32_t take_cue(ScriptLine& line) {
    const std::string cue = line.take("a cue");
    if (cue == "then") return last_;
    if (cue == "at" || cue == "after") return static_cast<std::uint32_t>(std::lround(line.take_time(times_, rate_)));
    line.refuse("begins with '" + cue + "', which is no cue",
                document::did_you_mean(cue, kCues, "begin with at TIME, then, after NAME, or let"));
  }

  void cut_film(ScriptLine& line, std::uint32_t at) {
    line.take("cut");
    if (at == 0) line.refuse("ends the film before it begins", "cut later");
    if (!line.empty()) line.refuse("goes on after cut", "a camera's cut is: camera cut eye X Y Z");
    film_["frames"] = at;
    played_.cut = true;
    played_.report.push_back(line.where() + ": the film has " + std::to_string(at) + " frames");
  }

  void require_actor(const ScriptLine& line, const std::string& name) const {
    if (!is_actor(name))
      line.refuse("names '" + name + "', which is no actor of the film",
                  document::did_you_mean(name, std::vector<std::string_view>(actors_.begin(), actors_.end()),
                                         "name an actor, or camera"));
  }

  // ACTOR pose elbow.y=90 place.x+=1: keys at this frame, of the camera too. With the word local, turns about own axes.
  std::uint32_t pose(ScriptLine& line, const std::string& name, std::uint32_t at) {
    line.take("pose");
    std::vector<std::string> settings;
    animator::PoseManner manner;
    while (!line.empty() && !line.next_is("as")) {
      if (line.next_is("--local")) line.refuse("has '--local'", "words of scripts have no dashes: write local");
      if (line.take_if("local"))
        manner.local = true;
      else
        settings.push_back(line.take(""));
    }
    if (settings.empty()) line.refuse("does not say what is posed", "add PART=NUMBERS, as in: tom pose head.z=20");
    // What an earlier version of the script keyed here would be added to again.
    if (begun_.insert(name).second) is_actor(name) ? clear_from(name, std::max(at, 1u)) : clear_camera_after(at);
    in_line(line, [&] { return animator::pose(film_, meaning(), name, settings, {at, at}, manner); });
    played_.report.push_back(line.where() + ": " + name + " pose, frame " + std::to_string(at));
    return at;
  }

  std::uint32_t start(ScriptLine& line, const std::string& name, std::uint32_t at) {
    const std::string verb = line.take("an action");
    if (verb == "attach" || verb == "detach") return carry(line, name, verb, at);
    const Action* action = find_action(verb);
    std::vector<std::string_view> verbs{"pose", "attach", "detach"};
    for (const Action& each : actions()) verbs.push_back(each.name);
    if (!action)
      line.refuse("has '" + verb + "', which is no action",
                  document::did_you_mean(verb, verbs, "see: mars animate --help"));
    const Arguments arguments(take_values(line, *action, at), line.where() + ": " + verb);
    if (begun_.insert(name).second) clear_from(name, at + 1);
    if (const auto what = arguments.word("what"); what && is_actor(*what) && begun_.insert(*what).second)
      clear_from(*what, at + 1);
    const Performed done = in_line(line, [&] { return perform(film_, meaning(), name, *action, at, arguments); });
    played_.report.push_back(line.where() + ": " + name + " " + verb + ", frames " + std::to_string(done.first) +
                             " to " + std::to_string(done.last) + (done.report.empty() ? "" : ": " + done.report));
    played_.last = std::max(played_.last, done.film_last);
    return done.last;
  }

  // attach ACTOR/JOINT, detach: from this frame on.
  std::uint32_t carry(ScriptLine& line, const std::string& name, const std::string& verb, std::uint32_t at) {
    const std::string to = verb == "attach" ? line.take("an actor or its joint, as in tom/right-hand") : "";
    if (begun_.insert(name).second) clear_from(name, at + 1);
    in_line(line, [&] {
      const animator::Film& now = meaning();
      verb == "attach" ? animator::attach(film_, now, name, to, at, {}) : animator::detach(film_, now, name, at);
      return meaning().frames;
    });
    played_.report.push_back(line.where() + ": " + name + " " + verb + ", frame " + std::to_string(at));
    return at;
  }

  Arguments::Values take_values(ScriptLine& line, const Action& action, std::uint32_t at) {
    Arguments::Values values;
    std::vector<std::string_view> names;
    for (const Parameter& parameter : action.parameters) names.push_back(parameter.name);
    const bool lasts = std::count(names.begin(), names.end(), "seconds") > 0;
    while (!line.empty() && !line.next_is("as")) {
      const std::string word = line.take("");
      if (word == "until" && lasts) {
        values["seconds"] = {std::to_string(seconds_until(line, at))};
        continue;
      }
      const auto found = std::find(names.begin(), names.end(), word);
      if (found == names.end())
        line.refuse(
            "has '" + word + "', which '" + std::string(action.name) + "' does not know",
            document::did_you_mean(word, names, "see: mars animate FILM " + std::string(action.name) + " --help"));
      const Parameter& parameter = action.parameters[std::size_t(found - names.begin())];
      std::vector<std::string>& taken = values[word];
      taken.clear();
      for (std::size_t i = 0; i < parameter.count(); ++i)
        taken.push_back(line.take(word + " " + std::string(parameter.value)));
    }
    return values;
  }

  double seconds_until(ScriptLine& line, std::uint32_t at) {
    const double end = line.take_time(times_, rate_);
    if (end <= at) line.refuse("ends before it begins", "write a later time after until");
    return (end - at) / rate_;
  }

  // camera cut eye X Y Z at X Y Z fov N height N: from this frame on; camera move the same, seconds S or until TIME.
  std::uint32_t move_camera(ScriptLine& line, std::uint32_t at) {
    constexpr std::string_view verbs[] = {"cut", "move", "follow", "look", "pose"},
                               parts[] = {"eye", "at", "fov", "height", "seconds", "until"};
    const std::string verb = line.take("cut, move, pose, follow or look");
    if (verb == "follow" || verb == "look") return go_along(line, verb, at);
    if (verb != "cut" && verb != "move")
      line.refuse("has '" + verb + "' after camera",
                  document::did_you_mean(verb, verbs, "write camera cut, move, pose, follow or look"));
    std::vector<std::string> settings;
    double seconds = 1;
    while (!line.empty() && !line.next_is("as")) {
      const std::string part = line.take("");
      if (part == "until" && verb == "move")
        seconds = seconds_until(line, at);
      else if (part == "seconds" && verb == "move")
        seconds = line.take_time(times_, 1);
      else if (part == "fov" || part == "height")
        settings.push_back(part + "=" + list_of(take_words(line, 1), ','));
      else if (part == "eye" || part == "at")
        settings.push_back(part + "=" + list_of(take_words(line, 3), ','));
      else
        line.refuse("has '" + part + "', which the camera does not know",
                    document::did_you_mean(part, parts, "write eye, at, fov or height"));
    }
    if (settings.empty())
      line.refuse("does not say where the camera goes", "add eye X Y Z, at X Y Z, fov N or height N");
    if (begun_.insert(kCamera).second) clear_camera_after(at);
    const double last = verb == "cut" ? at : at + std::max(1.0, std::round(seconds * rate_));
    if (last >= wire::kMostFrames)
      line.refuse("moves the camera until frame " + document::shown(last),
                  "a film has at most " + std::to_string(wire::kMostFrames) + " frames: move it faster or earlier");
    const auto end = static_cast<std::uint32_t>(last);
    in_line(line, [&] {
      // It stays as it is until the cut, or until it moves.
      const animator::Choice moved{false, kCamera, parts_of(settings)};
      if (verb == "move")
        animator::make_keys(film_, meaning(), moved, at, animator::kBoth, animator::Beyond::refused);
      else if (at > 0)
        animator::cut(film_, meaning(), moved, at);
      animator::pose(film_, meaning(), kCamera, settings, {end, end}, {.ease = animator::kLinear});
      return meaning().frames;
    });
    played_.report.push_back(line.where() + ": camera " + verb + ", frame " + std::to_string(end));
    return end;
  }

  // camera follow ACTOR/JOINT offset X Y Z level; camera look the same without level: from this frame on.
  std::uint32_t go_along(ScriptLine& line, const std::string& verb, std::uint32_t at) {
    const bool looks = verb == "look";
    const std::string to = line.take("an actor or its joint, as in tom/head");
    animator::Following following{looks ? "at" : "eye", std::nullopt};
    while (!line.empty() && !line.next_is("as")) {
      const std::string word = line.take("");
      if (word == "level" && !looks)
        following.level = true;
      else if (word == "offset")
        following.offset = take_vector(line);
      else
        line.refuse("has '" + word + "' after camera " + verb,
                    looks ? "write offset X Y Z" : "write level or offset X Y Z");
    }
    if (begun_.insert(kCamera).second) clear_camera_after(at);
    in_line(line, [&] {
      animator::follow(film_, meaning(), to, at, following);
      return meaning().frames;
    });
    played_.report.push_back(line.where() + ": camera " + verb + ", frame " + std::to_string(at));
    return at;
  }

  static glm::dvec3 take_vector(ScriptLine& line) {
    glm::dvec3 vector;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string word = line.take("a number");
      const auto number = document::number_in<double>(word);
      if (!number || !(std::abs(*number) <= document::kFarthest))
        line.refuse("has '" + word + "' where a number belongs", "write three numbers");
      vector[axis] = *number;
    }
    return vector;
  }

  static std::vector<std::string> parts_of(const std::vector<std::string>& settings) {
    std::vector<std::string> parts;
    for (const std::string& argument : settings) parts.push_back(argument.substr(0, argument.find('=')));
    return parts;
  }

  static std::vector<std::string> take_words(ScriptLine& line, int count) {
    std::vector<std::string> words;
    for (int i = 0; i < count; ++i) words.push_back(line.take("a number"));
    return words;
  }

  // What an earlier version of the script had left there.
  void clear_from(const std::string& name, std::uint32_t frame) {
    const animator::Film& film = meaning();
    const auto actor =
        std::find_if(film.actors.begin(), film.actors.end(), [&](const animator::Actor& a) { return a.name == name; });
    animator::ActorKey all;
    all.place = all.turn = glm::dvec3(0);
    all.attach = animator::AttachKey{};
    for (const modeler::Joint& joint : film.models[actor->model].joints) all.pose[joint.name] = glm::dvec3(0);
    animator::clear_keys(film_, name, frame, wire::kMostFrames, all);
  }

  void clear_camera_after(std::uint32_t at) {
    document::Json& camera = film_["camera"];
    if (!camera.contains("keys")) return;
    document::Json left = document::Json::array();
    for (const document::Json& key : camera["keys"])
      if (key.at("frame").get<std::uint32_t>() < std::max(at, 1u)) left.push_back(key);
    camera["keys"] = left;
  }

  // Failures of an action name the line that wanted it.
  template <typename Do>
  auto in_line(const ScriptLine& line, Do act) -> decltype(act()) {
    try {
      return act();
    } catch (const Failure& failure) {
      if (failure.where.starts_with(name_)) throw;
      throw Failure(failure.problem, line.where() + ": " + failure.where, failure.remedy);
    }
  }

  document::Json& film_;
  std::filesystem::path path_;
  std::string name_;
  animator::Film meaning_;
  double rate_;
  std::vector<std::string> actors_;
  std::set<std::string> begun_;
  Times times_;
  std::uint32_t last_ = 0;
  Played played_;
};

}  // namespace

Played play_script(document::Json& film, const std::filesystem::path& path, const std::string& script,
                   const std::string& name) {
  document::Json changed = film;
  Player player(changed, path, name);
  int number = 0;
  for (std::size_t start = 0; start <= script.size();) {
    const std::size_t end = std::min(script.find('\n', start), script.size());
    player.play(std::string_view(script).substr(start, end - start), ++number);
    start = end + 1;
  }
  animator::write_version(changed);
  film = std::move(changed);
  return player.played();
}

}  // namespace mars::motion
