#include "host/options/command_line.h"

#include <CLI/CLI.hpp>
#include <iostream>

namespace mars::host {

std::optional<int> read_command_line(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app.exit(error, std::cout, std::cerr) == 0 ? 0 : kUsage;
  }
}

}  // namespace mars::host
