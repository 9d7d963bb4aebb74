// Steps of commands: the words of each `mars animate`, edited.
#include "host/content/animator/motion/script/action.h"
#include "tests/fuzz/steps.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::page_animate_words {
namespace {

constexpr const char* kCommands = R"(
[["animate", "pose", "tom", "left-shin.y=9", "place=1,2,3", "--frame", "3", "--ease", "both", "--clamp", "--lengthen"]]
[["animate", "pose", "tom", "*-shin.y+=10", "--frame", "0-12", "--ease", "0.4,0,0.6,1"]]
[["animate", "pose", "camera", "eye=9,0,2", "fov=30", "--frame", "12"]]
[["animate", "key", "tom", "head", "--frame", "9", "--ease", "spline"], ["animate", "key", "--all", "--frame", "20"]]
[["animate", "move", "tom", "place", "--frame", "3", "--to", "8"]]
[["animate", "copy", "tom", "--frame", "0-8", "--to", "30", "--lengthen"]]
[["animate", "delete", "tom", "left-*", "--frame", "30-40"]]
[["animate", "time", "--all", "--frame", "0-4", "--stretch", "2"], ["animate", "time", "tom", "--frame", "9", "--hold", "12"]]
[["animate", "time", "tom", "--frame", "0-40", "--ease", "in"], ["animate", "time", "tom", "--frame", "0", "--shift", "2"]]
[["animate", "time", "tom", "--frame", "0-40", "--anticipate", "15", "--overshoot", "10"]]
[["animate", "key", "tom", "head", "--frame", "9", "--ease", "spline"], ["animate", "tangent", "tom", "head.y", "--frame", "9", "--in", "2.5", "--out", "1"]]
[["animate", "reduce", "tom", "--error", "0.5", "--distance", "0.01", "--frame", "0-40"]]
[["animate", "list", "tom", "place", "--frame", "0-9"], ["animate", "check"]]
[["animate", "attach", "ball", "--to", "tom/head", "--frame", "2", "--place", "0", "0", "0.1", "--turn", "0", "90", "0"], ["animate", "detach", "ball", "--frame", "9"]]
[["animate", "look", "tom/head", "--frame", "3", "--offset", "0", "0", "0.2"], ["animate", "look", "--end", "--frame", "9"]]
[["animate", "follow", "tom", "--frame", "3", "--offset", "0", "-4", "1.5", "--axes", "joint", "--level"]]
[["animate", "script", "play.script", "--lengthen"]]
)";

Json words_of(std::string_view text) {
  Json words = Json::array();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

// With all of its parameters, which may exclude each other, and with the last one alone.
void add_action(const motion::Action& action, Messages& commands) {
  Json all{"animate", action.name, "tom", "--at", "3", "--lengthen"};
  for (const motion::Parameter& parameter : action.parameters) {
    Json with = {"--" + std::string(parameter.name)};
    for (Json& word : words_of(parameter.example)) with.push_back(std::move(word));
    all.insert(all.end(), with.begin(), with.end());
  }
  commands.push_back({std::move(all)});
  commands.push_back({{"animate", action.name, "tom"}});
}

Messages steps_of(const Messages& commands) {
  Messages steps;
  for (const Json& each : commands) steps.push_back({{"commands", each}});
  return with_steps(steps);
}

Messages actions() {
  Messages commands;
  for (const motion::Action& action : motion::actions()) add_action(action, commands);
  return commands;
}

}  // namespace

void take(std::string_view input) {
  static StudioPages pages(figure_film(), steps_of(messages_of(kCommands)), steps_of(actions()));
  pages.take(input);
}

const Target target("page_animate_words", Form::bytes, take);

}  // namespace mars::fuzz::page_animate_words
