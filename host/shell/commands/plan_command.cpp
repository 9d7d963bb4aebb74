#include "host/shell/commands/plan_command.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "host/child/programs.h"
#include "hal/messages/settings.h"
#include "host/cli/command.h"
#include "host/content/document/file.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/experiments/forecast/counts_file.h"
#include "host/experiments/forecast/explain.h"
#include "host/experiments/forecast/forecast.h"
#include "host/images/picture_format.h"
#include "host/render/farm/node_memory.h"
#include "host/render/panorama/join_frames.h"
#include "host/render/session/session.h"
#include "host/render/walls/walls_text.h"
#include "host/shell/commands/shown_progress.h"
#include "host/shell/job/film_of.h"
#include "host/shell/options/render_options.h"
#include "topology/machine.h"

namespace mars::commands {
namespace {

constexpr std::string_view kHere = "here";
constexpr double kCounting = 0.7;  // seconds, about
constexpr int kMany = 256;         // nodes: forecasts take seconds
constexpr int kCounters = 2;       // of all frames: each may take a gigabyte
constexpr double kWorthIt = 1.05;  // times the shortest: more nodes than that takes are not worth it

struct PlanWords {
  options::RenderOptions options;
  std::string counted;  // the file of counts
  bool json = false;
  bool explain = false;
};

struct Planned {
  experiments::Platform platform;
  std::string unidentified;  // costs of the film's work; "": none
  std::size_t counted;       // frames
  std::size_t frames;
  bool files;
  std::vector<forecast::Forecast> by_nodes;   // ascending; the last has the nodes that were asked for
  std::vector<forecast::Forecast> otherwise;  // with files written by others, where that was compared
  std::vector<walls::Explanation> walls;      // of by_nodes, where they are to be explained
  double slots;                               // bytes of a node's strips
  double machine = 0;                         // bytes that all processes of one machine of nodes use
  double joining = 0;                         // and that joining a panorama's frame takes later; 0: nothing is joined

