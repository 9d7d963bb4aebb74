#include "host/shell/commands/compile_command.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "hal/failure/failure.h"
#include "host/cli/command.h"
#include "host/content/document/recorded_reads.h"
#include "host/content/film/film_file.h"
#include "host/shell/job/film_of.h"
#include "host/shell/options/render_options.h"

namespace mars::commands {
namespace {

struct CompileWords {
  options::RenderOptions options;
  std::string output;
};

void compile(const CompileWords& words) {
  if (std::filesystem::path(words.output).extension() == ".json")
    throw Failure("has the name of a film or model as people write it", words.output, "name it like film.mars");
  const auto warn = [](const std::string& line) { std::cerr << "mars: warning: " << line << '\n'; };
  const document::RecordedReads reads;
  const film::CompiledFilm film = job::load_film_of(words.options, warn);
  reads.refuse_output(words.output);
  film::save_film(film, words.output);
}

}  // namespace

void add_compile(cli::Command app) {
  const auto words = std::make_shared<CompileWords>();
  const cli::Command command = app.add_command("compile", "Compute a film's motion once, to a .mars file");
  options::add_render_options(command, words->options, options::Program::compile);
  command.add("-o,--output", words->output, "The compiled film. Example: -o film.mars").required().type("FILE");
  command.runs([words] { compile(*words); });
}

}  // namespace mars::commands
