#include "host/shell/commands/studio_command.h"

#include <memory>

#include "host/child/programs.h"
#include "host/cli/program.h"
#include "host/shell/options/render_options.h"
#include "host/studio/run_studio.h"

namespace mars::commands {
namespace {

constexpr const char* kAfterStudioHelp =
    R"(Prints a link. Everybody who has the link can work in the studio, but only on
this machine. To use a browser of another machine, start there
ssh -L 8640:localhost:8640 MACHINE, then open the link there.
Ctrl-C ends the studio. More: docs/studio.md.

)";

void add_server(cli::Command command, studio::StudioSettings& settings) {
  command
      .add("--port", settings.port,
           "Port of the link; default: 8640, or a free port if 8640 is in use. Example: --port 9000")
      .type("N");
  command
      .add("--listen", settings.listen,
           "Address at which browsers of other machines can connect; needs --certificate and --key, or --insecure. "
           "Example: --listen 0.0.0.0:8640")
      .type("ADDRESS[:PORT]");
  command
      .add("--certificate", settings.certificate,
           "Certificate for TLS, with its chain, as PEM. Example: --certificate studio.pem")
      .type("FILE");
  command.add("--key", settings.key, "The certificate's key, as PEM. Example: --key studio.key").type("FILE");
  command.add_flag(
      "--insecure", settings.insecure,
      "Accept other machines without TLS: anyone who can listen to the network can get in. Example: --insecure");
}

// Threads start at once; machines need MPI.
void choose_backend(options::RenderOptions& renderer) {
  if (renderer.backend == options::Backend::automatic && renderer.hostfile.empty())
    renderer.backend = options::Backend::threads;
}

}  // namespace

void add_studio(cli::Command app) {
  const auto settings = std::make_shared<studio::StudioSettings>();
  const auto no_browser = std::make_shared<bool>(false);
  const cli::Command command = app.add_command("studio", "Work on a film or a model in the browser");
  command.add("FILM", settings->file,
              "A film or a model below this folder; if there is no such file, a new model; default: figure.json. "
              "Example: examples/demo.json");
  command.add_flag("--film", settings->film,
                   "If there is no such file, begin a film instead of a model; default: film.json. Example: --film");
  add_server(command, *settings);
  command.add_flag("--no-browser", *no_browser, "Open no browser. Example: --no-browser");
  options::add_render_options(command, settings->renderer, options::Program::studio);
  command.footer(kAfterStudioHelp + std::string(cli::kExitCodes));
  command.runs([settings, no_browser] {
    settings->browser = !*no_browser;
    settings->page = child::own_file().parent_path().parent_path() / "share" / "mars" / "studio";
    if (settings->film && settings->file.empty()) settings->file = "film.json";
    choose_backend(settings->renderer);
    studio::run_studio(*settings);
  });
}

}  // namespace mars::commands
