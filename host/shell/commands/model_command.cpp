#include "host/shell/commands/model_command.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <string_view>
#include <utility>

#include "host/editing/words.h"
#include "host/shell/commands/model_on_disk.h"

namespace mars::commands {

void add_model(cli::Command app) {
  const auto model = std::make_shared<ModelOnDisk>();
  const cli::Command words = editing::add_model(app, *model);
  words.add("MODEL", model->name, "The model file, changed in place. Example: dog.json").required();
  words.keeps(model);
}

void put_model_first(std::vector<const char*>& words) {
  const auto is_verb = [](std::string_view word) {
    const std::vector<std::string_view> verbs = editing::model_verbs();
    return std::ranges::find(verbs, word) != verbs.end();
  };
  if (words.size() < 4 || std::string_view(words[1]) != "model" || !is_verb(words[2])) return;
  if (is_verb(words[3]) || words[3][0] == '-') return;
  std::swap(words[2], words[3]);
  std::cerr << "mars: the model comes first now: mars model " << words[2] << ' ' << words[3] << '\n';
}

}  // namespace mars::commands
