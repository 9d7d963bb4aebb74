// Hostfiles, and the lists of tasks that Slurm gives.
#include "host/shell/launch/command.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::hostfile {

void take(std::string_view input) {
  launch::tasks_of_machines(std::string(input));
  options::RenderOptions options;
  options.hostfile = scratch().file("hosts", input);
  launch::default_nodes(options, {});
}

const Target target("hostfile", Form::text, take);

}  // namespace mars::fuzz::hostfile
