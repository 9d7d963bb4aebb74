#include "host/programs/node_job.h"

#include <unistd.h>

#include <algorithm>
#include <memory>
#include <string>

#include "hal/failure/failure.h"
#include "hal/failure/process_limit.h"
#include "hal/messages/settings.h"
#include "hal/messages/shared_memory.h"
#include "hal/nx/nx_messages.h"
#include "host/render/composer/node_writer.h"
#include "node/firmware.h"
#include "topology/debugger.h"
#include "topology/machine.h"
#include "topology/memory_limit.h"

namespace mars::programs {
namespace {

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

// Binds the calling thread to its share of the machine, unless its launcher has, or there is none.
void bind(const topology::Machine& machine, const messages::Neighbourhood& here) {
  if (here.placed) return;
  if (const auto place = machine.place(here.index, here.count, kCoresForHost, here.machine))
    machine.bind_thread(*place);
}

}  // namespace

void check_memory_limit(std::uint32_t nodes) {
  // Measured with films of examples/: 512, 600 and 800 MB do for 1, 2 and 4 nodes, 470 for 1 in four starts of five.
  // The C library sets 64 MiB aside for each thread, of nodes and sinks, until 16 or more share.
  constexpr std::uint64_t kMiB = std::uint64_t{1} << 20, kHost = 384 * kMiB, kNode = 128 * kMiB;
  constexpr std::uint32_t kMost = 16;
  const std::uint64_t limit = process_limit().addresses;
  const std::uint64_t least = kHost + kNode * std::min(nodes, kMost);
  if (limit == 0 || limit >= least) return;
  throw Failure("the limit of " + std::to_string(limit >> 10) + " kB of addresses is too small for " +
                    std::to_string(nodes) + (nodes == 1 ? " node" : " nodes"),
                "ulimit -v", "raise it to " + std::to_string(least >> 10) + " or more, or use fewer nodes");
}

void run_node_job(std::uint32_t threads) {
  const messages::Settings settings = messages::read_settings();
  const messages::Neighbourhood here = messages::machine_neighbourhood();
  const topology::Machine machine = topology::Machine::here();
  const std::uint64_t memory = settings.memory.value_or(
      topology::memory_share(machine.memory(), topology::memory_limit(), here.count, static_cast<int>(threads)));
  bind(machine, here);
  const topology::Binding binding = topology::Machine::binding();
  const auto is_traced = [](std::int32_t process) { return topology::is_traced(process); };
  const auto make_writer = [](const wire::PackedFilm& film, std::span<const std::byte> orders) {
    const bool leads = messages::neighbourhood().index == 0;
    return std::make_unique<composer::NodeWriter>(film, sinks::read_orders(orders), static_cast<std::int32_t>(mynode()),
                                                  leads);
  };
  node::run_node({host_name(), binding.cores, binding.seat, memory, settings.simd, getpid(), is_traced, make_writer});
}

}  // namespace mars::programs
