#include "host/cli/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstring>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "hal/failure/failure.h"
#include "hal/messages/settings.h"
#include "host/content/document/fields.h"
#include "host/content/document/text.h"
#include "host/cli/wrapped.h"

namespace mars::cli {
namespace {

constexpr std::size_t kMostListed = 10;  // commands, in a line

std::string line_of(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : "\t") + (field.empty() ? "-" : field);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line + "\n";
}

std::vector<const CLI::App*> commands_in(const CLI::App& app) { return app.get_subcommands({}); }

// "JOINT...": an argument that takes several words.
std::string name_of(const CLI::Option& option) {
  const bool many = option.get_positional() && option.get_items_expected_max() > 1;
  return option.get_name(false, true) + (many ? "..." : "");
}

std::string lines_of(const CLI::App& command, const std::string& name) {
  std::string text = line_of({"command", name, command.get_description()});
  for (const CLI::Option* each : command.get_options({})) {
    if (each->get_group().empty()) continue;  // not for people
    text += line_of({each->get_positional() ? "argument" : "option", name, name_of(*each),
                     each->get_type_size() == 0 ? "" : each->get_type_name(),
                     each->get_required() ? "required" : "optional", each->get_description()});
  }
  for (const CLI::App* each : commands_in(command)) text += lines_of(*each, name + " " + each->get_name());
  return text;
}

std::string option_list(const CLI::App& app) {
  std::string text = lines_of(app, app.get_name());
  for (const messages::Setting& each : messages::settings_table()) {
    text += line_of({"setting", each.name, std::string(each.meaning) + "; without it: " + each.fallback});
  }
  return text;
}

// "mars animate FILM pose": a command as it is typed, after the arguments of those it is within.
std::string typed(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  if (parent == nullptr) return command.get_name();
  std::string text = typed(*parent) + " ";
  for (const CLI::Option* each : parent->get_options())
    if (each->get_positional()) text += each->get_name(true) + " ";
  return text + command.get_name();
}

const CLI::App* command_named(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : commands_in(app))
    if (command->get_name() == name) return command;
  return nullptr;
}

// The command that was named where an argument of `app` belongs, as in `mars animate pose --help`; null if none was.
const CLI::App* named_too_early(const CLI::App& app) {
  for (const CLI::Option* each : app.get_options())
    if (each->get_positional() && each->count() > 0)
      if (const CLI::App* command = command_named(app, each->results().front())) return command;
  return nullptr;
}

// Whose help is meant where that of `app` is asked for: `mars film light add --help` lacks FILM, and is not about
// `mars film FILM add`.
const CLI::App* meant_by(const CLI::App& app) {
  if (const CLI::App* command = named_too_early(app)) return command;
  const CLI::App* within = app.get_parent() == nullptr ? nullptr : named_too_early(*app.get_parent());
  return within == nullptr ? nullptr : command_named(*within, app.get_name());
}

// Help as wide as a terminal.
class Help : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    const CLI::App* meant = meant_by(*app);
    return Formatter::make_help(meant == nullptr ? app : meant, name, mode);
  }

  std::string make_usage(const CLI::App* app, std::string) const override {
    return Formatter::make_usage(app, typed(*app));
  }

  std::string make_option_usage(const CLI::Option* option) const override {
    return option->get_required() ? name_of(*option) : "[" + name_of(*option) + "]";
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string& help = option->get_description();
    const std::size_t at = std::min(help.find("Example: "), help.size());
    const std::string text = wrapped(help.substr(0, at), 0, text_columns()), example = help.substr(at);
    const std::size_t last_line = text.size() - (text.rfind('\n') + 1);
    if (example.empty() || text.empty()) return text + wrapped(example, 0, text_columns());
    const bool fits = last_line + 1 + example.size() < text_columns();
    return text + (fits ? " " : "\n") + wrapped(example, 0, text_columns());
  }

  // "X Y Z" shows how many words follow.
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string type = option->get_type_name();
    return type.find(' ') == std::string::npos ? Formatter::make_option_opts(option) : " " + type;
  }

  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream line;
    CLI::detail::format_help(line, command->get_name(), wrapped(command->get_description(), 0, text_columns()),
                             column_width_);
    return line.str();
  }

 private:
  std::size_t text_columns() const { return kColumns - column_width_; }
};

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_in(app)) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// The command, `app` or one within it, that was given a word that it does not know; null where none was.
const CLI::App* given_too_much(const CLI::App& app) {
  if (app.remaining_size() > 0) return &app;
  for (const CLI::App* command : app.get_subcommands())
    if (const CLI::App* found = given_too_much(*command)) return found;
  return nullptr;
}

