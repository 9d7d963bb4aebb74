#include <memory>

#include "host/cli/command.h"
#include "host/content/animator/keys/frame_words.h"
#include "host/content/animator/keys/reduce.h"
#include "host/content/document/text.h"
#include "host/editing/words.h"
#include "node/wire/film.h"

namespace mars::editing {
namespace {

struct ReduceWords {
  animator::Choice choice;
  std::string frame;
  animator::ReductionError error{0, {}};
  double distance = 0;
};

std::string report_of(const animator::Reduction& done) {
  return document::counted(done.keys_before, "key") + " in " + document::counted(done.frames_before, "frame") +
         " became " + std::to_string(done.keys_after) + " in " + std::to_string(done.frames_after) + "\n";
}

void reduce(EditedFilm& film, const ReduceWords& words) {
  const animator::FrameRange range =
      words.frame.empty() ? animator::FrameRange{0, wire::kMostFrames} : animator::read_frame_range(words.frame);
  animator::Reduction done;
  film.change([&](document::Json& json, const animator::Film& meaning) {
    done = animator::reduce_keys(json, meaning, words.choice, range, words.error);
  });
  for (const std::string& remark : done.remarks) film.remark(remark);
  film.print(report_of(done));
}

}  // namespace

void add_reduce(cli::Command animate, EditedFilm& film) {
  const cli::Command app = animate.add_command("reduce", "Make many keys a few, with splines through them");
  const auto words = std::make_shared<ReduceWords>();
  app.add("ACTOR", words->choice.thing, "An actor, or camera. Example: robot").required();
  app.add("PART", words->choice.parts, "Only these of its joints, place and turn. Example: elbow place");
  app.add("--error", words->error.degrees,
          "How far a turn may be from what it was, in every frame. Example: --error 0.5")
      .required()
      .type("DEGREES")
      .range(0.001, 90.0);
  const cli::Option distance =
      app.add("--distance", words->distance,
              "The same for places; default: as far as the angle moves a point at the figure's size. "
              "Example: --distance 0.01")
          .type("D")
          .range(1e-6, 1e6);
  app.add("-f,--frame", words->frame, "Only keys in this range. Example: --frame 24-48").type("RANGE");
  app.runs([&film, words, distance] {
    if (distance.given()) words->error.distance = words->distance;
    reduce(film, *words);
  });
}

}  // namespace mars::editing