  // Of each number of nodes.
  void take_sooner() {
    for (std::size_t i = 0; i < by_nodes.size(); ++i)
      if (otherwise[i].seconds() < by_nodes[i].seconds()) std::swap(by_nodes[i], otherwise[i]);
  }
  bool is_host_apart() const { return platform.machine.host_apart; }
  const forecast::Forecast& asked() const { return by_nodes.back(); }
  // The fewest nodes that take hardly longer than the shortest.
  const forecast::Forecast& best() const {
    const auto seconds = [](const forecast::Forecast& each) { return each.seconds(); };
    const double shortest = seconds(*std::ranges::min_element(by_nodes, {}, seconds));
    return *std::ranges::find_if(by_nodes, [&](const auto& each) { return seconds(each) <= kWorthIt * shortest; });
  }
};

void warn_planner(const std::string& line) { std::cerr << "mars: warning: " << line << '\n'; }

// Machines that would render: this one, which is calibrated first, unless the options name others.
experiments::Platform platform_of(const options::RenderOptions& options, const NodesCode& code) {
  constexpr std::string_view kReference = "reference";
  const std::filesystem::path folder = experiments::platforms_folder(child::own_file());
  std::string name = options.platform.empty() ? std::string(kHere) : options.platform;
  const bool costs_of_here = name == kHere || name.ends_with(":here");
  if (costs_of_here && !calibrate_if_need_be(code)) {
    if (name == kHere)
      return experiments::like_here(std::string(kReference), folder, topology::Machine::here().processors());
    name.replace(name.size() - kHere.size(), kHere.size(), kReference);
  }
  return experiments::read_platform(name, folder);
}

// Bytes of the nodes of one machine, and of the host where that is on the same machine. Nodes of one machine have the
// memory of two frames.
double machine_bytes(const Planned& planned, const film::CompiledFilm& film) {
  constexpr double kProgram = 8 << 20;  // and MPI
  constexpr double kOfSample = 8 + 44;  // of the line that is drawn
  const forecast::Forecast& asked = planned.asked();
  const wire::FilmSettings& settings = film.view().settings();
  const int nodes = std::min(asked.nodes, planned.platform.machine.nodes);
  const double groups = std::ceil(static_cast<double>(asked.groups) * nodes / asked.nodes);
  const double line = kOfSample * settings.width * settings.samples;
  const double slots =
      planned.slots +
      static_cast<double>(wire::slot_bytes(asked.run.host_memory.format));  // and that of the next strip
  const double node = asked.run.node_memory * (nodes > 1 ? 2 : 1) + asked.run.shadow_memory + slots + line + kProgram;
  const double host = planned.is_host_apart() ? 0 : static_cast<double>(asked.run.host_memory.most_bytes()) + kProgram;
  return nodes * node + groups * asked.run.still_memory + static_cast<double>(film.block().size()) + host;
}

// Sets what processes of this machine may use, where this machine would render: MARS_MEMORY, if it is set, is a node's.
void use_memory_of_here(const options::RenderOptions& options, experiments::Platform& platform) {
  if (!options.platform.empty() && options.platform != kHere) return;
  platform.memory = messages::read_settings().memory.value_or(platform.memory);
  platform.host_memory = session::host_machine({}).memory;
}

// Of all frames, which the file has or gets.
forecast::FilmCounts exact_counts(const film::CompiledFilm& film, const std::vector<farm::Task>& tasks,
                                  const PlanWords& words, const NodesCode& code) {
  const wire::PackedFilm view = film.view();
  const std::string content = forecast::counted_content(film.block(), tasks, view, words.options.format);
  if (document::file_exists(words.counted)) return forecast::load_counts(words.counted, content, tasks, view);
  document::check_can_write(words.counted);
  const int counters = std::min(kCounters, topology::Machine::here().processors());
  forecast::FilmCounts counts = forecast::count_exactly(view, tasks, code.make_counter, words.options.format, counters,
                                                        shown_progress("counting"));
  forecast::save_counts(counts, content, words.counted);
  return counts;
}

forecast::FilmCounts counts_of(const film::CompiledFilm& film, const std::vector<farm::Task>& tasks,
                               const PlanWords& words, const NodesCode& code) {
  if (!words.counted.empty()) return exact_counts(film, tasks, words, code);
  const wire::PackedFilm view = film.view();
  return forecast::count_film(view, tasks, *code.make_counter(view, forecast::Lines::some), {kCounting},
                              words.options.format);
}

Planned plan(PlanWords words, const NodesCode& code) {
  options::RenderOptions& options = words.options;
  const bool asks_for_faces = options.faces;
  const wire::PixelFormat joined = images::facts_of(options.format).pixels;
  const film::CompiledFilm film = job::load_drawn_film_of(options, warn_planner);
  const bool joins = options.faces && !asks_for_faces;
  const wire::PackedFilm view = film.view();
  experiments::Platform platform = platform_of(options, code);
  use_memory_of_here(options, platform);
  farm::check_shadow_memory(platform.memory, shadow::shadow_needs(view));
  const auto frames = options.frames.of_film(view.settings().frames);
  const std::vector<farm::Task> tasks = farm::make_tasks(view, frames, !options.no_coherence);
  const forecast::FilmCounts counts = counts_of(film, tasks, words, code);
  forecast::Setting setting{view, platform, options.mapping, options.format, options.layers.kinds};
  setting.exchange = options.exchange;
  // As simulations count files that go nowhere.
  setting.files = options.sink == options::SinkKind::files || options.write != options::WriteWhere::automatic;
  setting.sink_threads = session::sink_threads({platform.host_memory, platform.host_processors()});
  setting.host_budget = platform.host_memory;
  setting.sharers = static_cast<std::int32_t>(options.sharers);
  setting.most_frames = options.cut;
  const int nodes = options.nodes == 0 ? topology::Machine::here().processors() : static_cast<int>(options.nodes);
  const int threads = topology::Machine::here().processors();
  const auto forecasts = [&](forecast::Writers writers) {
    setting.writers = writers;
    return forecast::forecasts_up_to(counts, tasks, setting, nodes, options.groups, threads,
                                     nodes >= kMany ? shown_progress("forecasting") : forecast::Progress());
  };
  Planned planned{
      platform, forecast::unidentified_text(counts, setting), counts.counted, frames.size(), setting.files, {}, {}, {},
      0};
  planned.by_nodes =
      forecasts(options.write == options::WriteWhere::nodes ? forecast::Writers::nodes : forecast::Writers::host);
  const bool several = nodes > platform.machine.nodes;  // computers
  if (setting.files && several && options.write == options::WriteWhere::automatic) {
    planned.otherwise = forecasts(forecast::Writers::nodes);
    planned.take_sooner();
  }
  for (std::size_t i = 0; words.explain && i < planned.by_nodes.size(); ++i) {
    setting.writers = planned.by_nodes[i].writers;
    planned.walls.push_back(forecast::explain(counts, tasks, setting, planned.by_nodes[i], threads));
  }
  // An interval says it, too.
  if (!platform.doubt.empty() && !planned.asked().spread) warn_planner(experiments::doubt_text(platform));
  const farm::HostMemory& host = planned.asked().run.host_memory;
  planned.slots = host.credits * static_cast<double>(wire::slot_bytes(host.format));
  planned.machine = machine_bytes(planned, film);
  if (joins) planned.joining = static_cast<double>(panorama::joining_bytes(view.settings().width, joined));
  return planned;
}

std::string megabytes(double bytes) { return document::formatted("%.1f MB", bytes / 1e6); }

std::string in_groups(const forecast::Forecast& forecast) {
  return document::counted(static_cast<std::size_t>(forecast.nodes), "node") + " in " +
         document::counted(forecast.groups, "group");
}

// "": as by default.
std::string division_text(const forecast::Forecast& forecast) {
  std::string text;
  if (forecast.sharers > 1)
    text +=
        ", of which " + document::counted(static_cast<std::size_t>(forecast.sharers), "node") + " share an inbetween";
  if (forecast.most_frames > 0) text += ", intervals cut after " + document::counted(forecast.most_frames, "frame");
  return text;
}

std::string interval_text(const Planned& planned) {
  if (const auto interval = planned.asked().interval())
    return document::formatted("%.0f %%: %.3g to %.3g", 100 * experiments::kWithin, interval->low, interval->high);
  const std::vector<experiments::Spread>& tried = planned.platform.spread;
  if (tried.empty()) return "it is not known how far off: none was tried on platform " + planned.platform.name;
  const auto [least, most] = std::ranges::minmax(tried, {}, &experiments::Spread::nodes);
  const std::string from = least.nodes == most.nodes ? "" : std::to_string(least.nodes) + " to ";
  return "it is not known how far off: tried were forecasts for " + from +
         document::counted(static_cast<std::size_t>(most.nodes), "node");
}

const char* name_of(forecast::Writers writers) { return writers == forecast::Writers::nodes ? "nodes" : "host"; }

std::string writers_text(forecast::Writers writers) {
  return writers == forecast::Writers::nodes ? "nodes" : "the host";
}

std::string files_text(const Planned& planned) {
  const std::string written = "files       written by " + writers_text(planned.asked().writers);
  if (planned.otherwise.empty()) return written;
  const forecast::Forecast& other = planned.otherwise.back();
  return written + " (by " + writers_text(other.writers) + ": " + in_groups(other) +
         document::formatted(", %.4g seconds)", other.seconds());
}

std::string text_of(const Planned& planned) {
  const forecast::Forecast &asked = planned.asked(), &best = planned.best();
  const forecast::Rehearsed& run = asked.run;
  std::string text = "platform    " + planned.platform.name + "\n";
  if (!planned.unidentified.empty()) text += "costs       " + planned.unidentified + "\n";
  text += "nodes       " + in_groups(asked) + division_text(asked) + "\n";
  text += document::formatted("seconds     %.4g", asked.seconds()) + " (" + interval_text(planned) + ")\n";
  if (!planned.platform.doubt.empty() && asked.spread)
    text += "            the interval is wide, for the calibration was noisy: " + planned.platform.doubt + "\n";
  if (planned.files) text += files_text(planned) + "\n";
  text += document::formatted("node hours  %.3g\n", asked.node_hours());
  text += "a node      " + megabytes(run.node_memory) + " for a frame, " + megabytes(planned.slots) + " for strips\n";
  if (run.shadow_memory > 0) text += "            " + megabytes(run.shadow_memory) + " for shadows\n";
  text += "a machine   " + megabytes(planned.machine) + " with its nodes" +
          (run.still_memory > 0 ? ", of which " + megabytes(run.still_memory) + " a group for still lines" : "") +
          (planned.is_host_apart() ? "\n" : ", and the host\n");
  text += "the host    " + megabytes(static_cast<double>(run.host_memory.most_bytes())) + " at most\n";
  if (planned.joining > 0)
    text += "joining     " + megabytes(planned.joining) + " for each frame that is joined of its faces, at the end\n";
  text += "messages    " + megabytes(run.bytes_to_nodes) + " between nodes, " + megabytes(run.bytes_to_host) +
          " to the host\n";
  text += document::formatted("counted     %zu of %zu frames\n", planned.counted, planned.frames);
  text += "best        " + in_groups(best) + document::formatted(", %.4g seconds\n", best.seconds());
  text += "  nodes   groups      seconds   speed-up   node hours\n";
  for (const forecast::Forecast& each : planned.by_nodes)
    text += document::formatted("%7d %8u %12.4g %10.2f %12.3g\n", each.nodes, each.groups, each.seconds(),
                                planned.by_nodes.front().seconds() / each.seconds(), each.node_hours());
  return text;
}

// Of each number of nodes, and all of those of the nodes that were asked for.
std::string walls_text(const Planned& planned) {
  if (planned.walls.empty()) return "";
  std::string text = "  nodes   what binds\n";
  for (std::size_t i = 0; i < planned.walls.size(); ++i)
    text += document::formatted("%7d   ", planned.by_nodes[i].nodes) + walls::line_of(planned.walls[i]) + "\n";
  return text + "walls of " + in_groups(planned.asked()) + "\n" + walls::table_of(planned.walls.back());
}

nlohmann::ordered_json json_of(const Planned& planned, const forecast::Forecast& forecast) {
  nlohmann::ordered_json all = {{"nodes", forecast.nodes},
                                {"groups", forecast.groups},
                                {"sharers", forecast.sharers},
                                {"cut", forecast.most_frames},
                                {"seconds", forecast.seconds()},
                                {"node_hours", forecast.node_hours()},
                                {"node_memory", std::llround(forecast.run.node_memory)},
                                {"shadow_memory", std::llround(forecast.run.shadow_memory)},
                                {"still_memory", std::llround(forecast.run.still_memory)},
                                {"host_memory", forecast.run.host_memory.most_bytes()},
                                {"bytes_to_nodes", std::llround(forecast.run.bytes_to_nodes)},
                                {"bytes_to_host", std::llround(forecast.run.bytes_to_host)}};
  if (planned.files) all["write"] = name_of(forecast.writers);
  if (const auto interval = forecast.interval())
    all["interval"] = {{"within", experiments::kWithin}, {"low", interval->low}, {"high", interval->high}};
  return all;
}

std::string json_text(const Planned& planned) {
  nlohmann::ordered_json all = json_of(planned, planned.asked());
  all["platform"] = planned.platform.name;
  if (!planned.platform.doubt.empty()) all["doubt"] = planned.platform.doubt;
  if (!planned.unidentified.empty()) all["not_identified"] = planned.unidentified;
  all["counted"] = planned.counted;
  all["frames"] = planned.frames;
  all["slots"] = std::llround(planned.slots);
  all["machine_memory"] = std::llround(planned.machine);
  if (planned.joining > 0) all["joining_memory"] = std::llround(planned.joining);
  all["best"] = json_of(planned, planned.best());
  for (const forecast::Forecast& each : planned.by_nodes) all["by_nodes"].push_back(json_of(planned, each));
  for (std::size_t i = 0; i < planned.walls.size(); ++i) all["by_nodes"][i]["explained"] = json_of(planned.walls[i]);
  return all.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace

void add_plan(cli::Command app, const NodesCode& code) {
  const auto words = std::make_shared<PlanWords>();
  const cli::Command command = app.add_command("plan", "Forecast a rendering's time, memory and bytes");
  options::add_render_options(command, words->options, options::Program::plan);
  command
      .add("--counted", words->counted,
           "Count all frames of the film exactly, and keep the counts in FILE, or take them from there. Example: "
           "--counted film.counts")
      .type("FILE");
  command.add_flag("--json", words->json, "Print one JSON object, for programs. Example: --json");
  command.add_flag("--explain", words->explain,
                   "Say what the time consists of: what binds, what it would take without that, and what binds then. "
                   "Example: --explain");
  command.runs([words, code] {
    const Planned planned = plan(*words, code);
    std::cout << (words->json ? json_text(planned) : text_of(planned) + walls_text(planned));
  });
}

}  // namespace mars::commands
