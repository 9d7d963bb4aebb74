#include "host/options/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string_view>

#include "hal/settings.h"

namespace mars::host {
namespace {

std::string line_of(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : "\t") + (field.empty() ? "-" : field);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line + "\n";
}

std::string lines_of(const CLI::App& command, const std::string& name) {
  std::string text = line_of({"command", name, command.get_description()});
  for (const CLI::Option* each : command.get_options({})) {
    text += line_of({each->get_positional() ? "argument" : "option", name, each->get_name(false, true),
                     each->get_type_size() == 0 ? "" : each->get_type_name(),
                     each->get_required() ? "required" : "optional", each->get_description()});
  }
  for (const CLI::App* each : command.get_subcommands({}))
    text += lines_of(*each, name + " " + each->get_name());
  return text;
}

std::string option_list(const CLI::App& app) {
  std::string text = lines_of(app, app.get_name());
  for (const hal::Setting& each : hal::settings_table()) {
    text += line_of({"setting", each.name, std::string(each.meaning) + "; without it: " + each.fallback});
  }
  return text;
}

}  // namespace

std::optional<int> read_command_line(CLI::App& app, int argc, const char* const* argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--list-options") {
    std::cout << option_list(app);
    return 0;
  }
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app.exit(error, std::cout, std::cerr) == 0 ? 0 : kUsage;
  }
}

}  // namespace mars::host
