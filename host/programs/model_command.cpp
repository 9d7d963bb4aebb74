#include "host/programs/model_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "host/modeler/describe.h"
#include "host/modeler/model_file.h"

namespace mars::host {
namespace {

// One of the commands, whose words are kept while the command line is read and then carried out.
template <typename Words>
std::shared_ptr<Words> words_of(CLI::App* command, void (*carry_out)(const Words&)) {
  auto words = std::make_shared<Words>();
  command->callback([words, carry_out] { carry_out(*words); });
  return words;
}

struct OfFile {
  std::string file;
};

void add_file(CLI::App* command, OfFile& words) {
  command->add_option("MODEL", words.file, "The model file. Example: dog.json")->required();
}

void carry_out_new(const OfFile& words) {
  create_model(words.file, {{"joints", {{{"name", "body"}}}}});
}

void carry_out_show(const OfFile& words) { std::cout << describe_model(load_own_model(words.file)); }

void carry_out_check(const OfFile& words) {
  load_own_model(words.file);
  std::cout << words.file << ": a model\n";
}

}  // namespace

void add_model(CLI::App& app) {
  CLI::App* model = app.add_subcommand("model", "Make a model, or change it step by step");
  CLI::App* made = model->add_subcommand("new", "Make a model of one joint");
  add_file(made, *words_of(made, carry_out_new));
  CLI::App* show = model->add_subcommand("show", "Show a model's joints, how they turn, and its segments");
  add_file(show, *words_of(show, carry_out_show));
  CLI::App* checked = model->add_subcommand("check", "Tell whether a model is right, and what is probably meant otherwise");
  add_file(checked, *words_of(checked, carry_out_check));
}

}  // namespace mars::host
