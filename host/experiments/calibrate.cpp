#include "host/experiments/calibrate.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <cstdio>
#include <cstdlib>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <sstream>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"
#include "host/content/document/whole_file.h"
#include "host/experiments/calibration_films.h"
#include "host/experiments/fit.h"
#include "host/experiments/measured_run.h"
#include "node/wire/work.h"

namespace mars::experiments {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using wire::Work;

// Times of one phase and the kinds of work that explain them. What a frame costs beside its triangles and pixels is
// spread over phases, and charged when it begins.
struct Phase {
  const char* name;
  std::vector<const char*> times;  // as reports name them
  std::vector<Work> kinds;
};

const Phase kNodePhases[] = {
    {"dice",
     {"dice"},
     {Work::first_frame, Work::fresh_byte, Work::frame, Work::segment, Work::patch, Work::meshlet, Work::vertex,
      Work::mesh_vertex, Work::net_term, Work::skin_weight, Work::dual_weight, Work::triangle_tested, Work::row_tested,
      Work::triangle, Work::edge_box_made, Work::vertex_light}},
    {"fill", {"fill"}, {Work::fresh_byte, Work::edge_box_filled}},
    {"map", {"sum", "map"}, {Work::line_mapped}},
    {"scanline",
     {"scanline"},
     {Work::first_frame, Work::frame, Work::line, Work::edge_box, Work::sample, Work::shaded, Work::light,
      Work::facet_light, Work::pixel, Work::still_byte, Work::casting_light}},
    {"shadow",
     {"shadow"},
     {Work::shadow_point, Work::caster, Work::diced_vertex, Work::caster_vertex, Work::caster_triangle}}};
const Phase kHostPhase{"host",
                       {"busy_seconds"},
                       {Work::host_strip, Work::host_run, Work::host_byte, Work::host_restored, Work::host_frame}};

// Renderings with files. Films differ in how much of a frame is encoded again, and in size.
struct Files {
  const char* film;
  const char* format;
  Work encoded_byte;
};

constexpr Files kFiles[] = {
    {"balls", "png", Work::encoded_byte},         {"figures", "png", Work::encoded_byte},
    {"grains", "png", Work::encoded_byte},        {"lit", "png", Work::encoded_byte},
    {"balls", "png16", Work::encoded_png16_byte}, {"grains", "png16", Work::encoded_png16_byte},
    {"balls", "exr", Work::encoded_exr_byte},     {"grains", "exr", Work::encoded_exr_byte},
};

constexpr std::array kFileKinds{Work::file, Work::encoded_byte, Work::encoded_png16_byte, Work::encoded_exr_byte};

// A kind of whose units others explain more is not identified: errors of times are magnified by
// sqrt(1 / (1 - kMostExplained)) or more in its cost.
constexpr double kMostExplained = 0.95;

// Times below are the clock's and the scheduler's.
constexpr double kSoft = 1e-4;

// A frame on its node, or a rendering on its host, as a report has it.
struct Seen {
  const json& seconds;
  const json& charged;
};

Measurement measurement_of(const Seen& seen, const Phase& phase) {
  Measurement measured{{}, 0};
  for (const char* name : phase.times) measured.seconds += seen.seconds.at(name).get<double>();
  for (const Work kind : phase.kinds)
    measured.units.push_back(seen.charged.value(std::string(wire::kWorkNames[static_cast<std::size_t>(kind)]), 0.0));
  return measured;
}

// As shadows where no light casts.
bool has_no_work(const Measurement& measured) {
  return std::ranges::all_of(measured.units, [](double units) { return units == 0; });
}

const json& node_of(const json& frame) { return frame.at("nodes").front(); }

// Of its node, in all phases of all frames.
double node_seconds(const json& report) {
  double sum = 0;
  for (const json& frame : report.at("frames"))
    for (const Phase& phase : kNodePhases)
      for (const char* name : phase.times) sum += node_of(frame).at("seconds").at(name).get<double>();
  return sum;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

// Bytes a second, of one processor, beyond its caches.
double copy_rate() {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kBytes = 64 << 20;
  constexpr int kRepeats = 5;
  const std::vector<char> from(kBytes, 1);
  std::vector<char> to(kBytes);
  double least = 1e9;
  for (int i = 0; i < kRepeats; ++i) {
    const auto begun = Clock::now();
    std::memcpy(to.data(), from.data(), kBytes);
    least = std::min(least, std::chrono::duration<double>(Clock::now() - begun).count());
  }
  return kBytes / least;
}

class Measuring {
 public:
  explicit Measuring(const CalibrationTask& task) : task_(task), films_(calibration_films()) {}

  Calibration run() {
    for (const CalibrationFilm& film : films_) document::write_whole_file(film_file(film), film.text);
    for (int repeat = 0; repeat < task_.repeats; ++repeat) {
      for (const CalibrationFilm& film : films_) render(film);
      for (const Files& files : kFiles) render_files(files);
    }
    calibration_.work.assign(wire::kWorkNames.size(), 0);
    calibration_.copy_rate = copy_rate();
    for (const Phase& phase : kNodePhases) fit(phase, frames());
    fit(kHostPhase, runs());
    set_file_costs();
    calibration_.unidentified.assign(unidentified_.begin(), unidentified_.end());
    busyness_.spread = spread();
    calibration_.doubt = doubt_of(busyness_);
    return std::move(calibration_);
  }

 private:
  fs::path film_file(const CalibrationFilm& film) const { return task_.renderer.folder / (film.name + ".json"); }

  json report_of(const CalibrationFilm& film, std::vector<std::string> words) {
    words.insert(words.end(), {"--nodes", "1"});
    words.insert(words.end(), film.words.begin(), film.words.end());
    json report = report_of_run(task_.renderer, film_file(film), words);
    if (task_.progress) task_.progress(++done_, task_.repeats * static_cast<int>(films_.size() + std::size(kFiles)));
    return report;
  }

  // Keeps the repeat that took least. Not the least of each frame: what frames do to each other's caches belongs to
  // their times.
  void render(const CalibrationFilm& film) {
    json report = report_of(film, {"--sink", "none"});
    std::vector<double>& seconds = seconds_[film.name];
    seconds.push_back(node_seconds(report));
    if (seconds.back() == std::ranges::min(seconds)) reports_[film.name] = std::move(report);
  }

  // The frames of a film as files.
  void render_files(const Files& files) {
    const fs::path folder = task_.renderer.folder / "frames";
    const auto film = std::ranges::find_if(films_, [&](const auto& each) { return each.name == files.film; });
    const json report = report_of(*film, {"-o", folder.string(), "--format", files.format});
    fs::remove_all(folder);
    file_reports_[&files].push_back(report["host"]);
  }

  std::vector<Seen> frames() const {
    std::vector<Seen> all;
    for (const auto& [name, report] : reports_)
      for (const json& frame : report.at("frames"))
        all.push_back({node_of(frame).at("seconds"), node_of(frame).at("work").at("charged")});
    return all;
  }

  std::vector<Seen> runs() const {
    std::vector<Seen> all;
    for (const auto& [name, report] : reports_) all.push_back({report.at("host"), report.at("host").at("charged")});
    return all;
  }

  void fit(const Phase& phase, const std::vector<Seen>& all) {
    std::vector<Measurement> measurements;
    for (const Seen& seen : all) measurements.push_back(measurement_of(seen, phase));
    std::erase_if(measurements, has_no_work);
    const Fit found = fit_costs(measurements, kSoft);
    for (std::size_t i = 0; i < phase.kinds.size(); ++i)
      calibration_.work[static_cast<std::size_t>(phase.kinds[i])] += found.costs[i];
    note_unidentified(phase.kinds, measurements);
    calibration_.phases.push_back({phase.name, measurements.size(), found.median_error, found.high_error});
  }

  void note_unidentified(std::span<const Work> kinds, std::span<const Measurement> measurements) {
    const std::vector<double> explained = explained_by_others(measurements, kSoft);
    for (std::size_t i = 0; i < explained.size(); ++i)
      if (explained[i] > kMostExplained) unidentified_.insert(kinds[i]);
  }

  // In the middle: files are written while a node draws. Without the time for copies to the system.
  Measurement file_measurement(const Files& files) const {
    std::vector<double> seconds;
    for (const json& host : file_reports_.at(&files)) seconds.push_back(host["sink_seconds"]);
    const json& host = file_reports_.at(&files).front();
    const double copied = file_byte_seconds() * host["file_bytes"].get<double>();
    Measurement measured{std::vector<double>(kFileKinds.size()), std::max(0.0, median(seconds) - copied)};
    for (std::size_t i = 0; i < kFileKinds.size(); ++i)
      if (kFileKinds[i] == files.encoded_byte) measured.units[i] = host["encoded_bytes"];
    measured.units.front() = host["files"];
    return measured;
  }

  // A file's bytes are put together, and copied to the system.
  double file_byte_seconds() const { return 2 / calibration_.copy_rate; }

  void set_file_costs() {
    std::vector<Measurement> measurements;
    for (const Files& files : kFiles) measurements.push_back(file_measurement(files));
    const Fit found = fit_costs(measurements, kSoft);
    const auto cost = [&](Work kind) -> double& { return calibration_.work[static_cast<std::size_t>(kind)]; };
    for (std::size_t i = 0; i < kFileKinds.size(); ++i) cost(kFileKinds[i]) = found.costs[i];
    note_unidentified(kFileKinds, measurements);
    cost(Work::file_byte) = file_byte_seconds();
    calibration_.phases.push_back({"files", measurements.size(), found.median_error, found.high_error});
  }

  double spread() const {
    std::vector<double> spreads;
    for (const auto& [name, seconds] : seconds_) spreads.push_back(median(seconds) / std::ranges::min(seconds) - 1);
    return median(spreads);
  }

  const CalibrationTask& task_;
  const std::vector<CalibrationFilm> films_;
  std::map<std::string, json> reports_;                     // of each film's shortest rendering
  std::map<std::string, std::vector<double>> seconds_;      // of all
  std::map<const Files*, std::vector<json>> file_reports_;  // of their hosts
  std::set<Work> unidentified_;
  int done_ = 0;
  Busyness busyness_ = busyness();  // before it begins: its own renderings are no others
  Calibration calibration_;
};

// What a person can read, and three digits are as many as are known.
double rounded(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", number);
  return std::stod(text);
}

// What is left of a long message's time beside the copies that both ends are charged for.
double wire_rate(double rate, double copy_rate) {
  constexpr double kFastest = 1e12;
  return 1 / std::max(1 / rate - 2 / copy_rate, 1 / kFastest);
}

}  // namespace

Busyness busyness() {
  Busyness now;
  getloadavg(&now.load, 1);  // stays 0 where it is not known
  now.processors = std::max(1, static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)));
  return now;
}

