#include <memory>

#include "hal/failure/failure.h"
#include "host/cli/command.h"
#include "host/content/animator/keys/carry.h"
#include "host/content/animator/keys/frame_words.h"
#include "host/editing/words.h"

namespace mars::editing {
namespace {

// What a person typed; callbacks keep it.
struct CarryWords {
  EditedFilm& film;
  std::string actor{}, to{}, frame{};
  std::vector<double> place{}, turn{}, offset{};
  std::string axes = "world";
  bool level = false, end = false;
};
using SharedWords = std::shared_ptr<CarryWords>;

std::optional<glm::dvec3> vector_if_given(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::nullopt;
  return glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

void add_frame(cli::Command app, CarryWords& words) {
  app.add("-f,--frame", words.frame, "From this frame on. Example: --frame 24").required().type("FRAME");
}

void add_vector(cli::Command app, const char* name, std::vector<double>& numbers, const char* help) {
  app.add(name, numbers, help).words(3).type("X Y Z");
}

void add_attach(cli::Command animate, const SharedWords& words) {
  const cli::Command app = animate.add_command("attach", "Attach an actor to another actor, or to a joint of it");
  app.add("ACTOR", words->actor, "The actor that is carried. Example: ball").required();
  app.add("--to", words->to, "The actor or joint that carries it. Example: --to tom/right-hand")
      .required()
      .type("ACTOR[/JOINT]");
  add_frame(app, *words);
  add_vector(app, "--place", words->place,
             "Its place in the joint's frame; default: its present place. Example: --place 0 0 0.1");
  add_vector(app, "--turn", words->turn,
             "Its turn relative to the joint, in degrees; default: its present turn. Example: --turn 0 90 0");
  app.runs([words] {
    words->film.change([&](document::Json& json, const animator::Film& film) {
      animator::attach(json, film, words->actor, words->to, animator::read_frame(words->frame),
                       {vector_if_given(words->place), vector_if_given(words->turn)});
    });
  });
}

void add_detach(cli::Command animate, const SharedWords& words) {
  const cli::Command app = animate.add_command("detach", "Detach an actor: it stays where it is at that frame");
  app.add("ACTOR", words->actor, "The actor that is carried. Example: ball").required();
  add_frame(app, *words);
  app.runs([words] {
    words->film.change([&](document::Json& json, const animator::Film& film) {
      animator::detach(json, film, words->actor, animator::read_frame(words->frame));
    });
  });
}

animator::Remarks change_camera(const CarryWords& words, document::Json& json, const animator::Film& film,
                                const animator::Following& following) {
  if (words.end != words.to.empty())
    throw Failure(words.end ? "are given both" : "is not given", words.end ? "an actor and --end" : "the actor",
                  "name an actor, as in tom/head, or use --end");
  const std::uint32_t frame = animator::read_frame(words.frame);
  return words.end ? animator::unfollow(json, film, following.part, frame)
                   : animator::follow(json, film, words.to, frame, following);
}

void change_camera(const CarryWords& words, const animator::Following& following) {
  animator::Remarks remarks;
  words.film.change(
      [&](document::Json& json, const animator::Film& film) { remarks = change_camera(words, json, film, following); });
  for (const std::string& remark : remarks) words.film.remark(remark);
}

cli::Command add_camera(cli::Command animate, const SharedWords& words, const char* name, const char* purpose,
                        const char* end) {
  const cli::Command app = animate.add_command(name, purpose);
  app.add("ACTOR[/JOINT]", words->to, "Example: tom/head");
  add_frame(app, *words);
  app.add_flag("--end", words->end, end);
  return app;
}

void add_look(cli::Command animate, const SharedWords& words) {
  const cli::Command app =
      add_camera(animate, words, "look", "Make the camera look at an actor or a joint while it moves",
                 "End this: the camera keeps looking at the place where it looks at that frame. Example: --end");
  add_vector(app, "--offset", words->offset,
             "Vector from the joint, along the world's axes; default: the joint itself, or the middle of the actor. "
             "Example: --offset 0 0 0.2");
  app.runs([words] { change_camera(*words, {"at", vector_if_given(words->offset), false, false}); });
}

void add_follow(cli::Command animate, const SharedWords& words) {
  const cli::Command app = add_camera(animate, words, "follow", "Make the camera move with an actor or a joint",
                                      "End this: the camera stays where it is at that frame. Example: --end");
  add_vector(app, "--offset", words->offset,
             "Vector from the actor or joint to the camera; default: the present one. Example: --offset 0 -4 1.5");
  app.add("--axes", words->axes, "Axes of the offset: world or joint; default: world. Example: --axes joint")
      .type("AXES")
      .one_of({"world", "joint"});
  app.add_flag("--level", words->level, "Keep the camera at one height, the z of the offset. Example: --level");
  app.runs([words] {
    change_camera(*words, {"eye", vector_if_given(words->offset), words->axes == "joint", words->level});
  });
}

}  // namespace

void add_carrying(cli::Command animate, EditedFilm& film) {
  const auto attaching = std::make_shared<CarryWords>(film), camera = std::make_shared<CarryWords>(film);
  add_attach(animate, attaching);
  add_detach(animate, attaching);
  add_look(animate, camera);
  add_follow(animate, camera);
}

}  // namespace mars::editing
