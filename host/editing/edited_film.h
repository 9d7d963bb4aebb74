// The film that words change or read.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "host/content/animator/pose/within_limits.h"
#include "host/content/film/film_json.h"
#include "host/editing/edited.h"

namespace mars::editing {

class EditedFilm : public Edited {
 public:
  using Change = std::function<void(document::Json& json, const animator::Film& film)>;

  virtual film::FilmFile read() const = 0;
  // How the film names the model file that a person names so.
  virtual std::string name_of_model(const std::string& file) const = 0;
  // How a person lengthens a film that is too short for what was just done; `words`: of the command line.
  virtual std::string how_to_lengthen(const std::string& words) const { return "repeat this with " + words; }
  // Another film, which a person names as model files. Throws Failure where it is no film.
  virtual film::FilmFile read_other(const std::string& file) const = 0;
  virtual std::string read_script(const std::filesystem::path& path) const = 0;
  // It stays as it was where `change` throws or the result is no film.
  virtual void change(const Change& change) = 0;
  // The same of one thing (animator/things.h) whose keys alone `change` changes. It may be called twice.
  virtual void change_thing(const std::string& /*thing*/, const Change& change) { this->change(change); }
  // Shows keys of a thing (animator/pose.h) where that is all that is wanted; false: change it.
  virtual bool show_pose(const std::string& /*thing*/, std::span<const std::string> /*settings*/,
                         std::uint32_t /*frame*/, animator::Beyond /*beyond*/) {
    return false;
  }
};

}  // namespace mars::editing