std::string doubt_of(const Busyness& busyness) {
  constexpr double kMostSpread = 0.2;
  if (busyness.load > busyness.processors)
    return document::formatted("%.1f programs wanted to run at a time on ", busyness.load) +
           document::counted(static_cast<std::uint64_t>(busyness.processors), "processor");
  if (busyness.spread <= kMostSpread) return "";
  return document::formatted("repeats took %.0f %% longer than the shortest", 100 * busyness.spread);
}

Calibration calibrate(const CalibrationTask& task) { return Measuring(task).run(); }

std::string platform_text(const Calibration& calibration, const MessageCosts& messages,
                          const CalibratedMachine& machine) {
  constexpr int kAllNodes = 1 << 20;  // however many there are: they share its processors
  nlohmann::ordered_json work;
  for (std::size_t kind = 0; kind < calibration.work.size(); ++kind)
    work[std::string(wire::kWorkNames[kind])] = rounded(calibration.work[kind]);
  nlohmann::ordered_json platform = {
      {"name", machine.name},
      {"about", machine.about},
      {"computers", {{"nodes", kAllNodes}, {"processors", machine.processors}, {"memory", machine.memory}}},
      {"host", {{"apart", false}}},
      {"network",
       {{"topology", "switch"},
        {"local_latency", rounded(messages.latency)},
        {"local_rate", rounded(wire_rate(messages.rate, calibration.copy_rate))},
        {"copy_rate", rounded(calibration.copy_rate)},
        {"send", rounded(messages.end)},
        {"receive", rounded(messages.end)}}},
      {"work", work}};
  for (const Work kind : calibration.unidentified)
    platform["not_identified"].push_back(std::string(wire::kWorkNames[static_cast<std::size_t>(kind)]));
  for (const Spread& spread : calibration.spread)
    platform["spread"].push_back({{"nodes", spread.nodes},
                                  {"files", spread.files},
                                  {"low", rounded(spread.low)},
                                  {"middle", rounded(spread.middle)},
                                  {"high", rounded(spread.high)}});
  if (!calibration.doubt.empty()) platform["doubt"] = calibration.doubt;
  return platform.dump(2) + "\n";
}

