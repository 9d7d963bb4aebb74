// The model file that a command line names, for the words that change it.
#pragma once

#include <iostream>
#include <string>

#include "host/content/modeler/model_file.h"
#include "host/editing/edited_model.h"

namespace mars::commands {

class ModelOnDisk : public editing::EditedModel {
 public:
  std::string name;  // as it was typed

  std::filesystem::path path() const override { return name; }
  modeler::Model read() const override { return modeler::load_own_model(name); }
  void create(const document::Json& json) override { modeler::create_model(name, json); }
  void change(const Change& change) override { modeler::change_model(name, change); }
  void remark(const std::string& line) override { std::cerr << "mars: " << line << '\n'; }
  void print(const std::string& text) override { std::cout << text; }
};

}  // namespace mars::commands
