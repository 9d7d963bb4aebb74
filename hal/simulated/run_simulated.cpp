#include "hal/simulated/run_simulated.h"

#include <algorithm>
#include <exception>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/messages/process.h"
#include "hal/simulated/simulated_backend.h"

namespace mars::simulated {
namespace {

// One rank from its start to its end.
void run_rank(World& world, int rank, const std::function<void()>& body) {
  try {
    world.check_running();
    SimulatedBackend backend(world, rank);
    messages::Process process(backend);
    body();
    process.finish();
  } catch (...) {
    world.stop(std::current_exception());
  }
  world.end(rank);
}

void run_node(World& world, int node, const std::function<void()>& body) {
  world.await_first_turn(node);
  run_rank(world, node, body);
}

// Where the machine gives no more threads those started already are stopped: they would wait for ever.
void start_nodes(World& world, std::vector<std::jthread>& threads, const std::function<void()>& body) try {
  for (int node = 0; node < world.nodes(); ++node) threads.emplace_back([&, node] { run_node(world, node, body); });
} catch (const std::system_error&) {
  const auto started = static_cast<int>(threads.size());
  for (int node = started; node < world.nodes(); ++node) world.leave_out(node);
  world.stop(
      std::make_exception_ptr(no_more_threads("the machine gives threads to no more than " + std::to_string(started) +
                                              " of " + std::to_string(world.nodes()) + " nodes")));
}

}  // namespace

double run_simulated(const Machine& machine, int nodes, const std::function<void(World&)>& host_body,
                     const std::function<void()>& node_body) {
  World world(machine, nodes);
  {
    std::vector<std::jthread> threads;
    threads.reserve(static_cast<std::size_t>(nodes));
    start_nodes(world, threads, node_body);
    run_rank(world, nodes, [&] { host_body(world); });
  }
  if (const std::exception_ptr failure = world.failure()) std::rethrow_exception(failure);
  double end = 0;
  for (int rank = 0; rank <= nodes; ++rank) end = std::max(end, world.clock(rank));
  return end;
}

}  // namespace mars::simulated
