// mars: what a person types. It knows no MPI: `mars render` starts the programs that do.
#include <CLI/CLI.hpp>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <string_view>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/messages/settings.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/compile.h"
#include "host/content/film/describe.h"
#include "host/content/film/film_file.h"
#include "host/content/film/frame_set.h"
#include "host/programs/node_job.h"
#include "host/programs/standard_streams.h"
#include "host/programs/surface_frames.h"
#include "host/render/sinks/verify.h"
#include "host/shell/commands/animate_command.h"
#include "host/shell/commands/import_command.h"
#include "host/shell/commands/model_command.h"
#include "host/shell/commands/plot_command.h"
#include "host/shell/commands/preview_command.h"
#include "host/shell/doctor/doctor.h"
#include "host/shell/job/film_of.h"
#include "host/shell/launch/background_text.h"
#include "host/shell/launch/bench.h"
#include "host/shell/launch/launch.h"
#include "host/shell/options/command_line.h"

namespace mars::programs {
namespace {

constexpr const char* kWayIn = R"(MARS models, animates and renders films in parallel.

Begin with:
  mars doctor                                  check that films can be rendered
  mars render examples/demo.json -o demo       the demonstration, as PNG files
  mars render --help                           every option, with an example

Commands:
  mars render FILM -o DIR          render a film to PNG files
  mars compile FILM -o FILM.mars   compute all its motion once
  mars info FILM                   print what a film holds
  mars preview FILM                play a film or a model in the terminal, before it is rendered
  mars play DIR                    play rendered frames in the terminal
  mars verify DIR                  check that all frames are there and whole
  mars animate FILM list           the keys of a film; pose, key, move, time and more
  mars plot FILM -o FILE.png       joint angles over time, as a picture
  mars import FILE -o MODEL.json   a model from a mesh or patch file
  mars model new MODEL.json        a model of your own, step by step
  mars doctor                      check this machine, with remedies
  mars bench NAME                  measure, where MARS was built from its sources

A film is a JSON file: docs/film-format.md says how to write one.
)";

constexpr const char* kEnds =
    R"(Exit codes: 0 success; 1 failure, reported on standard error; 2 wrong command
line.
)";

struct Verifying {
  std::string folder;
  bool missing = false;
};

std::filesystem::path own_file() { return std::filesystem::read_symlink("/proc/self/exe"); }

// Exit code 0 in any case; prints nothing if no frame is missing.
void print_missing(const sinks::Verdict& verdict) {
  std::vector<std::uint32_t> frames;
  for (const sinks::Verdict::Trouble& trouble : verdict.troubles) frames.push_back(trouble.frame);
  if (!frames.empty()) std::cout << film::FrameSet(frames).text() << '\n';
}

int print_verdict(const sinks::Verdict& verdict) {
  for (const sinks::Verdict::Trouble& trouble : verdict.troubles) {
    std::cout << "frame " << trouble.frame << ": " << trouble.reason << '\n';
  }
  if (!verdict.troubles.empty()) {
    std::cout << verdict.troubles.size() << " of " << verdict.expected << " frames are missing or wrong\n";
    return options::kFailed;
  }
  std::cout << verdict.expected << " frames, all there";
  std::cout << (verdict.compared ? " and whole\n" : "; frames.json has no pixel hashes, so pixels were not compared\n");
  std::cout << "pixels " << verdict.hash << '\n';
  return 0;
}

std::string info_of(const std::string& path) {
  options::RenderOptions options;
  options.film = path;
  std::string warnings;
  const film::CompiledFilm film =
      job::load_film_of(options, [&](const std::string& line) { warnings += "warning     " + line + "\n"; });
  return film::describe(film) + warnings;
}

void add_render(CLI::App& app, options::RenderOptions& options) {
  CLI::App* command = app.add_subcommand("render", "Render a film to PNG files");
  options::add_render_options(*command, options, options::Program::mars);
  command->footer("Environment variables:\n" + messages::settings_text() + "\n" + kEnds);
  command->callback([&options] { launch::launch_render(options, own_file(), doctor::adviser(own_file())); });
}

void add_compile(CLI::App& app, options::RenderOptions& options, std::string& output) {
  CLI::App* command = app.add_subcommand("compile", "Compute a film's motion once, to a .mars file");
  options::add_render_options(*command, options, options::Program::compile);
  command->add_option("-o,--output", output, "The compiled film. Example: -o film.mars")->required()->type_name("FILE");
  command->callback([&] {
    document::refuse_same_file(options.film, output);
    film::save_film(
        job::load_film_of(options, [](const std::string& line) { std::cerr << "mars: warning: " << line << '\n'; }),
        output);
  });
}

