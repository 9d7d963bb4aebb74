#include <algorithm>
#include <functional>
#include <memory>

#include "hal/failure/failure.h"
#include "host/content/animator/pose/check.h"
#include "host/content/animator/keys/frame_words.h"
#include "host/content/animator/listing/keys_table.h"
#include "host/content/animator/keys/pose.h"
#include "host/editing/film_length.h"
#include "host/editing/words.h"
#include "host/cli/program.h"
#include "node/wire/film.h"

namespace mars::editing {
namespace {

constexpr const char* kAnimate = "Set, move, time, list and check the keys of a film";
constexpr const char* kFooter = R"(A command changes FILM in place, or leaves it as it was. Begin with
  mars animate film.json list                              show its keys
  mars animate film.json pose robot elbow.y=90 --frame 24  bend the elbow
  mars animate film.json pose robot elbow.y+=5 --frame 0-48  bend it more
  mars animate film.json time robot --frame 0 --ease both  start and end slowly
More: docs/animating.md.
)";

// What a person typed, of all the commands.
struct AnimateWords {
  EditedFilm& film;
  std::string thing{}, frame{};
  std::optional<animator::Ease> ease{};
  std::vector<std::string> parts{};
  bool all = false, clamp = false, lengthen = false, local = false;
  std::uint32_t to = 0, hold = 0, falloff = 0;
  std::int64_t shift = 0;
  double stretch = 0, anticipation = 0, overshoot = 0;

  animator::Choice choice() const { return {all, thing, parts}; }
};

// Changes the film by `change`; it stays as it was where that fails or the result is no film.
void edit(const AnimateWords& words,
          const std::function<animator::Remarks(document::Json&, const animator::Film&)>& change) {
  animator::Remarks remarks;
  std::string note;
  const auto changed = [&](document::Json& json, const animator::Film& film) {
    const std::uint32_t before = animator::last_key(json);
    remarks = change(json, film);
    const std::uint32_t last = animator::last_key(json);
    const std::string length = fit_length(json, last, words.lengthen);
    if (length.empty() || (!words.lengthen && last <= before)) return;
    note = words.lengthen ? length + "\n"
                          : "the last key is at frame " + std::to_string(last) + "; " + length +
                                ": --lengthen, or set its frames to " + std::to_string(last + 1) + "\n";
  };
  if (words.all || words.lengthen)
    words.film.change(changed);
  else
    words.film.change_thing(words.thing, changed);
  for (const std::string& remark : remarks) words.film.remark(remark);
  if (!note.empty()) words.film.print(note);
}

// The options that several commands have.
class AnimateCommand {
 public:
  AnimateCommand(cli::Command animate, AnimateWords& words, const char* name, const char* purpose)
      : app_(animate.add_command(name, purpose)), words_(words) {}

  AnimateCommand& thing(const char* help) {
    app_.add("ACTOR", words_.thing, help);
    return *this;
  }
  AnimateCommand& parts(const char* name, const char* help) {
    app_.add(name, words_.parts, help);
    return *this;
  }
  AnimateCommand& all() {
    app_.add_flag("--all", words_.all,
                  "Instead of an actor: everything that has keys, also camera, lights and materials. Example: --all");
    return *this;
  }
  AnimateCommand& frame(const char* help, const char* type) {
    app_.add("-f,--frame", words_.frame, help).required().type(type);
    return *this;
  }
  AnimateCommand& ease(const char* help) {
    const auto read = [&words = words_](const std::string& word) { words.ease = animator::read_typed_ease(word); };
    app_.add_read("--ease", read, help).type("EASE");
    return *this;
  }
  AnimateCommand& to(const char* help) {
    app_.add("--to", words_.to, help).required().type("FRAME").range(0u, wire::kMostFrames);
    return *this;
  }
  AnimateCommand& clamp() {
    app_.add_flag("--clamp", words_.clamp, "Clamp angles to the limits of their joints. Example: --clamp");
    return *this;
  }
  AnimateCommand& lengthen() {
    app_.add_flag("--lengthen", words_.lengthen, "Make the film long enough for its last key. Example: --lengthen");
    return *this;
  }
  void runs(const std::function<void()>& run) {
    app_.runs([this_words = &words_, run] {
      if (this_words->all && !this_words->thing.empty())
        throw Failure("are given both", "--all and '" + this_words->thing + "'", "choose one of them");
      run();
    });
  }
  cli::Command app() { return app_; }

