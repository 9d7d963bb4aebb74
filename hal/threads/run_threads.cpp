#include "hal/threads/run_threads.h"

#include <exception>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "hal/failure/explain.h"
#include "hal/messages/process.h"
#include "hal/threads/threads_backend.h"

namespace mars::threads {
namespace {

// One rank from its start to its end.
void run_rank(ThreadsWorld& world, int rank, const std::function<void()>& body, const WrapBackend& wrap) try {
  ThreadsBackend& backend = world.rank(rank);
  const std::unique_ptr<messages::Backend> wrapped = wrap ? wrap(backend) : nullptr;
  messages::Process process(wrapped ? *wrapped : backend);
  body();
  process.finish();
} catch (...) {
  world.stop(std::current_exception());
}

// Where the machine gives no more threads those started already are stopped: they would wait for ever.
void start_nodes(ThreadsWorld& world, std::vector<std::jthread>& threads, const std::function<void()>& body,
                 const WrapBackend& wrap) try {
  for (int node = 0; node < world.nodes(); ++node) {
    threads.emplace_back([&, node] { run_rank(world, node, body, wrap); });
  }
} catch (const std::system_error&) {
  const Failure failure =
      no_more_threads("the machine gives threads to no more than " + std::to_string(threads.size()) + " of " +
                      std::to_string(world.nodes()) + " nodes");
  world.stop(std::make_exception_ptr(failure));
}

}  // namespace

void run_threads(int nodes, const std::function<void()>& host_body, const std::function<void()>& node_body,
                 const WrapBackend& wrap) {
  ThreadsWorld world(nodes);
  {
    std::vector<std::jthread> threads;
    threads.reserve(nodes);
    start_nodes(world, threads, node_body, wrap);
    run_rank(world, nodes, host_body, wrap);
  }
  if (const std::exception_ptr failure = world.failure()) std::rethrow_exception(failure);
}

}  // namespace mars::threads
