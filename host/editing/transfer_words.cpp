#include <algorithm>
#include <cmath>
#include <memory>

#include "hal/failure/failure.h"
#include "host/cli/command.h"
#include "host/content/animator/keys/frame_words.h"
#include "host/content/animator/keys/reduce.h"
#include "host/content/animator/motion/transfer/transfer.h"
#include "host/content/animator/pose/attachments.h"
#include "host/content/animator/pose/within_limits.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/document/text.h"
#include "host/editing/film_length.h"
#include "host/editing/words.h"
#include "node/wire/film.h"

namespace mars::editing {
namespace {

constexpr std::size_t kNamed = 6;  // of a list of joints

struct TransferWords {
  std::string actor, from, other, frame;
  std::optional<std::uint32_t> at;
  double error = 0.2;
  bool lengthen = false;
};

// The film's actor of this name or, without one, its only one whose joints move.
std::size_t source_actor(const animator::Film& film, const std::string& name) {
  std::vector<std::string_view> names;
  std::vector<std::size_t> moving;
  for (std::size_t actor = 0; actor < film.actors.size(); ++actor) {
    if (film.actors[actor].name == name) return actor;
    names.push_back(film.actors[actor].name);
    if (animator::last_key(film.actors[actor].motion) > 0 || !film.actors[actor].matrices.empty())
      moving.push_back(actor);
  }
  if (!name.empty())
    throw Failure("is no actor of " + document::in_quotes(film.source), document::in_quotes(name),
                  document::did_you_mean(name, names, "name one of them: " + document::joined(names)));
  if (moving.size() == 1) return moving.front();
  throw Failure(moving.empty() ? "has no actor with keys" : "has several actors with keys",
                document::in_quotes(film.source), "say whose motion: --actor NAME");
}

motion::MotionSource source_of(const animator::Film& film, const TransferWords& words) {
  const std::size_t actor = source_actor(film, words.other);
  const std::uint32_t last = animator::last_key(film.actors[actor].motion);
  animator::FrameRange range =
      words.frame.empty() ? animator::FrameRange{0, wire::kMostFrames} : animator::read_frame_range(words.frame);
  range.last = std::min(range.last, last);
  if (range.first >= range.last && film.actors[actor].matrices.empty())
    throw Failure("has no motion " + animator::shown_range(range), "actor '" + film.actors[actor].name + "'",
                  "its last key is at frame " + std::to_string(last));
  return {film, actor, range};
}

std::string rounded_text(double value, int digits) { return document::shown(document::rounded_to(value, digits)); }

// The first of a list.
std::string some_of(std::vector<std::string> names) {
  const bool more = names.size() > kNamed;
  names.resize(std::min(kNamed, names.size()));
  return document::joined(names) + (more ? ", ..." : "");
}

std::vector<std::string> names_of(const std::vector<motion::Limited>& limited) {
  std::vector<std::string> names;
  for (const motion::Limited& each : limited)
    names.push_back(each.joint + " " + rounded_text(std::ceil(each.degrees), 3));
  return names;
}

std::string report_of(const motion::Transferred& done, const animator::Film& from, const animator::Film& to) {
  std::string text = "frames " + std::to_string(done.first) + " to " + std::to_string(done.last) + ": " +
                     document::counted(done.by_limb, "joint") + " by limb, " + std::to_string(done.by_name) +
                     " by name; ways times " + rounded_text(done.scale, 3);
  if (from.rate != to.rate)
    text += "; " + document::shown(from.rate) + " frames a second became " + document::shown(to.rate);
  text += "\n";
  if (!done.left_out.empty())
    text += "not carried, for no joint stands for them: " + document::counted(done.left_out.size(), "joint") + ", " +
            some_of(done.left_out) + "\n";
  if (!done.limited.empty())
    text += "kept back by their limits: " + document::counted(done.limited.size(), "joint") + ", by up to (degrees) " +
            some_of(names_of(done.limited)) + ": to widen them, mars model MODEL set JOINT --limits y LOWER UPPER\n";
  return text;
}

// Keys of the motion become few, within the error.
std::string reduced(document::Json& json, const animator::Film& meaning, const TransferWords& words,
                    const motion::Transferred& done) {
  if (words.error <= 0 || done.keys.size() < 3) return "";
  const document::Document document(document::laid_out(json), meaning.source);
  std::vector<modeler::Model> models = meaning.models;
  const animator::Film now = animator::read_film(document.root(), models);
  const animator::Reduction few =
      animator::reduce_keys(json, now, {false, words.actor, {}}, {done.first, done.last}, {words.error, {}});
  return document::counted(few.keys_before, "key") + " became " + std::to_string(few.keys_after) + "\n";
}

void put_motion(document::Json& json, const std::string& actor, const motion::Transferred& done) {
  animator::clear_keys(json, actor, done.first, wire::kMostFrames, done.keys.front());
  animator::put_keys(json, actor, done.keys);
}

void transfer(EditedFilm& film, const TransferWords& words) {
  const film::FilmFile other = film.read_other(words.from);
  const motion::MotionSource source = source_of(other.film, words);
  std::string report;
  film.change([&](document::Json& json, const animator::Film& meaning) {
    animator::actor_of(json, words.actor);  // refuses what is no actor
    const auto actor = std::ranges::find(meaning.actors, words.actor, &animator::Actor::name);
    const std::uint32_t at = words.at.value_or(animator::last_key(*actor));
    const auto done = motion::transfer_motion(source, meaning, std::size_t(actor - meaning.actors.begin()), at);
    put_motion(json, words.actor, done);
    report = report_of(done, other.film, meaning) + reduced(json, meaning, words, done);
    const std::string length = fit_length(json, done.last, words.lengthen);
    if (length.empty()) return;
    report += length;
    if (!words.lengthen)
      report += ": set its frames to " + std::to_string(done.last + 1) + ", or " +
                film.how_to_lengthen("--at " + std::to_string(at) + " --lengthen");
    report += "\n";
  });
  film.print(report);
}

}  // namespace

void add_transfer(cli::Command animate, EditedFilm& film) {
  const cli::Command command =
      animate.add_command("motion", "Put the motion of another film's actor on an actor, whatever its joints are");
  const auto words = std::make_shared<TransferWords>();
  command.add("ACTOR", words->actor, "The actor that shall move so. Example: anna").required();
  command
      .add("--from", words->from,
           "The film with the motion, as mars import makes one of a motion file: mars import walk.fbx --as film. "
           "Example: --from walk.json")
      .required()
      .type("FILM");
  command.add("--actor", words->other, "Whose motion; default: the only actor with keys. Example: --actor dancer")
      .type("NAME");
  command.add("-f,--frame", words->frame, "Only these frames of that film. Example: --frame 24-48").type("RANGE");
  const auto read_at = [words](const std::string& word) { words->at = animator::read_frame(word); };
  command
      .add_read("--at", read_at,
                "The frame at which the motion begins; default: the actor's last key. Example: --at 24")
      .type("FRAME");
  command
      .add("--error", words->error,
           "How far splines through few keys may deviate; 0: a key at every frame; default: 0.2. "
           "Example: --error 0.5")
      .type("DEGREES")
      .range(0.0, 90.0);
  command.add_flag("--lengthen", words->lengthen, "Make the film long enough for the motion. Example: --lengthen");
  command.runs([&film, words] { transfer(film, *words); });
}

}  // namespace mars::editing