// Words that people type for one another, as the commands differ in which of them they have.
constexpr std::string_view kAlike[][4] = {
    {"list", "show", "info", "ls"}, {"remove", "delete", "rm"}, {"add", "new", "create"}, {"set", "change", "edit"}};

bool are_alike(const std::string& one, const std::string& other) {
  return std::ranges::any_of(kAlike, [&](const auto& words) {
    return std::ranges::find(words, one) != std::end(words) && std::ranges::find(words, other) != std::end(words);
  });
}

// A command of `app`, or of one that this is within, which is called alike; null where there is none.
const CLI::App* called_alike(const CLI::App& app, const std::string& word) {
  for (const CLI::App* command : commands_in(app))
    if (are_alike(command->get_name(), word)) return command;
  return app.get_parent() == nullptr ? nullptr : called_alike(*app.get_parent(), word);
}

// What could be meant by a word that is none of the command's own; "" where nothing can be said in a line.
std::string suggestion(const CLI::App& command, const std::string& word, const std::vector<std::string>& known) {
  const std::string near = document::did_you_mean(word, std::vector<std::string_view>(known.begin(), known.end()), "");
  if (!near.empty() || known.empty() || word.starts_with('-')) return near;
  if (const CLI::App* other = called_alike(command, word)) return "did you mean `" + typed(*other) + "`?";
  return known.size() > kMostListed ? "" : "there are " + document::joined(known);
}

// What is wrong with the first word that the command does not know, and what could be meant.
std::string misfit(const CLI::App& command) {
  const std::string word = command.remaining().front();
  const std::string name = word.substr(0, word.find('='));
  const bool option = word.starts_with('-');
  const std::vector<std::string> known = option ? options_of(command) : commands_of(command);
  const std::string meant = suggestion(command, name, known);
  const char* what = option ? " is not an option" : known.empty() ? " is one word too many" : " is not a command";
  return "'" + name + "'" + what + (meant.empty() ? "" : " (" + meant + ")");
}

// The command that was given, within all others.
const CLI::App& innermost(const CLI::App& app) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  return given.empty() ? app : innermost(*given.front());
}

// How an option that takes several words is written, by its help; "" of others.
std::string written_form(const CLI::App& app, const std::string& name) {
  const CLI::Option* option = innermost(app).get_option_no_throw(name);
  if (option == nullptr || option->get_type_name().find(' ') == std::string::npos) return "";
  const std::string help = option->get_description();
  const std::size_t example = help.find("Example: ");
  if (example == std::string::npos) return "";
  return name + ": write " + option->get_type_name() + ", as in " + help.substr(example + std::strlen("Example: "));
}

// An option has too few words, or too many.
std::string explained(const CLI::App& app, const CLI::ArgumentMismatch& error) {
  const std::string message = error.what(), name = message.substr(0, message.find(':'));
  if (const std::string form = written_form(app, name); !form.empty()) return form;
  if (message.find(": At Most 1 required") != std::string::npos) return name + " is given more than once";
  const CLI::Option* option = innermost(app).get_option_no_throw(name);
  const bool lacks = message.ends_with(" missing") && option != nullptr;
  return lacks ? name + ": " + option->get_type_name() + " is missing" : message;
}

// Words of an option, each sound by itself, make no value: "Could not convert: --limit = x,1,2".
std::string explained(const CLI::App& app, const CLI::ConversionError& error) {
  constexpr std::string_view kBefore = "Could not convert: ", kAfter = " = ";
  const std::string message = error.what();
  const std::size_t after = message.find(kAfter);
  if (!message.starts_with(kBefore) || after == std::string::npos) return message;
  const std::string name = message.substr(kBefore.size(), after - kBefore.size());
  const std::string form = written_form(app, name);
  return form.empty() ? name + ": '" + message.substr(after + kAfter.size()) + "' cannot be read" : form;
}

// "-o=out" would mean a file "=out".
void refuse_signs(CLI::Option& option) {
  if (option.get_snames().empty() || option.get_type_size() == 0) return;
  const auto refusal = [name = option.get_snames().front()](const std::string& text) {
    return text.starts_with('=') ? "'" + text + "' begins with = (write -" + name + " " + text.substr(1) + ")" : "";
  };
  option.check(refusal, "");
}

// Commands may be within commands: `mars model MODEL show`.
void prepare(CLI::App& command, const std::shared_ptr<Help>& help) {
  command.formatter(help);
  command.get_help_ptr()->description("Print this help. Example: --help");
  for (CLI::Option* each : command.get_options()) refuse_signs(*each);
  for (CLI::App* each : command.get_subcommands({})) prepare(*each, help);
}

