// The 1992 program on the first interval of a film, each number of nodes in turn, results as JSON:
//   machine1992 count FILM NODES,... SCALE,... INBETWEENS   what each rank does (record.h)
//   machine1992 time FILM NODES,... SCALE,... PLATFORM COSTS   simulated seconds of a keyframe, and of it with as many
//                                                              inbetweens as nodes
// SCALE: how much larger the figures are in the picture. COSTS: a file {"work": {"vertex": seconds, ...}, "host_byte":
// seconds, "host_message": seconds}; the rest is the platform's.
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "hal/failure/explain.h"
#include "hal/simulated/run_simulated.h"
#include "hal/threads/run_threads.h"
#include "host/content/film/compile.h"
#include "host/experiments/platform.h"
#include "tests/bench/tables/machine1992/job.h"
#include "tests/bench/tables/machine1992/scaled_film.h"

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

void show_nothing(std::uint32_t, const std::vector<std::uint32_t>&) {}

void run_threads(int nodes, const std::function<void()>& host, const std::function<void()>& node) {
  threads::run_threads(nodes, host, node);
}

simulated::Machine machine_of(const char* platform, const char* costs_file) {
  simulated::Machine machine = experiments::read_platform(platform, "").machine;
  std::ifstream file(costs_file);
  const nlohmann::json costs = nlohmann::json::parse(file);
  machine.work.clear();
  for (const char* name : kWorkNames) machine.work.push_back(costs.at("work").at(name).get<double>());
  machine.network.host_byte = costs.at("host_byte").get<double>();
  machine.network.host_end = {{0, 0}, {1, costs.at("host_message").get<double>()}};
  return machine;
}

double seconds_of(const Task& task, int nodes, const simulated::Machine& machine) {
  double seconds = 0;
  const Run run = [&](int count, const auto& host, const auto& node) {
    seconds = simulated::run_simulated(
        machine, count, [&](simulated::World&) { host(); }, node);
  };
  run_job(task, nodes, run, show_nothing);
  return seconds;
}

std::vector<double> numbers(const char* list) {
  std::vector<double> found;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) found.push_back(std::stod(word));
  return found;
}

// `of`: of a film in some scale, and nodes.
template <typename Of>
nlohmann::json each(const char* film_file, const char* nodes, const char* scales, const Of& of) {
  const film::CompiledFilm film = film::load_film(film_file);
  nlohmann::json found = nlohmann::json::array();
  for (const double scale : numbers(scales)) {
    const ScaledFilm scaled(film.block(), scale);
    for (const double count : numbers(nodes)) {
      nlohmann::json one = of(scaled.view(), static_cast<int>(count));
      one["scale"] = scale;
      one["count"] = count;
      found.push_back(std::move(one));
    }
  }
  return found;
}

nlohmann::json count(char** words) {
  const auto inbetweens = static_cast<std::uint32_t>(std::stoul(words[3]));
  return each(words[0], words[1], words[2], [&](const wire::PackedFilm& film, int nodes) {
    return json_of(run_job({film, 0, inbetweens}, nodes, run_threads, show_nothing));
  });
}

nlohmann::json time(char** words) {
  const simulated::Machine machine = machine_of(words[3], words[4]);
  return each(words[0], words[1], words[2], [&](const wire::PackedFilm& film, int nodes) -> nlohmann::json {
    return {{"keyframe", seconds_of({film, 0, 0}, nodes, machine)},
            {"interval", seconds_of({film, 0, static_cast<std::uint32_t>(nodes)}, nodes, machine)}};
  });
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string what = argc > 1 ? argv[1] : "";
    if (what == "count" && argc == 6)
      std::cout << count(argv + 2) << '\n';
    else if (what == "time" && argc == 7)
      std::cout << time(argv + 2) << '\n';
    else
      throw std::runtime_error("usage: machine1992 count|time FILM NODES SCALES ...");
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "machine1992: " << reason_of(failure) << '\n';
    return 1;
  }
}
