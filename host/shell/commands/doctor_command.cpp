#include "host/shell/commands/doctor_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "host/child/programs.h"
#include "host/shell/options/command_line.h"

namespace mars::commands {

void add_doctor(CLI::App& app, const doctor::DoctorOptions& defaults, int& code) {
  const auto options = std::make_shared<doctor::DoctorOptions>(defaults);
  CLI::App* command = app.add_subcommand("doctor", "Check whether films can be rendered here, and print remedies");
  command
      ->add_option("--nodes", options->nodes,
                   "Check for N nodes and show where each is placed; default: as mars render. "
                   "Example: --nodes 4")
      ->check(CLI::Range(1, 1 << 20).description(""))
      ->type_name("N");
  command->add_flag("--this-machine", options->this_machine)->group("");  // asked by itself, on other machines
  command->footer(options::kExitCodes);
  command->callback(
      [options, &code] { code = doctor::run_doctor(*options, child::own_file()) ? 0 : options::kFailed; });
}

}  // namespace mars::commands
