#include "host/shell/commands/plot_command.h"

#include <memory>

#include "hal/failure/failure.h"
#include "host/cli/command.h"
#include "host/content/animator/listing/gnuplot.h"
#include "host/content/animator/listing/plot.h"
#include "host/content/document/recorded_reads.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/film_json.h"

namespace mars::commands {
namespace {

struct PlotWords {
  std::string film, thing, output;
  std::vector<std::string> parts;
};

void plot(const PlotWords& words) {
  const std::filesystem::path output = words.output;
  if (output.extension() != ".png" && output.extension() != ".svg")
    throw Failure("is neither .png nor .svg", words.output, "name the picture like angles.png or angles.svg");
  const document::RecordedReads reads;
  film::FilmFile file = film::open_film(words.film);
  reads.refuse_output(output);
  const animator::Choice choice{words.thing.empty(), words.thing, words.parts};
  const animator::PlotAs as = output.extension() == ".png" ? animator::PlotAs::png : animator::PlotAs::svg;
  document::check_can_write(output);
  const std::string picture = animator::draw_with_gnuplot(animator::plot_script(file.json, file.film, choice, as));
  document::write_whole_file(output, picture);
}

}  // namespace

void add_plot(cli::Command app) {
  const auto words = std::make_shared<PlotWords>();
  const cli::Command command = app.add_command("plot", "Draw joint angles and places over time, with gnuplot");
  command.add("FILM", words->film, "The film file. Example: film.json").required();
  command.add("ACTOR", words->thing,
              "An actor, camera, light/N or material/NAME; default: all that has keys. Example: robot");
  command.add("PART", words->parts,
              "Only these of its joints, place and turn, or all like a pattern. Example: elbow '*-shin'");
  command.add("-o,--output", words->output, "The picture, .png or .svg. Example: -o angles.png")
      .required()
      .type("FILE");
  command.footer("Dots are keys; the band behind a curve is what its joint's limits allow.\n");
  command.runs([words] { plot(*words); });
}

}  // namespace mars::commands
