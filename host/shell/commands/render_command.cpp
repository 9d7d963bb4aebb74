#include "host/shell/commands/render_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "hal/messages/settings.h"
#include "host/child/programs.h"
#include "host/shell/doctor/doctor.h"
#include "host/shell/launch/launch.h"
#include "host/shell/options/command_line.h"
#include "host/shell/options/render_options.h"

namespace mars::commands {

void add_render(CLI::App& app) {
  const auto options = std::make_shared<options::RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Render a film to PNG or EXR files");
  options::add_render_options(*command, *options, options::Program::mars);
  command->footer("Environment variables:\n" + messages::settings_text() + "\n" + options::kExitCodes);
  command->callback(
      [options] { launch::launch_render(*options, child::own_file(), doctor::adviser(child::own_file())); });
}

}  // namespace mars::commands
