// Hostfiles, and the lists of tasks that Slurm gives.
#include "host/shell/launch/command.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz {

const Form kForm = Form::text;

void take(std::string_view input) {
  launch::tasks_of_machines(std::string(input));
  options::RenderOptions options;
  options.hostfile = scratch().file("hosts", input);
  launch::default_nodes(options, {});
}

}  // namespace mars::fuzz
