#include "host/shell/commands/doctor_command.h"

#include <memory>

#include "host/child/programs.h"
#include "host/cli/program.h"

namespace mars::commands {

void add_doctor(cli::Command app, const doctor::DoctorOptions& defaults, int& code) {
  const auto options = std::make_shared<doctor::DoctorOptions>(defaults);
  const cli::Command command =
      app.add_command("doctor", "Check whether films can be rendered here, and print remedies");
  command
      .add("--nodes", options->nodes,
           "Check for N nodes and show where each is placed; default: as mars render. "
           "Example: --nodes 4")
      .range(1, 1 << 20)
      .type("N");
  command
      .add("--hostfile", options->hostfile,
           "Check the machines of FILE, as mars render --hostfile uses them, and the network between them. "
           "Example: --hostfile hosts")
      .type("FILE");
  command
      .add("-o,--output", options->folder,
           "Check that all machines see the folder DIR; default: the current one. Example: -o frames")
      .type("DIR");
  // Asked by itself, on other machines.
  command.add_flag("--this-machine", options->this_machine, "").hidden();
  command.add("--own-name", options->own_name, "").hidden();
  command.add("--token", options->token, "").hidden();
  command.footer(cli::kExitCodes);
  command.runs([options, &code] { code = doctor::run_doctor(*options, child::own_file()) ? 0 : cli::kFailed; });
}

}  // namespace mars::commands
