// machine1992 FILM NODES INBETWEENS: what the 1992 program does on each node for the first interval's keyframe and so
// many inbetweens, as JSON.
#include <iostream>
#include <nlohmann/json.hpp>

#include "hal/failure/explain.h"
#include "hal/threads/run_threads.h"
#include "host/content/film/compile.h"
#include "tests/bench/tables/machine1992/job.h"

namespace {

using namespace mars;
using namespace mars::machine1992;

nlohmann::json json_of(const WorkCounts& work) {
  nlohmann::json json = nlohmann::json::object();
  for (std::size_t k = 0; k < kWorks; ++k)
    if (const std::uint64_t units = work[static_cast<Work>(k)]; units > 0) json[kWorkNames[k]] = units;
  return json;
}

nlohmann::json json_of(const NodeRecord& record) {
  const auto& moving = record.moving;
  return {
      {"frame", record.frame},
      {"keyframe", record.keyframe},
      {"lists", json_of(record.lists)},
      {"sent", record.sent},
      {"lines", json_of(record.lines)},
      {"strips", record.strips},
      {"depths", record.depths},
      {"moving", {{"whole", moving.whole}, {"lines", moving.lines}, {"box", moving.box}, {"pixels", moving.pixels}}}};
}

nlohmann::json json_of(const Records& records) {
  nlohmann::json json = {{"nodes", nlohmann::json::array()}, {"host", nlohmann::json::array()}};
  for (const auto& node : records.nodes) {
    json["nodes"].push_back(nlohmann::json::array());
    for (const NodeRecord& record : node) json["nodes"].back().push_back(json_of(record));
  }
  for (const WorkCounts& work : records.host) json["host"].push_back(json_of(work));
  return json;
}

void run_threads(int nodes, const std::function<void()>& host, const std::function<void()>& node) {
  threads::run_threads(nodes, host, node);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 4) throw std::runtime_error("usage: machine1992 FILM NODES INBETWEENS");
    const film::CompiledFilm film = film::load_film(argv[1]);
    const Task task{film.view(), 0, static_cast<std::uint32_t>(std::stoul(argv[3]))};
    std::cout << json_of(run_job(task, std::stoi(argv[2]), run_threads, [](auto, const auto&) {})) << '\n';
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "machine1992: " << reason_of(failure) << '\n';
    return 1;
  }
}
