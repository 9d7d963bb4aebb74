#include "host/shell/commands/studio_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "host/child/programs.h"
#include "host/shell/options/command_line.h"
#include "host/shell/options/render_options.h"
#include "host/studio/run_studio.h"

namespace mars::commands {
namespace {

constexpr const char* kAfterwards = R"(Prints a link: who has it may work in the studio. Only this machine is listened
to; from another one, come by ssh: ssh -L 8640:localhost:8640 MACHINE, then open
the link at home. Ctrl-C ends the studio. More: docs/studio.md.

)";

void add_server(CLI::App& command, studio::StudioSettings& settings) {
  command
      .add_option("--port", settings.port,
                  "Port of the link; default: 8640, or a free one where that is taken. Example: --port 9000")
      ->type_name("N");
  command
      .add_option("--listen", settings.listen,
                  "Address at which other machines' browsers come, too; with --certificate and --key, or --insecure. "
                  "Example: --listen 0.0.0.0:8640")
      ->type_name("ADDRESS[:PORT]");
  command
      .add_option("--certificate", settings.certificate,
                  "Certificate for TLS, with its chain, as PEM. Example: --certificate studio.pem")
      ->type_name("FILE");
  command.add_option("--key", settings.key, "The certificate's key, as PEM. Example: --key studio.key")
      ->type_name("FILE");
  command.add_flag("--insecure", settings.insecure,
                   "Let other machines come without TLS: who listens to the network gets in. Example: --insecure");
  command.add_flag_callback(
      "--no-browser", [&settings] { settings.browser = false; }, "Open no browser. Example: --no-browser");
}

// Threads start at once; machines need MPI.
void choose_backend(options::RenderOptions& renderer) {
  if (renderer.backend == options::Backend::automatic && renderer.hostfile.empty())
    renderer.backend = options::Backend::threads;
}

}  // namespace

void add_studio(CLI::App& app) {
  const auto settings = std::make_shared<studio::StudioSettings>();
  CLI::App* command = app.add_subcommand("studio", "Work on a film or a model in the browser");
  command->add_option("FILM", settings->file,
                      "A film or a model, below this folder; a new model where there is none; default: figure.json. "
                      "Example: examples/demo.json");
  command->add_flag("--film", settings->film,
                    "Where there is none, begin a film instead of a model; default: film.json. Example: --film");
  add_server(*command, *settings);
  options::add_render_options(*command, settings->renderer, options::Program::studio);
  command->footer(kAfterwards + std::string(options::kExitCodes));
  command->callback([settings] {
    settings->page = child::own_file().parent_path().parent_path() / "share" / "mars" / "studio";
    if (settings->film && settings->file.empty()) settings->file = "film.json";
    choose_backend(settings->renderer);
    studio::run_studio(*settings);
  });
}

}  // namespace mars::commands
