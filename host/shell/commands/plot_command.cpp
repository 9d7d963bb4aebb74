#include "host/shell/commands/plot_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "hal/failure/failure.h"
#include "host/content/animator/gnuplot.h"
#include "host/content/animator/plot.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/film_json.h"

namespace mars::commands {
namespace {

struct Words {
  std::string film, thing, output;
  std::vector<std::string> parts;
};

void plot(const Words& words) {
  const std::filesystem::path output = words.output;
  if (output.extension() != ".png" && output.extension() != ".svg")
    throw Failure("is neither .png nor .svg", words.output, "name the picture like angles.png or angles.svg");
  film::FilmFile file = film::open_film(words.film);
  const animator::Choice choice{words.thing.empty(), words.thing, words.parts};
  const animator::PlotAs as = output.extension() == ".png" ? animator::PlotAs::png : animator::PlotAs::svg;
  document::check_can_write(output);
  const std::string picture = animator::draw_with_gnuplot(animator::plot_script(file.json, file.film, choice, as));
  document::write_whole_file(output, picture);
}

}  // namespace

void add_plot(CLI::App& app) {
  const auto words = std::make_shared<Words>();
  CLI::App* command = app.add_subcommand("plot", "Draw joint angles and places over time, with gnuplot");
  command->add_option("FILM", words->film, "The film file. Example: film.json")->required();
  command->add_option("ACTOR", words->thing,
                      "An actor, camera, light/N or material/NAME; default: all that has keys. Example: robot");
  command->add_option("PART", words->parts,
                      "Only these of its joints, place and turn, or all like a pattern. Example: elbow '*-shin'");
  command->add_option("-o,--output", words->output, "The picture, .png or .svg. Example: -o angles.png")
      ->required()
      ->type_name("FILE");
  command->footer("Dots are keys; the band behind a curve is what its joint's limits allow.\n");
  command->callback([words] { plot(*words); });
}

}  // namespace mars::commands
