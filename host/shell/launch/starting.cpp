#include "host/shell/launch/starting.h"

#include "host/child/environment.h"
#include "host/shell/launch/asked_machines.h"

namespace mars::launch {

Starting prepare(options::RenderOptions& options, const std::filesystem::path& self) {
  const child::Environment environment = child::own_environment();
  const std::string path = child::program_path(environment);
  Starting starting{find_programs(self, path), {}, path};
  options.backend = choose_backend(options, starting.programs, environment);
  starting.surroundings = look_around(path);
  if (options.nodes == 0) options.nodes = default_nodes(options, starting.surroundings);
  options::check_nodes(options, cores_in_use(options, starting.surroundings));
  return starting;
}

child::Command command_for(const options::RenderOptions& options, const Starting& starting,
                           const std::vector<Slots>& machines) {
  Surroundings surroundings = starting.surroundings;
  surroundings.machines = machines;
  if (options.backend == options::Backend::threads) return threads_command(options, starting.programs);
  if (options.backend == options::Backend::simulated) return simulated_command(options, starting.programs);
  return mpi_command(options, starting.programs, surroundings);
}

std::vector<Slots> machines_of(const options::RenderOptions& options, const Starting& starting) {
  if (options.backend != options::Backend::mpi) return {};
  const child::Environment& environment = starting.surroundings.environment;
  const std::vector<Slots> named = named_machines(options.hostfile, environment);
  return !named.empty() || !options.hostfile.empty() ? named : slurm_machines(environment, starting.path);
}

Question question_of(const options::RenderOptions& options, const Starting& starting) {
  if (starting.surroundings.tasks != 0) return Question::slurm;
  if (options.backend != options::Backend::mpi) return Question::nobody;
  const bool named = !named_machines(options.hostfile, starting.surroundings.environment).empty();
  return named ? Question::ssh : Question::nobody;
}

}  // namespace mars::launch
