#include "host/editing/film_in_memory.h"

#include <utility>

#include "hal/failure/failure.h"
#include "host/content/animator/film_version.h"
#include "host/content/animator/read_film.h"
#include "host/content/document/file.h"
#include "host/editing/words.h"
#include "host/cli/program.h"

namespace mars::editing {
namespace {

namespace fs = std::filesystem;
using document::Json;

constexpr std::uintmax_t kLargestScript = 1 << 20;

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

FilmInMemory::FilmInMemory(const Json& json, animator::Film& film, fs::path path, fs::path folder)
    : begun_as_(&json), lender_(film), path_(std::move(path)), folder_(std::move(folder)) {}

FilmInMemory::~FilmInMemory() { give_back(); }

void FilmInMemory::give_back() {
  if (edited_ && lends_) lender_.models = std::move(edited_->models);
}

void FilmInMemory::obey(std::span<const Command> commands) {
  for (const Command& command : commands) {
    int code = 0;
    cli::Program mars("mars", "");
    const std::string program = command.empty() ? "" : command.front();
    if (program != "film") add_animate(mars, *this, code);  // the words of both take longer than most commands
    if (program != "animate") add_film(mars, *this);
    mars.read(command);
  }
}

void FilmInMemory::create(const Json&) {
  throw Failure("is open already", path_.string(), "a new film is a file of its own: mars film FILM new");
}

std::string FilmInMemory::read_script(const fs::path& path) const {
  if (const auto given = scripts_.find(path); given != scripts_.end()) return given->second;
  require_below(path);
  return document::read_file(path, kLargestScript);
}

void FilmInMemory::change(const Change& change) {
  Json changed = this->json();
  change(changed, film());
  animator::write_version(changed);
  become(std::move(changed));
}

void FilmInMemory::become(Json json) {
  if (animator::same_models(this->json(), json)) {
    std::vector<modeler::Model>& models = edited_ ? edited_->models : lender_.models;
    edited_ = meaning_of(json, path_, [&](const document::Element& root) { return animator::read_film(root, models); });
  } else {
    animator::Film film = with_other_models(json);
    give_back();
    edited_ = std::move(film);
    lends_ = false;
  }
  json_ = std::move(json);
}

animator::Film FilmInMemory::with_other_models(const Json& json) const {
  const Json& known = this->json().at("models");
  if (const auto models = json.find("models"); models != json.end())
    for (const auto& [name, model] : models->items())
      if (model.is_string() && !(known.contains(name) && known.at(name) == model))
        require_below(path_.parent_path() / model.get<std::string>());
  const auto read = [&](const document::Element& root) { return animator::read_film(root, path_.parent_path()); };
  return meaning_of(json, path_, read);
}

void FilmInMemory::require_below(const fs::path& file) const {
  if (!folder_.empty()) document::path_below(folder_, fs::absolute(file).string());
}

}  // namespace mars::editing
