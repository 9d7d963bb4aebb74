#include "host/editing/model_in_memory.h"

#include <utility>

#include "hal/failure/failure.h"
#include "host/cli/program.h"
#include "host/content/modeler/model_file.h"
#include "host/editing/new_files.h"
#include "host/editing/words.h"

namespace mars::editing {

void ModelInMemory::execute(std::span<const Command> commands) {
  for (const Command& command : commands) {
    cli::Program mars("mars", "");
    add_model(mars, *this);
    mars.read(command);
  }
}

void ModelInMemory::create(const document::Json&) {
  throw Failure("is open already", path_.string(), "--replace begins again in its place");
}

void ModelInMemory::become(const document::Json& json) {
  require_new_files_below(folder_, path_, keys::object("model"), json_, json);
  const document::Document document(document::laid_out(json), path_.string());
  model_ = modeler::read_own_model(document.root());
  json_ = json;
}

void ModelInMemory::change(const Change& change) {
  document::Json changed = json_;
  change(changed, model_);
  become(changed);
}

}  // namespace mars::editing