std::string table_text(const Calibration& calibration) {
  std::ostringstream text;
  text << std::left << std::setw(18) << "work" << std::right << std::setw(14) << "nanoseconds" << '\n' << std::fixed;
  for (std::size_t kind = 0; kind < calibration.work.size(); ++kind)
    text << std::left << std::setw(18) << wire::kWorkNames[kind] << std::right << std::setw(14) << std::setprecision(3)
         << 1e9 * calibration.work[kind]
         << (std::ranges::count(calibration.unidentified, static_cast<Work>(kind)) > 0 ? "   not identified" : "")
         << '\n';
  if (!calibration.unidentified.empty())
    text << "\nnot identified: in the films that were measured, counts of this work nearly follow from those of other "
            "work,\n"
            "whose costs contain a part of its own\n";
  text << '\n'
       << std::left << std::setw(18) << "phase" << std::right << std::setw(14) << "measured" << std::setw(16)
       << "middle error" << std::setw(16) << "9 of 10 below" << '\n'
       << std::setprecision(0);
  for (const PhaseFit& phase : calibration.phases)
    text << std::left << std::setw(18) << phase.phase << std::right << std::setw(14) << phase.measured << std::setw(14)
         << 100 * phase.median_error << " %" << std::setw(14) << 100 * phase.high_error << " %\n";
  if (calibration.spread.empty()) return text.str();
  text << '\n'
       << "90 % of renderings took of what was forecast\n"
       << std::left << std::setw(18) << "nodes" << std::right;
  for (const char* column : {"files", "from", "middle", "to"}) text << std::setw(14) << column;
  for (const Spread& spread : calibration.spread)
    text << '\n'
         << std::left << std::setw(18) << spread.nodes << std::right << std::setw(14)
         << (spread.files ? "written" : "none") << std::setw(12) << 100 * spread.low << " %" << std::setw(12)
         << 100 * spread.middle << " %" << std::setw(12) << 100 * spread.high << " %";
  text << '\n';
  return text.str();
}

}  // namespace mars::experiments
