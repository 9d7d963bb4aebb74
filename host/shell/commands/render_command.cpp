#include "host/shell/commands/render_command.h"

#include <memory>

#include "hal/messages/settings.h"
#include "host/child/programs.h"
#include "host/shell/doctor/doctor.h"
#include "host/shell/launch/launch.h"
#include "host/cli/program.h"
#include "host/shell/options/render_options.h"

namespace mars::commands {

void add_render(cli::Command app) {
  const auto options = std::make_shared<options::RenderOptions>();
  const cli::Command command = app.add_command("render", "Render a film to PNG or EXR files");
  options::add_render_options(command, *options, options::Program::mars);
  command.footer("Environment variables:\n" + messages::settings_text(false) + "\n" + cli::kExitCodes);
  command.runs([options] { launch::launch_render(*options, child::own_file(), doctor::adviser(child::own_file())); });
}

}  // namespace mars::commands