// Of those within a command one at most is given: the name of another one is a word like any other.
void allow_one_command(CLI::App& command) {
  if (!commands_in(command).empty()) command.require_subcommand(0, 1);
  for (CLI::App* each : command.get_subcommands({})) allow_one_command(*each);
}

// Where a command stands in the place of what comes before it; "" elsewhere.
std::string swapped(const CLI::App& app) {
  const CLI::App* command = named_too_early(innermost(app));
  return command == nullptr ? "" : "'" + command->get_name() + "' comes later: write " + typed(*command);
}

// In a line.
std::string explained(const CLI::App& app, const UsageError& error) {
  const std::string order = swapped(app);
  return order.empty() ? error.what() : order;
}

std::string explained(const CLI::App& app, const CLI::ParseError& error) {
  if (const std::string order = swapped(app); !order.empty()) return order;
  // An unknown word is reported first: what is missing may be what it was meant for.
  const bool misfits = dynamic_cast<const CLI::ExtrasError*>(&error) || dynamic_cast<const CLI::RequiredError*>(&error);
  if (misfits)
    if (const CLI::App* command = given_too_much(app)) return misfit(*command);
  if (const auto* mismatch = dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return explained(app, *mismatch);
  if (const auto* unread = dynamic_cast<const CLI::ConversionError*>(&error)) return explained(app, *unread);
  return error.what();
}

// "mars film set": what help is asked of.
std::string full_name(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent == nullptr ? "" : full_name(*parent) + " ") + command.get_name();
}

// As a Failure reads: the problem, and in parentheses what to do.
std::string with_remedy(const CLI::App& app, const std::string& problem) {
  return problem.ends_with(')') ? problem
                                : problem + " (`" + full_name(innermost(app)) + " --help` shows what there is)";
}

// Whether the command given only holds others and none of them is named.
bool unfinished(const CLI::App& app) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  return given.empty() ? app.get_parent() != nullptr && !commands_in(app).empty() : unfinished(*given.front());
}

// "mars model": nothing follows a command that holds others.
bool holds_commands_alone(const CLI::App& app, const std::string& last_word) {
  const CLI::App& command = innermost(app);
  return command.get_parent() != nullptr && !commands_in(command).empty() && command.get_name() == last_word;
}

}  // namespace

Program::Program(const std::string& name, const std::string& purpose)
    : Program(std::make_unique<Declared>(Declared{std::make_unique<CLI::App>(purpose, name), {}})) {}

Program::Program(std::unique_ptr<Declared> declared)
    : Command(*declared->app, declared->kept), declared_(std::move(declared)), app_(declared_->app.get()) {}

Program::~Program() = default;

void Program::version(const std::string& text) {
  app_->set_version_flag("--version", text, "Print the version. Example: --version");
}

bool Program::no_command_given() const { return app_->get_subcommands().empty(); }

std::optional<int> Program::read(int argc, const char* const* argv) {
  prepare(*app_, std::make_shared<Help>());
  allow_one_command(*app_);
  const auto refuse = [&](const std::string& problem) {
    std::cerr << app_->get_name() << ": " << with_remedy(*app_, problem) << "\n";
    return kUsage;
  };
  if (argc == 2 && std::string_view(argv[1]) == "--list-options") {
    std::cout << option_list(*app_);
    return 0;
  }
  try {
    app_->parse(argc, argv);
    if (!unfinished(*app_)) return std::nullopt;
    if (const std::string order = swapped(*app_); !order.empty()) return refuse(order);
    std::cout << app_->help();
    return 0;
  } catch (const UsageError& error) {
    return refuse(explained(*app_, error));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app_->exit(error, std::cout, std::cerr);
    if (holds_commands_alone(*app_, argv[argc - 1])) {
      std::cout << app_->help();
      return 0;
    }
    return refuse(explained(*app_, error));
  }
}

void Program::read(const std::vector<std::string>& words) {
  const auto refuse = [&](const std::string& problem) {
    throw Failure(with_remedy(*app_, problem), "'" + document::joined(words, " ") + "'", "");
  };
  allow_one_command(*app_);
  try {
    app_->parse(std::vector<std::string>(words.rbegin(), words.rend()));  // it takes them from the end
  } catch (const CLI::Success&) {
    refuse("asks for help, which is shown in a terminal only");
  } catch (const UsageError& error) {
    refuse(explained(*app_, error));
  } catch (const CLI::ParseError& error) {
    refuse(explained(*app_, error));
  }
  if (no_command_given() || unfinished(*app_)) refuse("is no whole command");
}

}  // namespace mars::cli
