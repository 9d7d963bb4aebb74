// A film in memory that words change in place, for as long as they are not kept: what a hand shows, and what is then
// written. Fast enough for every move of a hand: of a film with one changed thing only that is read again, and models
// that words leave as they are are neither read nor copied.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <variant>
#include <vector>

#include "host/content/animator/reading/read_film.h"
#include "host/editing/command.h"
#include "host/editing/edited_film.h"

namespace mars::editing {

class FilmInMemory final : public EditedFilm {
 public:
  // `film` is what `json`, the film at `path`, means; both must outlive this. Files that words name must be below
  // `folder`; "": anywhere.
  FilmInMemory(document::Json& json, animator::Film& film, std::filesystem::path path, std::filesystem::path folder);
  ~FilmInMemory() override { take_back(); }
  FilmInMemory(const FilmInMemory&) = delete;
  FilmInMemory& operator=(const FilmInMemory&) = delete;

  // Read in place of the file, which need not be there.
  void give_script(const std::filesystem::path& path, const std::string& text) { scripts_[path] = text; }
  // Where it throws, what the words before did stays until it is taken back.
  void execute(std::span<const Command> commands);
  // The same for who looks at the film only: its JSON may stay as it was. Not to be kept.
  void show(std::span<const Command> commands);
  void keep();
  void take_back();

  const Done& done() const { return done_; }
  // As it was before words changed more than keys of single things; null: they have not.
  const animator::Film* film_before() const { return before_ ? &before_->film : nullptr; }
  bool models_stay() const { return !before_ || before_->lends_models; }
  bool only_actors_changed() const;
  std::set<std::size_t> changed_actors() const;

  std::filesystem::path path() const override { return path_; }
  film::FilmFile read() const override { return {json_, film_}; }
  void create(const document::Json& json) override;
  // Pages name files as the film does.
  std::string name_of_model(const std::string& file) const override { return file; }
  std::string how_to_lengthen(const std::string&) const override {
    return "undo this, tick \"May lengthen the film\" and apply it again";
  }
  film::FilmFile read_other(const std::string& file) const override;
  std::string read_script(const std::filesystem::path& path) const override;
  void change(const Change& change) override;
  void change_thing(const std::string& thing, const Change& change) override;
  bool show_pose(const std::string& thing, std::span<const std::string> settings, std::uint32_t frame,
                 animator::Beyond beyond) override;
  void remark(const std::string& line) override { done_.remarks.push_back(line); }
  void print(const std::string& text) override { done_.report += text; }

 private:
  struct Whole {
    document::Json json;
    animator::Film film;
    bool lends_models;  // to the film as it is now
  };
  struct Part {
    animator::FilmPart part;
    std::optional<document::Json> json;  // where that changes, too
    std::variant<animator::CameraMotion, std::vector<animator::MaterialMotion>, animator::Actor> motion;
    std::vector<animator::LightMotion> lights;  // which may stand as the camera does
  };

  void execute(const Command& command);
  Part part_as_it_is(animator::FilmPart part, bool with_json) const;
  void put_back(Part& part);
  bool changed_part(animator::FilmPart part, const Change& change);
  animator::Film with_other_models(const document::Json& json) const;
  void require_below(const std::filesystem::path& file) const;

  document::Json& json_;
  animator::Film& film_;
  std::filesystem::path path_, folder_;
  std::map<std::filesystem::path, std::string> scripts_;
  std::vector<Part> parts_;      // as they were, in the order in which they changed
  std::optional<Whole> before_;  // after those
  bool only_shows_ = false;
  Done done_;
};

}  // namespace mars::editing
