#include "host/editing/edit_film.h"

#include <CLI/CLI.hpp>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/animator/film_version.h"
#include "host/content/animator/read_film.h"
#include "host/content/document/shell_word.h"
#include "host/editing/words.h"
#include "host/shell/options/command_line.h"

namespace mars::editing {
namespace {

class FilmInMemory : public EditedFilm {
 public:
  FilmInMemory(document::Json& json, const std::filesystem::path& path) : json_(json), path_(path) {}

  std::filesystem::path path() const override { return path_; }
  film::FilmFile read() const override { return {json_, meaning_of(json_)}; }

  void create(const document::Json&) override {
    throw Failure("is open already", path_.string(), "a new film is a file of its own: mars film FILM new");
  }

  void change(const Change& change) override {
    document::Json changed = json_;
    change(changed, meaning_of(json_));
    animator::write_version(changed);
    meaning_of(changed);
    json_ = std::move(changed);
  }

  void remark(const std::string& line) override { done.remarks.push_back(line); }
  void print(const std::string& text) override { done.report += text; }

  Done done;

 private:
  animator::Film meaning_of(const document::Json& json) const {
    const document::Document document(document::laid_out(json), path_.string());
    return animator::read_film(document.root(), path_.parent_path());
  }

  document::Json& json_;
  std::filesystem::path path_;
};

void obey(FilmInMemory& film, const Command& command) {
  int code = 0;
  CLI::App mars("", "mars");
  add_animate(mars, film, code);
  add_film(mars, film);
  options::read_words(mars, command);
}

}  // namespace

Done edit_film(document::Json& film, const std::filesystem::path& path, std::span<const Command> commands) {
  document::Json edited = film;
  FilmInMemory memory(edited, path);
  for (const Command& command : commands) obey(memory, command);
  film = std::move(edited);
  return std::move(memory.done);
}

}  // namespace mars::editing
