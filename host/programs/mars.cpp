// mars: what a person types. It knows no MPI: `mars render` starts the programs that do.
#include <csignal>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/threads/run_threads.h"
#include "host/child/standard_streams.h"
#include "host/experiments/message_costs.h"
#include "host/programs/node_counter.h"
#include "host/programs/node_job.h"
#include "host/programs/surface_frames.h"
#include "host/shell/commands/animate_command.h"
#include "host/shell/commands/bench_command.h"
#include "host/shell/commands/calibrate_command.h"
#include "host/shell/commands/compile_command.h"
#include "host/shell/commands/doctor_command.h"
#include "host/shell/commands/film_command.h"
#include "host/shell/commands/folder_commands.h"
#include "host/shell/commands/import_command.h"
#include "host/shell/commands/info_command.h"
#include "host/shell/commands/keys_command.h"
#include "host/shell/commands/model_command.h"
#include "host/shell/commands/plan_command.h"
#include "host/shell/commands/plot_command.h"
#include "host/shell/commands/preview_command.h"
#include "host/shell/commands/render_command.h"
#include "host/shell/commands/studio_command.h"
#include "host/shell/commands/submit_command.h"
#include "host/shell/commands/verify_command.h"
#include "host/shell/launch/background_text.h"
#include "host/cli/program.h"

namespace mars::programs {
namespace {

constexpr const char* kWayIn = R"(MARS models, animates and renders films in parallel.

Begin with:
  mars doctor                                  check that films can be rendered
  mars render examples/demo.json -o demo       render a film to PNG files
  mars render --help                           all options, with examples

Commands:
  mars render FILM -o DIR          render a film to PNG or EXR files
  mars submit FILM -o DIR          render a film in a job of Slurm
  mars status DIR                  print its progress; also: watch, cancel
  mars compile FILM -o FILM.mars   compute all motion of a film once
  mars info FILM                   print what a film contains
  mars keys [NAME]                 print the keys of film and model files
  mars plan FILM                   forecast time, memory, bytes of a rendering
  mars preview FILM                play a film or a model in the terminal
  mars play DIR                    play rendered frames in the terminal
  mars studio [FILM]               work on a film or a model in the browser
  mars verify DIR                  check that all frames are there and whole
  mars film FILM new               make a film of figures, step by step
  mars animate FILM list           show the keys of a film; also: pose, time ...
  mars plot FILM -o FILE.png       draw joint angles over time
  mars import FILE -o MODEL.json   make a model from a mesh or patch file
  mars model MODEL.json new        make a model of your own, step by step
  mars doctor                      check this machine, with remedies
  mars calibrate                   measure this machine for simulations
  mars bench NAME                  run a benchmark, if MARS was built with it

A film is a JSON file. mars film writes one; docs/film-format.md describes it.
)";

experiments::MessageCosts measure_messages() {
  experiments::MessageCosts costs;
  threads::run_threads(
      2, [&] { costs = experiments::receive_costs(); }, experiments::exchange_messages);
  return costs;
}

// "mars help render" is "mars render --help".
std::vector<const char*> help_as_option(int argc, char** argv) {
  std::vector<const char*> words(argv, argv + argc);
  if (argc < 2 || std::string_view(words[1]) != "help") return words;
  words.erase(words.begin() + 1);
  words.push_back("--help");
  return words;
}

int run(int argc, char** argv) {
  cli::Program mars("mars", "Models, animates and renders films in parallel");
  mars.version("mars " MARS_VERSION);
  std::vector<const char*> words = help_as_option(argc, argv);
  commands::put_model_first(words);
  const commands::NodesCode nodes_code{measure_messages, make_node_counter};
  int code = 0;
  commands::add_render(mars);
  commands::add_submit(mars);
  commands::add_folder_commands(mars, code);
  commands::add_compile(mars);
  commands::add_info(mars);
  commands::add_keys(mars);
  commands::add_plan(mars, nodes_code);
  commands::add_verify(mars, code);
  commands::add_import(mars);
  commands::add_preview(mars, [](const film::CompiledFilm& film) { return std::make_unique<SurfaceFrames>(film); });
  commands::add_play(mars);
  commands::add_studio(mars);
  commands::add_animate(mars, code);
  commands::add_film(mars);
  commands::add_plot(mars);
  commands::add_model(mars);
  commands::add_doctor(mars, {.reserved_cores = kCoresForHost, .version = MARS_VERSION}, code);
  commands::add_calibrate(mars, nodes_code);
  commands::add_bench(mars, words);
  // Last, or each command would have it.
  mars.footer(std::string("mars COMMAND --help prints every option with an example.\n") + cli::kExitCodes);
  if (const auto ended = mars.read(static_cast<int>(words.size()), words.data())) return *ended;
  if (mars.no_command_given()) std::cout << kWayIn;
  return code;
}

}  // namespace
}  // namespace mars::programs

int main(int argc, char** argv) {
  using namespace mars::programs;
  mars::child::prepare_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // beyond ulimit -f a write fails then, and MARS says so
  try {
    const int code = run(argc, argv);
    mars::child::finish_output();
    return mars::launch::exit_code(code);
  } catch (const std::exception& failure) {
    std::cerr << "mars: " << mars::reason_of(failure) << '\n';
    return mars::launch::exit_code(mars::cli::kFailed);
  }
}
