#include "tests/bench/tables/machine1992/job.h"

#include "hal/nx/nx_messages.h"
#include "tests/bench/tables/machine1992/node.h"

namespace mars::machine1992 {

Records run_job(const Task& task, int nodes, const Run& run, const Host::Show& show) {
  Records records;
  records.nodes.resize(static_cast<std::size_t>(nodes));
  const auto host = [&] {
    Host screen(task.film, show);
    screen.show_interval(task.interval, task.inbetweens);
    records.host = screen.work();
  };
  const auto node = [&] {
    Node drawer(task.film);
    drawer.draw_interval(task.interval, task.inbetweens);
    records.nodes[static_cast<std::size_t>(mynode())] = drawer.records();
  };
  run(nodes, host, node);
  return records;
}

}  // namespace mars::machine1992
