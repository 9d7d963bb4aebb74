#include "host/editing/film_in_memory.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/animator/reading/film_version.h"
#include "host/content/animator/keys/pose.h"
#include "host/content/animator/reading/read_film.h"
#include "host/content/animator/reading/rig.h"
#include "host/content/document/file.h"
#include "host/editing/new_files.h"
#include "host/editing/words.h"
#include "host/cli/program.h"

namespace mars::editing {
namespace {

namespace fs = std::filesystem;
using document::Json;

constexpr std::uintmax_t kLargestScript = 1 << 20;
constexpr std::chrono::seconds kLongestStep{10};

// Reads the film from a text that is quickly made; where it is wrong, from one whose lines are the file's.
template <typename Read>
animator::Film meaning_of(const Json& json, const fs::path& path, Read read) {
  try {
    const document::Document document(json.dump(), path.string());
    return read(document.root());
  } catch (const Failure&) {
  } catch (const Json::type_error&) {  // words that are not UTF-8, which laid_out() refuses
  }
  const document::Document document(document::laid_out(json), path.string());
  return read(document.root());
}

}  // namespace

FilmInMemory::FilmInMemory(Json& json, animator::Film& film, fs::path path, fs::path folder)
    : json_(json), film_(film), path_(std::move(path)), folder_(std::move(folder)) {}

// Each command has a bound of its own; many must not keep others waiting for their sum.
void FilmInMemory::execute(std::span<const Command> commands) {
  const auto begun = std::chrono::steady_clock::now();
  for (const Command& command : commands) {
    if (std::chrono::steady_clock::now() - begun > kLongestStep)
      throw Failure("take longer together than one step may", "these commands", "give them in several steps");
    execute(command);
  }
}

// Of the many words only those that it may need are made, which takes longer than to execute most of them.
void FilmInMemory::execute(const Command& command) {
  int code = 0;
  cli::Program mars("mars", "");
  const std::string program = command.empty() ? "" : command[0], verb = command.size() < 2 ? "" : command[1];
  if (program == "animate" && verb == "pose")
    add_animate_pose(mars, *this);
  else if (program != "film")
    add_animate(mars, *this, code);
  if (program != "animate") add_film(mars, *this);
  mars.read(command);
}

void FilmInMemory::show(std::span<const Command> commands) {
  only_shows_ = commands.size() == 1;  // others need the JSON that it leaves
  execute(commands);
}

void FilmInMemory::keep() {
  before_.reset();
  parts_.clear();
}

void FilmInMemory::take_back() {
  if (before_) {
    if (before_->lends_models) before_->film.models = std::move(film_.models);
    film_ = std::move(before_->film);
    json_ = std::move(before_->json);
    before_.reset();
  }
  for (auto part = parts_.rbegin(); part != parts_.rend(); ++part) put_back(*part);
  parts_.clear();
}

bool FilmInMemory::only_actors_changed() const {
  return !before_ && std::ranges::all_of(
                         parts_, [](const Part& part) { return part.part.kind == animator::FilmPart::Kind::actor; });
}

// Where words change which actors there are, all.
std::set<std::size_t> FilmInMemory::changed_actors() const {
  std::set<std::size_t> changed;
  for (const Part& part : parts_)
    if (part.part.kind == animator::FilmPart::Kind::actor) changed.insert(part.part.actor);
  if (!before_) return changed;
  const Json &was = before_->json.at("actors"), &now = json_.at("actors");
  for (std::size_t actor = 0; actor < now.size(); ++actor)
    if (now.size() != was.size() || now[actor] != was[actor]) changed.insert(actor);
  return changed;
}

void FilmInMemory::create(const Json&) {
  throw Failure("is open already", path_.string(), "a new film is a file of its own: mars film FILM new");
}

film::FilmFile FilmInMemory::read_other(const std::string& file) const {
  const fs::path path = path_.parent_path() / file;
  require_below(path);
  return film::open_film(path);
}

std::string FilmInMemory::read_script(const fs::path& path) const {
  if (const auto given = scripts_.find(path); given != scripts_.end()) return given->second;
  require_below(path);
  return document::read_file(path, kLargestScript);
}

void FilmInMemory::change(const Change& change) {
  Json changed = json_;
  change(changed, film_);
  animator::write_version(changed);
  require_new_files_below(folder_, path_, keys::object("film"), json_, changed);
  const bool models_stay = animator::same_models(json_, changed);
  const auto with_these_models = [&](const document::Element& root) {
    animator::require_new_sound(root, film_);
    return animator::read_film(root, film_.models);
  };
  animator::Film film = models_stay ? meaning_of(changed, path_, with_these_models) : with_other_models(changed);
  if (!before_) {
    before_ = Whole{std::move(json_), std::move(film_), models_stay};
  } else if (!models_stay && before_->lends_models) {
    before_->film.models = std::move(film_.models);
    before_->lends_models = false;
  }
  json_ = std::move(changed);
  film_ = std::move(film);
}

void FilmInMemory::change_thing(const std::string& thing, const Change& change) {
  const auto part = animator::part_of(film_, thing);
  // All is read again where that says more about what is wrong, and at which line.
  if (!part || !json_.contains(animator::pointer_to(*part)) || !changed_part(*part, change)) this->change(change);
}

bool FilmInMemory::changed_part(animator::FilmPart part, const Change& change) {
  Part was = part_as_it_is(part, true);
  try {
    change(json_, film_);
    if (animator::needs_newer_version(json_)) throw Failure("needs a newer version", "", "");
    if (part.kind == animator::FilmPart::Kind::materials)
      require_new_files_below(folder_, path_, keys::object("film"), Json{{"materials", *was.json}},
                              Json{{"materials", json_.at(animator::pointer_to(part))}});
    animator::read_again(part, json_, film_);
  } catch (const std::exception&) {
    put_back(was);
    return false;
  }
  if (!before_) parts_.push_back(std::move(was));
  return true;
}

bool FilmInMemory::show_pose(const std::string& thing, std::span<const std::string> settings, std::uint32_t frame,
                             animator::Beyond beyond) {
  const auto part = animator::part_of(film_, thing);
  if (!only_shows_ || !part) return false;
  Part was = part_as_it_is(*part, false);
  if (!animator::show_pose(film_, json_, thing, settings, frame, beyond, done_.remarks)) return false;
  if (!json_.contains("lights")) film_.lights = animator::rig_lights(film_);
  if (!before_) parts_.push_back(std::move(was));
  return true;
}

FilmInMemory::Part FilmInMemory::part_as_it_is(animator::FilmPart part, bool with_json) const {
  Part as_it_is{part, {}, {}, film_.lights};
  if (with_json) as_it_is.json = json_.at(animator::pointer_to(part));
  if (part.kind == animator::FilmPart::Kind::camera) as_it_is.motion = film_.camera;
  if (part.kind == animator::FilmPart::Kind::materials) as_it_is.motion = film_.materials;
  if (part.kind == animator::FilmPart::Kind::actor) as_it_is.motion = film_.actors[part.actor];
  return as_it_is;
}

void FilmInMemory::put_back(Part& part) {
  if (part.json) json_.at(animator::pointer_to(part.part)) = std::move(*part.json);
  film_.lights = std::move(part.lights);
  using Kind = animator::FilmPart::Kind;
  if (part.part.kind == Kind::camera) film_.camera = std::get<animator::CameraMotion>(std::move(part.motion));
  if (part.part.kind == Kind::materials)
    film_.materials = std::get<std::vector<animator::MaterialMotion>>(std::move(part.motion));
  if (part.part.kind == Kind::actor) film_.actors[part.part.actor] = std::get<animator::Actor>(std::move(part.motion));
}

animator::Film FilmInMemory::with_other_models(const Json& json) const {
  const auto read = [&](const document::Element& root) {
    animator::require_new_sound(root, film_);
    return animator::read_film(root, path_.parent_path());
  };
  return meaning_of(json, path_, read);
}

void FilmInMemory::require_below(const fs::path& file) const {
  if (!folder_.empty()) document::path_below(folder_, fs::absolute(file).string());
}

}  // namespace mars::editing
