#include <CLI/CLI.hpp>
#include <memory>

#include "hal/failure/failure.h"
#include "host/content/animator/frame_words.h"
#include "host/content/animator/tangent.h"
#include "host/editing/words.h"

namespace mars::editing {
namespace {

struct Words {
  std::string thing, part, frame, in, out;
  bool flat = false, automatic = false;
};

animator::SlopeChange change_of(const CLI::App& app, const Words& words) {
  const bool numbers = app.count("--in") + app.count("--out") > 0;
  if (numbers + words.flat + words.automatic != 1)
    throw Failure(numbers || words.flat || words.automatic ? "is given twice" : "is not given", "the slope",
                  "use --in and --out, or --flat, or --auto");
  animator::SlopeChange change{{}, {}, words.flat, words.automatic};
  if (app.count("--in") > 0) change.in = words.in;
  if (app.count("--out") > 0) change.out = words.out;
  return change;
}

void add_options(CLI::App& app, Words& words) {
  app.add_option("ACTOR", words.thing, "An actor, camera, light/N (from 1) or material/NAME. Example: robot")
      ->required();
  app.add_option("PART[.AXIS]", words.part, "One of its parts, or one axis of it. Example: elbow.y")->required();
  app.add_option("-f,--frame", words.frame, "The frame of the key, or a range. Example: --frame 24")
      ->required()
      ->type_name("RANGE");
  app.add_option("--in", words.in,
                 "Change a frame with which the value reaches the key; of a whole part one number for each axis. "
                 "Example: --in 2.5")
      ->type_name("V");
  app.add_option("--out", words.out, "Change a frame with which it leaves the key. Example: --out 2.5")->type_name("V");
  app.add_flag("--flat", words.flat, "Neither rise nor fall at the key. Example: --flat");
  app.add_flag("--auto", words.automatic, "As the keys before and after say. Example: --auto");
}

}  // namespace

void add_tangent(CLI::App& animate, EditedFilm& film) {
  CLI::App* app = animate.add_subcommand("tangent", "Set the slopes of a spline at a key");
  const auto words = std::make_shared<Words>();
  add_options(*app, *words);
  app->callback([&film, words, app] {
    const animator::SlopeChange change = change_of(*app, *words);
    animator::Remarks remarks;
    film.change([&](document::Json& json, const animator::Film& meaning) {
      remarks = animator::set_slopes(json, meaning, words->thing, words->part, animator::read_frame_range(words->frame),
                                     change);
    });
    for (const std::string& remark : remarks) film.remark(remark);
  });
}

}  // namespace mars::editing
