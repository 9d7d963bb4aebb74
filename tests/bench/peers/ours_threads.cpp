// bench-ours-threads FILM whole|inbetween|film|latency NODES [FOLDER]
#include <iostream>

#include "hal/failure/explain.h"
#include "hal/threads/run_threads.h"
#include "host/programs/node_job.h"
#include "tests/bench/peers/ours.h"

int main(int argc, char** argv) {
  using namespace mars;
  try {
    if (argc != 4 && argc != 5)
      throw std::runtime_error("usage: bench-ours-threads FILM whole|inbetween|film|latency NODES [FOLDER]");
    const bench::Course course = bench::course_of(argv[2]);
    threads::run_threads(
        std::stoi(argv[3]), [&] { bench::compete(argv[1], course, "threads", argc == 5 ? argv[4] : ""); },
        [] { programs::run_node_job(); });
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "bench-ours-threads: " << reason_of(failure) << '\n';
    return 1;
  }
}
