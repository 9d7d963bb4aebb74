// Runs a host and its nodes as processes that this one forks: the start of the processes backend for programs
// that hold both. (C programs with a main function each are started by `mars-nx run`.)
#pragma once

#include <cstdint>
#include <functional>

namespace mars::processes {

// Runs `host_body` and on each of `nodes` nodes `node_body`, each in a process of its own in which NX calls
// work, and returns the worst exit code that they return. If one throws or dies, the reason is printed on
// standard error and all end. The caller has no other child processes. Messages under way take at most
// `limit` bytes.
int run_processes(int nodes, const std::function<int()>& host_body, const std::function<int()>& node_body,
                  std::uint64_t limit = std::uint64_t{1} << 32);

}  // namespace mars::processes
