// The film file that a command line names, for the words that change it.
#pragma once

#include <iostream>
#include <string>

#include "host/content/document/file.h"
#include "host/editing/edited_film.h"

namespace mars::commands {

class FilmOnDisk : public editing::EditedFilm {
 public:
  std::string name;  // as it was typed

  std::filesystem::path path() const override { return name; }
  film::FilmFile read() const override { return film::open_film(name); }
  std::string name_of_model(const std::string& file) const override { return film::name_beside(name, file); }
  film::FilmFile read_other(const std::string& file) const override { return film::open_film(file); }
  std::string read_script(const std::filesystem::path& path) const override { return document::read_file(path); }
  void create(const document::Json& json) override { film::create_film(name, json); }
  void change(const Change& change) override { film::change_film(name, change); }
  void remark(const std::string& line) override { std::cerr << "mars: " << line << '\n'; }
  void print(const std::string& text) override { std::cout << text; }
};

}  // namespace mars::commands
