#include <functional>
#include <memory>

#include "hal/failure/failure.h"
#include "host/cli/command.h"
#include "host/content/animator/motion/script/action.h"
#include "host/content/animator/motion/script/script.h"
#include "host/content/document/file.h"
#include "host/editing/film_length.h"
#include "host/editing/words.h"
#include "node/wire/film.h"

namespace mars::editing {
namespace {

// What a person typed for one action.
struct ActionWords {
  std::string actor;
  std::vector<std::vector<std::string>> values;  // one a parameter
  std::uint32_t at = 0;
  bool lengthen = false;
};

// What a person should know of the film's length; `again`: what the words need that they lengthen it.
std::string length_note(const EditedFilm& edited, document::Json& film, std::uint32_t last, bool lengthen,
                        const std::string& again) {
  const std::string length = fit_length(film, last, lengthen);
  if (length.empty() || lengthen) return length;
  return length + ": set its frames to " + std::to_string(last + 1) + ", or " + edited.how_to_lengthen(again);
}

// All its values at once, or none.
void require_all(const motion::Action& action, const motion::Parameter& parameter,
                 const std::vector<std::string>& values) {
  if (values.empty() || values.size() == parameter.count()) return;
  const std::string name = "--" + std::string(parameter.name);
  throw Failure(name + " has " + std::to_string(values.size()) + " of its " + std::to_string(parameter.count()) +
                    " numbers",
                std::string(action.name), "write " + name + " " + std::string(parameter.example));
}

void run_action(EditedFilm& film, const motion::Action& action, const ActionWords& typed,
                std::optional<std::uint32_t> at) {
  motion::Arguments::Values values;
  for (std::size_t i = 0; i < typed.values.size(); ++i) {
    require_all(action, action.parameters[i], typed.values[i]);
    if (!typed.values[i].empty()) values[std::string(action.parameters[i].name)] = typed.values[i];
  }
  const motion::Arguments arguments(values, std::string(action.name));
  motion::Performed done;
  std::string note;
  film.change([&](document::Json& json, const animator::Film& meaning) {
    done = motion::perform(json, meaning, typed.actor, action, at, arguments);
    note =
        length_note(film, json, done.film_last, typed.lengthen, "--at " + std::to_string(done.first) + " --lengthen");
  });
  film.print("frames " + std::to_string(done.first) + " to " + std::to_string(done.last) +
             (done.report.empty() ? "" : ": " + done.report) + (note.empty() ? "" : "; " + note) + "\n");
}

void add_parameters(cli::Command command, const motion::Action& action, ActionWords& typed) {
  typed.values.resize(action.parameters.size());
  for (std::size_t i = 0; i < action.parameters.size(); ++i) {
    const motion::Parameter& parameter = action.parameters[i];
    const std::string name = "--" + std::string(parameter.name);
    std::string help(parameter.meaning);
    help[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(help[0])));
    command.add(name, typed.values[i], help + ". Example: " + name + " " + std::string(parameter.example))
        .words(1, static_cast<int>(parameter.count()))
        .type(std::string(parameter.value));
  }
}

void add_action(cli::Command animate, EditedFilm& film, const motion::Action& action) {
  const cli::Command command = animate.add_command(std::string(action.name), std::string(action.purpose));
  const auto typed = std::make_shared<ActionWords>();
  command.add("ACTOR", typed->actor, "The actor. Example: anna").required();
  add_parameters(command, action, *typed);
  const cli::Option at =
      command
          .add("--at", typed->at,
               "The frame at which the motion begins; default: the actor's last key. Example: --at 24")
          .type("FRAME")
          .range(0u, wire::kMostFrames);
  command.add_flag("--lengthen", typed->lengthen, "Make the film long enough for the motion. Example: --lengthen");
  command.runs([&film, &action, typed, at] {
    run_action(film, action, *typed, at.given() ? std::optional(typed->at) : std::nullopt);
  });
}

void add_script(cli::Command animate, EditedFilm& film) {
  const cli::Command command = animate.add_command("script", "Run a script: actions of several actors at their times");
  const auto script = std::make_shared<std::string>();
  const auto lengthen = std::make_shared<bool>(false);
  command.add("SCRIPT", *script, "The script, in the form that docs/motion.md describes. Example: cubes.script")
      .required();
  command.add_flag("--lengthen", *lengthen, "Make the film long enough for the script. Example: --lengthen");
  command.runs([&film, script, lengthen] {
    motion::Played played;
    std::string note;
    film.change([&](document::Json& json, const animator::Film&) {
      played = motion::play_script(json, film.path(), film.read_script(*script), *script);
      if (!played.cut) note = length_note(film, json, played.last, *lengthen, "--lengthen");
    });
    for (const std::string& line : played.report) film.print(line + "\n");
    if (!note.empty()) film.print("frames up to " + std::to_string(played.last) + "; " + note + "\n");
  });
}

}  // namespace

void add_motion(cli::Command animate, EditedFilm& film) {
  for (const motion::Action& action : motion::actions()) add_action(animate, film, action);
  add_script(animate, film);
}

}  // namespace mars::editing
