#include <memory>

#include "hal/failure/failure.h"
#include "host/cli/command.h"
#include "host/content/animator/keys/frame_words.h"
#include "host/content/animator/keys/tangent.h"
#include "host/editing/words.h"

namespace mars::editing {
namespace {

struct TangentWords {
  std::string thing, part, frame, in, out;
  bool flat = false, automatic = false;
};

animator::SlopeChange change_of(cli::Command app, const TangentWords& words) {
  const bool numbers = app.given("--in") || app.given("--out");
  if (numbers + words.flat + words.automatic != 1)
    throw Failure(numbers || words.flat || words.automatic ? "is given twice" : "is not given", "the slope",
                  "use --in and --out, or --flat, or --auto");
  animator::SlopeChange change{{}, {}, words.flat, words.automatic};
  if (app.given("--in")) change.in = words.in;
  if (app.given("--out")) change.out = words.out;
  return change;
}

void add_options(cli::Command app, TangentWords& words) {
  app.add("ACTOR", words.thing, "An actor, camera, light/N (from 1) or material/NAME. Example: robot").required();
  app.add("PART[.AXIS]", words.part, "One of its parts, or one axis of it. Example: elbow.y").required();
  app.add("-f,--frame", words.frame, "The frame of the key, or a range. Example: --frame 24").required().type("RANGE");
  app.add("--in", words.in,
          "Change a frame with which the value reaches the key; of a whole part one number for each axis. "
          "Example: --in 2.5")
      .type("V");
  app.add("--out", words.out, "Change a frame with which it leaves the key. Example: --out 2.5").type("V");
  app.add_flag("--flat", words.flat, "Neither rise nor fall at the key. Example: --flat");
  app.add_flag("--auto", words.automatic, "As the keys before and after say. Example: --auto");
}

}  // namespace

void add_tangent(cli::Command animate, EditedFilm& film) {
  const cli::Command app = animate.add_command("tangent", "Set the slopes of a spline at a key");
  const auto words = std::make_shared<TangentWords>();
  add_options(app, *words);
  app.runs([&film, words, app] {
    const animator::SlopeChange change = change_of(app, *words);
    animator::Remarks remarks;
    film.change_thing(words->thing, [&](document::Json& json, const animator::Film& meaning) {
      remarks = animator::set_slopes(json, meaning, words->thing, words->part, animator::read_frame_range(words->frame),
                                     change);
    });
    for (const std::string& remark : remarks) film.remark(remark);
  });
}

}  // namespace mars::editing
