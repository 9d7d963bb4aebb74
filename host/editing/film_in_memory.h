// A film that words change in memory while what it began as stays what it is: for steps that may be shown, not written.
// Fast enough for every move of a hand: models that commands leave as they are are lent, neither read nor copied.
#pragma once

#include <map>
#include <optional>
#include <span>

#include "host/editing/command.h"
#include "host/editing/edited_film.h"

namespace mars::editing {

class FilmInMemory final : public EditedFilm {
 public:
  // `film` is what `json`, the film at `path`, means. Both must outlive this; the film has no models as long as they
  // are lent. Files that words name must be below `folder`; "": anywhere.
  FilmInMemory(const document::Json& json, animator::Film& film, std::filesystem::path path,
               std::filesystem::path folder);
  ~FilmInMemory() override;
  FilmInMemory(const FilmInMemory&) = delete;
  FilmInMemory& operator=(const FilmInMemory&) = delete;

  // Read in place of the file, which need not be there.
  void give_script(const std::filesystem::path& path, const std::string& text) { scripts_[path] = text; }
  void obey(std::span<const Command> commands);

  const document::Json& json() const { return edited_ ? json_ : *begun_as_; }
  const animator::Film& film() const { return edited_ ? *edited_ : lender_; }
  const Done& done() const { return done_; }
  bool lends() const { return lends_; }  // no command has changed the models

  std::filesystem::path path() const override { return path_; }
  film::FilmFile read() const override { return {json(), film()}; }
  void create(const document::Json& json) override;
  // Pages name files as the film does.
  std::string name_of_model(const std::string& file) const override { return file; }
  std::string read_script(const std::filesystem::path& path) const override;
  void change(const Change& change) override;
  void remark(const std::string& line) override { done_.remarks.push_back(line); }
  void print(const std::string& text) override { done_.report += text; }

 private:
  void become(document::Json json);
  animator::Film with_other_models(const document::Json& json) const;
  void require_below(const std::filesystem::path& file) const;
  void give_back();

  const document::Json* begun_as_;
  document::Json json_;  // what edited_ means
  animator::Film& lender_;
  std::filesystem::path path_, folder_;
  std::map<std::filesystem::path, std::string> scripts_;
  std::optional<animator::Film> edited_;
  bool lends_ = true;
  Done done_;
};

}  // namespace mars::editing
