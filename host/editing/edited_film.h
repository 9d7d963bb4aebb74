// The film that words of a command line change or read: a file, or what is open in the studio. And what they say to the
// person.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "host/content/film/film_json.h"

namespace mars::editing {

class EditedFilm {
 public:
  using Change = std::function<void(document::Json& json, const animator::Film& film)>;

  virtual ~EditedFilm() = default;

  virtual std::filesystem::path path() const = 0;  // beside which its models are; for messages
  virtual film::FilmFile read() const = 0;
  // How the film names the model file that a person names so.
  virtual std::string name_of_model(const std::string& file) const = 0;
  virtual std::string read_script(const std::filesystem::path& path) const = 0;
  virtual void create(const document::Json& json) = 0;  // refuses where there is one already
  // It stays as it was where `change` throws or the result is no film.
  virtual void change(const Change& change) = 0;

  virtual void remark(const std::string& line) = 0;  // what a person should know
  virtual void print(const std::string& text) = 0;   // what was asked for
};

}  // namespace mars::editing