 private:
  cli::Command app_;
  AnimateWords& words_;
};

constexpr const char* kThing = "An actor, camera, light/N (from 1) or material/NAME. Example: robot";
constexpr const char* kParts =
    "Only these joints, place or turn (camera: eye, at, up, fov, height, shift), or all that match a pattern. Example: "
    "elbow place "
    "'*-shin'";
constexpr const char* kOneFrame = "The frame. Example: --frame 24";
constexpr const char* kRange = "The frame, or a range of frames, both ends included. Example: --frame 24-48";
constexpr const char* kEase =
    "Ease from this key to the next: linear, in, out, both, spline, hold or a curve. Example: --ease both or --ease "
    "0.4,0,0.6,1";

void require_thing(const AnimateWords& words) {
  if (words.thing.empty() && !words.all)
    throw Failure("is not given", "whose keys to change",
                  "name an actor, camera, light/N or material/NAME, or use --all");
}

void add_pose(cli::Command animate, AnimateWords& words) {
  AnimateCommand command(animate, words, "pose",
                         "Set or turn joints of an actor, its place, the camera, lights and materials");
  command.thing(kThing)
      .parts("PART=NUMBERS",
             "One axis of a part, or all: degrees, or a place; other parts keep their values. += and -= add to the "
             "value at the frame; * stands for any text. Example: elbow.y=90 place=2,0,0 turn.z+=45 '*-shin.y-=10'")
      .frame("The frame; with += or -= also a range, in which all keys of the part change. Example: --frame 24",
             "FRAME")
      .ease(kEase)
      .clamp()
      .lengthen();
  command.app()
      .add("--falloff", words.falloff,
           "Blend the change over N frames to both sides: where keys are dense, one alone would pop. "
           "Example: --falloff 8")
      .type("N")
      .range(1u, wire::kMostFrames);
  command.app().add_flag("--local", words.local,
                         "With += and -=: turn each joint about its own axis as it stands, after all its turns. "
                         "Example: stem.x+=30 --local");
  command.app().option("ACTOR").required();
  command.app().option("PART=NUMBERS").required();
  command.runs([&words] {
    const animator::FrameRange range = animator::read_frame_range(words.frame);
    const auto beyond = words.clamp ? animator::Beyond::clamped : animator::Beyond::refused;
    const bool plain =
        range.first == range.last && !words.ease && !words.lengthen && words.falloff == 0 && !words.local;
    if (plain && words.film.show_pose(words.thing, words.parts, range.first, beyond)) return;
    edit(words, [&](document::Json& json, const animator::Film& film) {
      return animator::pose(json, film, words.thing, words.parts, range,
                            {words.ease, beyond, words.falloff, words.local});
    });
  });
}

void add_key(cli::Command animate, AnimateWords& words) {
  AnimateCommand command(animate, words, "key", "Make keys with the values that parts have at a frame");
  command.thing(kThing)
      .parts("PART", kParts)
      .all()
      .frame(kOneFrame, "FRAME")
      .ease("Ease from this key to the next; default: the motion stays the same. Example: --ease both");
  command.clamp().lengthen().runs([&words] {
    require_thing(words);
    edit(words, [&](document::Json& json, const animator::Film& film) {
      return animator::make_keys(json, film, words.choice(), animator::read_frame(words.frame), words.ease,
                                 words.clamp ? animator::Beyond::clamped : animator::Beyond::refused);
    });
  });
}

void add_cut(cli::Command animate, AnimateWords& words) {
  AnimateCommand command(animate, words, "cut",
                         "Let the camera or another thing jump: what is before the frame stays as it is");
  command.thing(kThing)
      .parts("PART", kParts)
      .all()
      .frame("The frame at which it may be elsewhere at once: pose it there. Example: --frame 24", "FRAME");
  command.lengthen().runs([&words] {
    require_thing(words);
    edit(words, [&](document::Json& json, const animator::Film& film) {
      return animator::cut(json, film, words.choice(), animator::read_frame(words.frame));
    });
  });
}

void add_displacing(cli::Command animate, AnimateWords& words, const char* name, const char* purpose, bool copies) {
  AnimateCommand command(animate, words, name, purpose);
  command.thing(kThing).parts("PART", kParts).all().frame(kRange, "RANGE");
  command.to("The frame to which the range's first frame moves. Example: --to 60").lengthen().runs([&words, copies] {
    require_thing(words);
    edit(words, [&](document::Json& json, const animator::Film& film) {
      return (copies ? animator::copy_keys : animator::move_keys)(json, film, words.choice(),
                                                                  animator::read_frame_range(words.frame), words.to);
    });
  });
}

void add_delete(cli::Command animate, AnimateWords& words) {
  AnimateCommand command(animate, words, "delete", "Delete keys");
  command.thing(kThing).parts("PART", kParts).all().frame(kRange, "RANGE").runs([&words] {
    require_thing(words);
    edit(words, [&](document::Json& json, const animator::Film& film) {
      return animator::delete_keys(json, film, words.choice(), animator::read_frame_range(words.frame));
    });
  });
}

animator::Remarks retime(const AnimateWords& words, cli::Command command, document::Json& json,
                         const animator::Film& film) {
  const animator::FrameRange range = animator::read_frame_range(words.frame);
  if (command.given("--hold"))
    return animator::hold(json, film, words.choice(), animator::read_frame(words.frame), words.hold);
  if (command.given("--shift"))
    return animator::shift(json, film, words.choice(), animator::read_frame(words.frame), words.shift);
  if (command.given("--stretch")) return animator::stretch(json, film, words.choice(), range, words.stretch);
  if (words.ease) return animator::ease_keys(json, film, words.choice(), range, *words.ease);
  return animator::ease_keys(json, film, words.choice(), range,
                             animator::swinging(words.anticipation / 100, words.overshoot / 100));
}

void add_time(cli::Command animate, AnimateWords& words) {
  AnimateCommand command(animate, words, "time", "Change the timing of an actor, of some of its parts or of the film");
  command.thing(kThing).parts("PART", kParts).all().frame(kRange, "RANGE").ease(kEase);
  const cli::Command app = command.app();
  app.add("--hold", words.hold,
          "Stand still for N frames from the frame on; later keys come N frames later. Example: --hold 12")
      .type("N")
      .range(1u, wire::kMostFrames);
  app.add("--stretch", words.stretch,
          "Multiply the length of the range by FACTOR; later keys move with its end. Example: --stretch 1.5")
      .type("FACTOR")
      .range(0.001, 1000.0);
  app.add("--shift", words.shift,
          "Move the keys from the frame on N frames later; a negative N: earlier. Example: --shift -6")
      .type("N")
      .range(-std::int64_t{wire::kMostFrames}, std::int64_t{wire::kMostFrames});
  for (const auto& [name, value, help] :
       {std::tuple("--anticipate", &words.anticipation,
                   "After the frame's keys, first swing back, by PERCENT of the motion. Example: --anticipate 15"),
        std::tuple("--overshoot", &words.overshoot,
                   "Swing beyond the next keys and back, by PERCENT of the motion. Example: --overshoot 10")})
    app.add(name, *value, help).type("PERCENT").range(0.0, 100.0);
  command.lengthen().runs([&words, app] {
    require_thing(words);
    int changes = 0;
    for (const char* name : {"--ease", "--hold", "--stretch", "--shift"}) changes += app.given(name);
    changes += app.given("--anticipate") || app.given("--overshoot");
    if (changes != 1)
      throw Failure(changes == 0 ? "is not given" : "is given twice", "the change of timing",
                    "use one of --ease, --hold, --stretch, --shift, or --anticipate and --overshoot");
    edit(words, [&](document::Json& json, const animator::Film& film) { return retime(words, app, json, film); });
  });
}

void add_list(cli::Command animate, AnimateWords& words) {
  AnimateCommand command(animate, words, "list", "Show the keys in a table");
  command.thing("An actor, camera, light/N or material/NAME; default: all that has keys. Example: robot")
      .parts("PART", kParts);
  command.app().add("-f,--frame", words.frame, kRange).type("RANGE");
  command.runs([&words] {
    film::FilmFile file = words.film.read();
    const animator::FrameRange range =
        words.frame.empty() ? animator::FrameRange{0, wire::kMostFrames} : animator::read_frame_range(words.frame);
    words.film.print(
        animator::keys_table(file.json, file.film, {words.thing.empty(), words.thing, words.parts}, range));
  });
}

void add_check(cli::Command animate, AnimateWords& words, int& code) {
  AnimateCommand command(animate, words, "check",
                         "Report errors: limits broken between keys, keys after the last frame and more");
  command.runs([&words, &code] {
    const animator::Findings findings = animator::check_film(words.film.read().film);
    for (const std::string& line : findings.lines) words.film.print(line + "\n");
    if (findings.lines.empty())
      words.film.print(words.film.path().string() + ": all joints stay within their limits; no errors\n");
    if (findings.trouble) code = cli::kFailed;
  });
}

}  // namespace

void add_animate_pose(cli::Command mars, EditedFilm& film) {
  const auto words = std::make_shared<AnimateWords>(film);
  add_pose(mars.add_command("animate", kAnimate), *words);
  mars.keeps(words);
}

cli::Command add_animate(cli::Command mars, EditedFilm& film, int& code) {
  const auto words = std::make_shared<AnimateWords>(film);
  const cli::Command animate = mars.add_command("animate", kAnimate);
  add_pose(animate, *words);
  add_key(animate, *words);
  add_cut(animate, *words);
  add_displacing(animate, *words, "move", "Move keys to other frames", false);
  add_displacing(animate, *words, "copy", "Copy keys to other frames", true);
  add_delete(animate, *words);
  add_time(animate, *words);
  add_tangent(animate, film);
  add_reduce(animate, film);
  add_list(animate, *words);
  add_check(animate, *words, code);
  add_carrying(animate, film);
  add_motion(animate, film);
  add_transfer(animate, film);
  animate.footer(kFooter);  // last, or each of its commands would have it
  animate.keeps(words);
  return animate;
}

}  // namespace mars::editing
