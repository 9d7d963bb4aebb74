#include "host/programs/node_job.h"

#include <unistd.h>

#include <algorithm>
#include <string>

#include "hal/settings.h"
#include "hal/shared_memory.h"
#include "node/firmware.h"
#include "topology/machine.h"

namespace mars::host {
namespace {

constexpr int kCoresForHost = 1;                          // left to the host where there are more than nodes
constexpr std::uint64_t kMostMemory = std::uint64_t{4} << 30;  // bytes for a frame unless MARS_MEMORY says more
constexpr std::uint64_t kUnknownMemory = std::uint64_t{1} << 30;

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

std::uint64_t memory_share(const topology::Machine& machine, int nodes) {
  const std::uint64_t all = machine.memory() != 0 ? machine.memory() : kUnknownMemory;
  return std::min(kMostMemory, all / 2 / static_cast<std::uint64_t>(nodes));
}

// Binds the calling thread to its share of the machine, unless whoever started it has, or there is none.
void bind(const topology::Machine& machine, const hal::Neighbourhood& here) {
  if (here.placed) return;
  if (const auto place = machine.place(here.index, here.count, kCoresForHost, here.machine)) machine.bind_thread(*place);
}

}  // namespace

void run_node_job() {
  const hal::Settings settings = hal::read_settings();
  const hal::Neighbourhood here = hal::neighbourhood();
  const topology::Machine machine = topology::Machine::here();
  const std::uint64_t memory = settings.memory.value_or(memory_share(machine, here.count));
  bind(machine, here);
  const topology::Binding binding = topology::Machine::binding();
  node::run_node({host_name(), binding.cores, binding.seat, memory, settings.simd});
}

}  // namespace mars::host
