#include "hal/threads/run_threads.h"

#include <thread>
#include <vector>

#include "hal/process.h"
#include "hal/threads/threads_backend.h"

namespace mars::hal {
namespace {

// One rank's whole life.
void run_rank(ThreadsWorld& world, int rank, const std::function<void()>& body, const WrapBackend& wrap) try {
  ThreadsBackend& backend = world.rank(rank);
  const std::unique_ptr<Backend> wrapped = wrap ? wrap(backend) : nullptr;
  Process process(wrapped ? *wrapped : backend);
  body();
  process.finish();
} catch (...) {
  world.stop(std::current_exception());
}

}  // namespace

void run_threads(int nodes, const std::function<void()>& host_body, const std::function<void()>& node_body,
                 const WrapBackend& wrap) {
  ThreadsWorld world(nodes);
  {
    std::vector<std::jthread> threads;
    threads.reserve(nodes);
    for (int node = 0; node < nodes; ++node) {
      threads.emplace_back([&, node] { run_rank(world, node, node_body, wrap); });
    }
    run_rank(world, nodes, host_body, wrap);
  }
  if (const std::exception_ptr failure = world.failure()) std::rethrow_exception(failure);
}

}  // namespace mars::hal
