// The messages of a rendering, counted: bench-traffic FILM NODES NODES-A-MACHINE all|whole. The nodes are threads of
// this process, one group, as if they lay on machines of NODES-A-MACHINE nodes each. `whole` draws every frame from
// scratch. Printed: for each sender, receiver and kind of message a line of messages, those without a byte, and bytes.
// The host's number is the number of nodes.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <numeric>
#include <string>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "hal/threads/run_threads.h"
#include "host/content/film/compile.h"
#include "host/render/farm/farm.h"
#include "host/render/trace/trace_file.h"
#include "node/firmware.h"
#include "node/shadow/shadow_plan.h"
#include "node/wire/still_plan.h"
#include "tests/hal/machines_backend.h"

namespace mars::bench {
namespace {

// Bytes of all nodes together for a frame's triangles and edge boxes, and of each at least; more where inbetweens are
// drawn, each by one node: enough for one pass.
constexpr std::uint64_t kMemory = std::uint64_t{1} << 30;
constexpr std::uint64_t kLeastOfKeyframes = std::uint64_t{4} << 20, kLeastMemory = std::uint64_t{64} << 20;

struct Course {
  std::string film;
  int nodes;
  int nodes_each;  // on a machine
  bool whole;
};

// Of a film with shadows: these take little, and all still lines are kept, on top of kMemory.
farm::AskedMemory asked_memory(const wire::PackedFilm& film) {
  const wire::FilmSettings& settings = film.settings();
  if (film.casting_count() == 0) return {};
  constexpr std::uint64_t kAll = std::uint64_t{1} << 40;
  const auto still =
      wire::plan_still_lines(settings.width, settings.height, settings.samples, kAll, film.casting_count());
  return {still.bytes(), shadow::least_shadow_bytes(shadow::shadow_needs(film))};
}

farm::FarmReport render(const film::CompiledFilm& film, const Course& course) {
  const wire::FilmSettings& settings = film.view().settings();
  farm::PlanRequest work;
  work.frames.resize(settings.frames);
  std::iota(work.frames.begin(), work.frames.end(), 0u);
  work.coherence = !course.whole;
  work.groups = 1;
  farm::FarmOptions options;
  options.each_frame = true;
  options.asked_memory = asked_memory(film.view());
  sinks::NullSink sink;
  sinks::SinkPool pool(sink, {settings.width, settings.height, 16, 3, 1});
  return farm::render_film(film.block(), farm::make_plan(film.view(), work, course.nodes), options, pool, {});
}

void count_messages(const Course& course, messages::Counts& counts) {
  const film::CompiledFilm film = film::load_film(course.film);
  messages::Machines machines(course.nodes_each);
  const farm::AskedMemory more = asked_memory(film.view());
  const std::uint64_t each = kMemory / static_cast<std::uint64_t>(course.nodes);
  const std::uint64_t memory = std::max(each, course.whole ? kLeastOfKeyframes : kLeastMemory) +
                               more.still.value_or(0) + more.shadows.value_or(0);
  farm::FarmReport report;
  threads::run_threads(
      course.nodes, [&] { report = render(film, course); },
      [&] {
        node::run_node({"", "", {}, memory, ""});
      },
      [&](messages::Backend& inner) { return std::make_unique<messages::MachinesBackend>(inner, counts, machines); });
  if (std::ranges::any_of(report.strips, [](const wire::Strip& strip) { return strip.work.passes > 1; }))
    throw Failure("a frame took several passes", course.film, "measure it on more nodes or with fewer triangles");
}

void print(const messages::Counts& counts) {
  counts.visit([](int from, int to, int type, const messages::Counts::Sent& sent) {
    std::printf("%d %d %llu %llu %llu %s\n", from, to, static_cast<unsigned long long>(sent.messages),
                static_cast<unsigned long long>(sent.empty), static_cast<unsigned long long>(sent.bytes),
                trace::message_name(type).c_str());
  });
}

Course course_of(int argc, char** argv) {
  const std::string frames = argc == 5 ? argv[4] : "";
  if (frames != "all" && frames != "whole")
    throw Failure("wrong words", "bench-traffic", "bench-traffic FILM NODES NODES-A-MACHINE all|whole");
  return {argv[1], std::stoi(argv[2]), std::stoi(argv[3]), frames == "whole"};
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  using namespace mars;
  try {
    messages::Counts counts;
    bench::count_messages(bench::course_of(argc, argv), counts);
    bench::print(counts);
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "bench-traffic: " << reason_of(failure) << '\n';
    return 1;
  }
}
