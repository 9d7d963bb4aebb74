#include "hal/processes/run_processes.h"

#include <cstdio>
#include <exception>
#include <string>

#include "hal/failure/explain.h"
#include "hal/messages/process.h"
#include "hal/processes/job.h"
#include "hal/processes/processes_backend.h"

namespace mars::processes {
namespace {

void print(const std::string& line) {
  std::fprintf(stderr, "mars: %s\n", line.c_str());
  std::fflush(stderr);
}

// One rank from its start to its end.
int run_rank(const Place& place, const std::function<int()>& body) {
  const Segment segment(place.segment);
  Slot& slot = segment.slot(place.index);
  slot.life = Life::joined;
  try {
    ProcessesBackend backend(segment, place.index);
    messages::Process process(backend);
    const int code = body();
    process.finish();
    slot.life = Life::left;
    return code;
  } catch (const std::exception& failure) {
    const std::string reason = reason_of(failure);
    if (!segment.stopped()) print(reason);
    segment.stop(reason);
    slot.life = Life::left;
    return 1;
  }
}

}  // namespace

int run_processes(int nodes, const std::function<int()>& host_body, const std::function<int()>& node_body,
                  std::uint64_t limit) {
  JobPlan plan;
  plan.nodes = nodes;
  plan.host = true;
  plan.limit = limit;
  plan.become = [&](const Place& place, const std::string&) {
    return run_rank(place, place.index == nodes ? host_body : node_body);
  };
  plan.report = print;
  return Job(plan).run();
}

}  // namespace mars::processes
