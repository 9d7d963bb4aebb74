// A model in memory that words change, while what it began as stays what it is.
#pragma once

#include <filesystem>
#include <span>

#include "host/editing/command.h"
#include "host/editing/edited_model.h"

namespace mars::editing {

class ModelInMemory final : public EditedModel {
 public:
  // `model` is what `json`, the model at `path`, means. Files that words name must be below `folder`; "": anywhere.
  ModelInMemory(document::Json json, modeler::Model model, std::filesystem::path path, std::filesystem::path folder)
      : json_(std::move(json)), model_(std::move(model)), path_(std::move(path)), folder_(std::move(folder)) {}

  void execute(std::span<const Command> commands);

  const document::Json& json() const { return json_; }
  const modeler::Model& model() const { return model_; }
  const Done& done() const { return done_; }

  std::filesystem::path path() const override { return path_; }
  modeler::Model read() const override { return model_; }
  void create(const document::Json& json) override;
  void change(const Change& change) override;
  void remark(const std::string& line) override { done_.remarks.push_back(line); }
  void print(const std::string& text) override { done_.report += text; }

 private:
  void become(const document::Json& json);

  document::Json json_;
  modeler::Model model_;
  std::filesystem::path path_, folder_;
  Done done_;
};

}  // namespace mars::editing