void add_info(CLI::App& app, std::string& film) {
  CLI::App* command = app.add_subcommand("info", "Print what a film holds");
  command->add_option("FILM", film, "A .json or .mars file. Example: examples/demo.json")->required();
  command->callback([&] { std::cout << info_of(film); });
}

void add_verify(CLI::App& app, Verifying& verifying, int& code) {
  CLI::App* command = app.add_subcommand("verify", "Check every frame of a folder; print one hash of all pixels");
  command->add_option("DIR", verifying.folder, "The folder given to mars render with -o. Example: build/demo")
      ->required();
  command->add_flag("--missing", verifying.missing,
                    "Print only the missing or wrong frames, in the form of --frames; nothing if there are none. "
                    "Example: --missing");
  command->footer(
      "To render the missing frames:\n"
      "  missing=$(mars verify DIR --missing)\n"
      "  [ -z \"$missing\" ] || mars render FILM -o DIR --frames \"$missing\"\n");
  command->callback([&] {
    const sinks::Verdict verdict = sinks::verify_folder(verifying.folder);
    if (verifying.missing)
      print_missing(verdict);
    else
      code = print_verdict(verdict);
  });
}

void add_doctor(CLI::App& app, doctor::DoctorOptions& options, int& code) {
  CLI::App* command = app.add_subcommand("doctor", "Check whether films can be rendered here, and print remedies");
  command
      ->add_option("--nodes", options.nodes,
                   "Check for N nodes and show where each is placed; default: as mars render. "
                   "Example: --nodes 4")
      ->check(CLI::Range(1, 1 << 20).description(""))
      ->type_name("N");
  command->add_flag("--this-machine", options.this_machine)->group("");  // asked by itself, on other machines
  command->footer(kEnds);
  command->callback([&] { code = doctor::run_doctor(options, own_file()) ? 0 : options::kFailed; });
}

void add_bench(CLI::App& app, std::string& name, const std::vector<std::string>& own_words) {
  CLI::App* command = app.add_subcommand("bench", "Run a benchmark, or list them");
  command->add_option("NAME", name, "The benchmark; the words after it are its own. Example: peers --scenes s1");
  command->footer("mars bench NAME --help prints the benchmark's own options.\n");
  command->callback([&] {
    if (name.empty())
      std::cout << launch::list_benchmarks(own_file());
    else
      launch::run_benchmark(own_file(), name, own_words);
  });
}

// What follows a benchmark's name is taken from the command line: the benchmark reads it.
std::vector<std::string> take_benchmark_words(std::vector<const char*>& words) {
  std::vector<std::string> own;
  if (words.size() <= 3 || std::string_view(words[1]) != "bench" || words[2][0] == '-') return own;
  own.assign(words.begin() + 3, words.end());
  words.resize(3);
  return own;
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
  CLI::App app("Models, animates and renders films in parallel", "mars");
  app.set_version_flag("--version", "mars " MARS_VERSION, "Print the version. Example: --version");
  app.require_subcommand(0, 1);
  options::RenderOptions options;
  std::string compiled_film, film, benchmark;
  Verifying verifying;
  int code = 0;
  add_render(app, options);
  add_compile(app, options, compiled_film);
  add_info(app, film);
  add_verify(app, verifying, code);
  commands::add_import(app);
  commands::add_preview(app, [](const film::CompiledFilm& film) { return std::make_unique<SurfaceFrames>(film); });
  commands::add_play(app);
  commands::add_animate(app, code);
  commands::add_plot(app);
  commands::add_model(app);
  doctor::DoctorOptions doctor;
  doctor.reserved_cores = kCoresForHost;
  doctor.version = MARS_VERSION;
  add_doctor(app, doctor, code);
  std::vector<const char*> words = help_as_option(argc, argv);
  const std::vector<std::string> benchmark_words = take_benchmark_words(words);
  add_bench(app, benchmark, benchmark_words);
  // Last, or each command would have it.
  app.footer(std::string("mars COMMAND --help prints every option with an example.\n") + kEnds);
  if (const auto ended = options::read_command_line(app, static_cast<int>(words.size()), words.data())) return *ended;
  if (app.get_subcommands().empty()) std::cout << kWayIn;
  return code;
}

}  // namespace
}  // namespace mars::programs

int main(int argc, char** argv) {
  using namespace mars::programs;
  open_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // beyond ulimit -f a write fails then, and MARS says so
  try {
    return mars::launch::exit_code(run(argc, argv));
  } catch (const std::exception& failure) {
    std::cerr << "mars: " << mars::reason_of(failure) << '\n';
    return mars::launch::exit_code(mars::options::kFailed);
  }
}
