#include "host/experiments/forecast/forecast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "host/experiments/calibration_films.h"
#include "host/experiments/forecast/frame_costs.h"
#include "host/programs/node_counter.h"
#include "tests/host/experiments/forecast/simulated_film.h"
#include "tests/temporary_folder.h"

namespace mars::forecast {
namespace {

constexpr double kWithin = 0.15;

void expect_near(double forecast, double measured, double within, const std::string& what) {
  EXPECT_NEAR(forecast, measured, within * measured) << what;
}

double sum_of(const farm::FarmReport& report, std::uint64_t wire::WorkCounts::*count) {
  double sum = 0;
  for (const wire::Strip& strip : report.strips)
    if (strip.last == 1) sum += static_cast<double>(strip.work.*count);
  return sum;
}

double most_of(const farm::FarmReport& report, std::uint64_t wire::WorkCounts::*count) {
  std::uint64_t most = 0;
  for (const wire::Strip& strip : report.strips) most = std::max(most, strip.work.*count);
  return static_cast<double>(most);
}

struct Case {
  const char* film;
  const char* frames;
};

// By GoogleTest, in messages and names.
void PrintTo(const Case& one, std::ostream* out) { *out << one.film; }

class Forecasts : public testing::TestWithParam<Case> {
 protected:
  static void expect_counted(const SimulatedFilm& film, const farm::FarmReport& report);
};

TEST_P(Forecasts, AreAsSimulated) {
  const SimulatedFilm film(GetParam().film, GetParam().frames, "fat-tree");
  for (const int nodes : {1, 2, 16}) {
    const Forecast choice = film.forecast(nodes, 1);
    const Rehearsed& forecast = choice.run;
    const farm::FarmReport report = film.render(choice);
    const std::string where = " on " + std::to_string(nodes) + " nodes";
    expect_near(forecast.seconds, report.total_seconds, kWithin, "seconds" + where);
    expect_near(forecast.bytes_to_host, sum_of(report, &wire::WorkCounts::bytes_to_host), kWithin, "to host" + where);
    expect_near(forecast.bytes_to_nodes, sum_of(report, &wire::WorkCounts::bytes_to_nodes), kWithin,
                "to nodes" + where);
    expect_near(forecast.node_memory, most_of(report, &wire::WorkCounts::memory), kWithin, "memory" + where);
    EXPECT_EQ(forecast.frames.size(), report.frames.size());
    if (nodes == 1) expect_counted(film, report);
  }
}

TEST(ForecastsOfFiles, AreAsSimulated) {
  for (const Files files : {Files::host, Files::nodes})
    for (const auto& [one, nodes] :
         {std::pair{Case{"s3", "0-11"}, 1}, {Case{"visit", "100-104"}, 4}, {Case{"stones", "0-7"}, 4}}) {
      const SimulatedFilm film(one.film, one.frames, "fat-tree", files);
      const Forecast forecast = film.forecast(nodes, 1);
      expect_near(forecast.run.seconds, film.render(forecast).total_seconds, kWithin,
                  std::string(one.film) + (files == Files::host ? ", host writes" : ", nodes write"));
    }
}

// A platform of MARS, changed by a patch of JSON and written into the folder.
std::string changed_platform(const test::TemporaryFolder& folder, const std::string& name, const char* patch) {
  std::ifstream file(std::string(MARS_SOURCE_DIR) + "/cluster/platforms/" + name + ".json");
  nlohmann::json platform = nlohmann::json::parse(file);
  platform.merge_patch(nlohmann::json::parse(patch));
  const std::string changed = folder / (name + "-changed.json");
  std::ofstream(changed) << platform;
  return changed;
}

struct Cluster {
  const char* how;
  const char* platform;
  const char* even;   // a patch
  const char* patch;  // another
  double least;       // times as long the latter takes, simulated and forecast
};

// Each takes so much longer that a forecast that left it out would be far off.
TEST(ForecastsOfClusters, AreAsSimulated) {
  const test::TemporaryFolder folder;
  for (const Cluster& cluster :
       {Cluster{"slow computers", "fat-tree", "{}", R"({"computers": {"speeds": [[1, 0.5]]}})", 1.5},
        Cluster{"detours", "fat-tree", "{}",
                R"({"noise": {"seed": 3, "detours": 2000, "detour": 1.5e-4, "lengths": "exponential"}})", 1.3},
        Cluster{"announced messages", "ethernet", R"({"network": {"latency": 5e-4}})",
                R"({"network": {"latency": 5e-4, "eager": 1000}})", 1.08},
        Cluster{"a slow server", "ethernet", "{}", R"({"storage": {"rate": 1e6}})", 1.5},
        Cluster{"slow writers", "ethernet", "{}", R"({"storage": {"writer_rate": 2e6}})", 1.5}}) {
    const auto film = [&](const char* patch) {
      return SimulatedFilm("s3", "0-11", changed_platform(folder, cluster.platform, patch), Files::nodes);
    };
    const SimulatedFilm even = film(cluster.even), changed = film(cluster.patch);
    const Forecast forecast = changed.forecast(4, 1);
    const auto simulated = [&](const SimulatedFilm& film) { return film.render(forecast).total_seconds; };
    const double slow = simulated(changed);
    expect_near(forecast.run.seconds, slow, kWithin, cluster.how);
    EXPECT_GT(slow, cluster.least * simulated(even)) << cluster.how;
    EXPECT_GT(forecast.run.seconds, cluster.least * even.forecast(4, 1).run.seconds) << cluster.how;
  }
}

// Messages of a second to the host bind the film, however keyframes are drawn: fewer contributors spare it messages.
TEST(Contributors, AreFewerWhereTheHostBindsToo) {
  const test::TemporaryFolder folder;
  const SimulatedFilm film("s3", "0-11",
                           changed_platform(folder, "ipsc2", R"({"network": {"host_end": [[0, 0], [101, 1]]}})"));
  const Forecast chosen = film.forecast(32, 1);
  EXPECT_GT(chosen.contributors, 0);  // not all nodes
  const auto first_picture = [](const farm::FarmReport& report) { return report.frames.front().seconds; };
  EXPECT_LT(first_picture(film.render(chosen)), 0.8 * first_picture(film.render(32, 1)));
}

// A film of mars calibrate, written into the folder, as SimulatedFilm takes it.
std::string calibration_film(const test::TemporaryFolder& folder, const std::string& name) {
  static const std::vector<experiments::CalibrationFilm> films = experiments::calibration_films();
  const auto found = std::ranges::find(films, name, &experiments::CalibrationFilm::name);
  const std::string path = folder / ("calibration-" + name);
  std::ofstream(path + ".json") << found->text;
  return path;
}

// Where bending takes a large part of the time.
TEST(ForecastsOfSkins, AreAsSimulated) {
  const test::TemporaryFolder folder;
  for (const auto& [name, kind] : {std::pair{"nets", wire::Work::net_term},
                                   {"skins", wire::Work::skin_weight},
                                   {"duals", wire::Work::dual_weight}}) {
    SimulatedFilm film(calibration_film(folder, name), "0-5", "fat-tree");
    const auto seconds_with = [&](double cost) {
      experiments::Platform platform = film.platform();
      platform.machine.work[static_cast<std::size_t>(kind)] = cost;
      film.set_platform(platform);
      const Forecast forecast = film.forecast(4, 1);
      const double simulated = film.render(forecast).total_seconds;
      expect_near(forecast.run.seconds, simulated, kWithin, name);
      return simulated;
    };
    EXPECT_GT(seconds_with(1e-6), 2 * seconds_with(0)) << name;
  }
}

TEST(ForecastsOfTeams, AreAsSimulated) {
  for (const Files files : {Files::none, Files::nodes})
    for (const auto& [one, nodes, groups, sharers, most] : {std::tuple{Case{"s3", "0-11"}, 4, 1u, 2, kUncut},
                                                            {Case{"visit", "100-105"}, 8, 2u, 2, 3u},
                                                            {Case{"demo", "0-5"}, 8, 1u, 8, kUncut}}) {
      const SimulatedFilm film(one.film, one.frames, "fat-tree", files);
      const Forecast forecast = film.forecast(nodes, groups, sharers, most);
      expect_near(forecast.run.seconds, film.render(forecast).total_seconds, 0.2,
                  std::string(one.film) + (files == Files::nodes ? ", nodes write, " : ", ") + std::to_string(sharers) +
                      " of " + std::to_string(nodes) + " share");
    }
}

// On a slow network it takes less time to make triangles again.
TEST(ForecastsOfExchanges, AreAsSimulated) {
  SimulatedFilm film("s3", "0-7", "ethernet");
  experiments::Platform slow = film.platform();
  slow.machine.network.byte *= 10;
  slow.machine.network.host_byte = slow.machine.network.byte / 1000;
  film.set_platform(slow);
  const std::uint32_t every_frame = 1;
  std::vector<double> seconds;
  for (const wire::Exchange exchange : {wire::Exchange::send, wire::Exchange::automatic, wire::Exchange::again}) {
    film.set_exchange(exchange);
    const Forecast forecast = film.forecast(4, 1, 1, every_frame);
    expect_near(forecast.run.seconds, film.render(forecast).total_seconds, 0.1,
                std::to_string(static_cast<int>(exchange)));
    seconds.push_back(forecast.run.seconds);
  }
  EXPECT_LT(seconds.back(), 0.95 * seconds.front());
}

// A film of fewer inbetweens than nodes.
TEST(ForecastsOfTeams, ChooseThemWhereTheyPay) {
  const SimulatedFilm film("demo", "0-7", "fat-tree", Files::nodes);
  const Forecast chosen = film.forecast(32, 0), alone = film.forecast(32, 0, 1, kUncut);
  EXPECT_GT(chosen.sharers, 1);
  EXPECT_LT(chosen.run.seconds, alone.run.seconds * 0.9);
  EXPECT_LT(film.render(chosen).total_seconds, film.render(alone).total_seconds * 0.95);
  EXPECT_EQ(film.forecast(2, 1).sharers, 1) << "each node has inbetweens of its own";
}

// What is made is counted; what is seen is estimated from some lines.
void Forecasts::expect_counted(const SimulatedFilm& film, const farm::FarmReport& report) {
  for (const wire::Strip& strip : report.strips) {
    if (strip.last == 0) continue;
    const auto is_here = [&](const wire::FrameCounts& counts) { return counts.frame == strip.frame; };
    const auto keyframe = std::ranges::find_if(film.counts().keyframes, is_here);
    if (keyframe == film.counts().keyframes.end()) continue;
    const FrameTotals totals = totals_of(*keyframe, 1);
    EXPECT_EQ(totals.made[wire::Work::triangle], static_cast<double>(strip.work.triangles));
    EXPECT_EQ(totals.made[wire::Work::edge_box_made], static_cast<double>(strip.work.edge_boxes_diced));
    EXPECT_EQ(totals.drawn.edge_boxes, static_cast<double>(strip.edge_box_total));
    EXPECT_EQ(totals.drawn.samples, static_cast<double>(strip.work.samples));
    expect_near(totals.pixels(), static_cast<double>(strip.work.pixels), 0.05, "pixels");
  }
}

// Films counted exactly, and simulated with pixels.
class Counted : public testing::TestWithParam<std::tuple<const char*, Files>> {
 protected:
  const char* platform() const { return std::get<0>(GetParam()); }
  Files files() const { return std::get<1>(GetParam()); }
  // Of seconds. If the host writes files, which buffers it gets follows from moments.
  double within() const { return files() == Files::host ? 0.08 : 0.03; }

  void expect_as_simulated(const SimulatedFilm& film, int nodes, std::uint32_t groups) const {
    const Rehearsed counted = film.counted(nodes, groups);
    const farm::FarmReport report = film.render(nodes, groups);
    const std::string where = " on " + std::to_string(nodes) + " nodes in " + std::to_string(groups) + " groups";
    expect_near(counted.seconds, report.total_seconds, within(), "seconds" + where);
    if (files() != Files::nodes)
      expect_near(counted.bytes_to_host, sum_of(report, &wire::WorkCounts::bytes_to_host), 1e-6, "to host" + where);
    expect_near(counted.bytes_to_nodes, sum_of(report, &wire::WorkCounts::bytes_to_nodes), 0.01, "to nodes" + where);
    expect_near(counted.node_memory, most_of(report, &wire::WorkCounts::memory), 0.03, "memory" + where);
  }
};

TEST_P(Counted, IsAsSimulated) {
  const bool is_far = platform() == std::string_view("ethernet");
  const Case one = is_far ? Case{"s3", "0-11"} : Case{"robot-arm", "10-25"};
  const SimulatedFilm film(one.film, one.frames, platform(), files());
  for (const auto& [nodes, groups] : {std::pair{1, 1u}, {4, 2u}, {16, 1u}, {64, is_far ? 1u : 2u}})
    if (groups <= film.tasks().size()) expect_as_simulated(film, nodes, groups);
}

std::string name_of(const testing::TestParamInfo<Counted::ParamType>& each) {
  const auto [platform, files] = each.param;
  const char* written = files == Files::none ? "NoFiles" : files == Files::host ? "HostWrites" : "NodesWrite";
  return (platform == std::string_view("ethernet") ? "Ethernet" : "FatTree") + std::string(written);
}

INSTANTIATE_TEST_SUITE_P(Platforms, Counted,
                         testing::Combine(testing::Values("fat-tree", "ethernet"),
                                          testing::Values(Files::none, Files::host, Files::nodes)),
                         name_of);

TEST(ExactCounts, AreThePixelsThatNodesDraw) {
  const SimulatedFilm film("demo", "0-3", "fat-tree");
  const FilmCounts counts = film.count_exactly();
  for (const wire::Strip& strip : film.render(1, 1).strips) {
    if (strip.last == 0) continue;
    const bool is_keyframe = strip.frame == counts.keyframes.front().frame;
    const FrameTotals totals =
        is_keyframe ? totals_of(counts.keyframes.front(), 1) : counts.tasks.front().inbetweens[strip.frame - 1];
    EXPECT_EQ(totals.pixels(), static_cast<double>(strip.work.pixels)) << strip.frame;
  }
}

// One light that casts.
struct Lit {
  Case film;
  const char* how;
  const char* light = "";
  std::vector<int> nodes = {1, 4};
};

void PrintTo(const Lit& one, std::ostream* out) { *out << one.film.film << one.how; }

class ForecastsOfShadows : public testing::TestWithParam<Lit> {
 protected:
  SimulatedFilm film() const {
    const Lit& lit = GetParam();
    return SimulatedFilm(lit.film.film, lit.film.frames, "fat-tree", Files::none, lit.light);
  }
  static void expect_counted(const SimulatedFilm& film, const farm::FarmReport& report);
};

TEST_P(ForecastsOfShadows, AreAsSimulated) {
  const SimulatedFilm film = this->film();
  for (const int nodes : GetParam().nodes) {
    const Forecast forecast = film.forecast(nodes, 1);
    const farm::FarmReport report = film.render(forecast);
    const std::string where = "on " + std::to_string(nodes) + " nodes";
    if (nodes == 1) expect_counted(film, report);
    expect_near(forecast.run.seconds, report.total_seconds, 0.2, where);
    expect_near(forecast.run.bytes_to_nodes, sum_of(report, &wire::WorkCounts::bytes_to_nodes), 0.2,
                "bytes to nodes, " + where);
  }
}

// What casts is found by boxes round what is seen on some lines, and of a light with size by some of its points.
void ForecastsOfShadows::expect_counted(const SimulatedFilm& film, const farm::FarmReport& report) {
  using wire::Work;
  const auto charged = [&](Work kind) {
    double sum = 0;
    for (const wire::Strip& strip : report.strips)
      if (strip.last == 1) sum += static_cast<double>(strip.work.charged[static_cast<std::size_t>(kind)]);
    return sum;
  };
  FrameTotals all;
  for (const TaskCounts& task : film.counts().tasks) {
    all = all + totals_of(film.counts().keyframes[task.keyframe], 1);
    for (const FrameTotals& inbetween : task.inbetweens) all = all + inbetween;
  }
  const bool is_soft = !std::string_view(GetParam().light).empty();
  const double points = all.drawn.constant.points + all.drawn.moving.points + all.kept_points;
  expect_near(points, charged(Work::shadow_point), is_soft ? 0.2 : 0.1, "points");
  for (const Work kind : {Work::caster, Work::diced_vertex, Work::caster_vertex, Work::caster_triangle})
    expect_near(all.casters[kind], charged(kind), is_soft ? 0.2 : kWithin,
                std::string(wire::kWorkNames[static_cast<std::size_t>(kind)]));
}

constexpr const char *kSun = R"({"size": 0.53})", *kSky = R"({"size": 5})",
                     *kLamp = R"({"direction": null, "place": [-15, -10, 25], "size": 1})",
                     *kSpot =
                         R"({"direction": null, "place": [20, -50, 60], "at": [0, -10, 0], "cone": 60, "size": 2})";

INSTANTIATE_TEST_SUITE_P(Examples, ForecastsOfShadows,
                         testing::Values(Lit{{"s1s", "0-0"}, ""}, Lit{{"s2s", "0-0"}, ""}, Lit{{"s3s", "0-11"}, ""},
                                         Lit{{"s1s", "0-0"}, "_sun", kSun}, Lit{{"s2s", "0-0"}, "_sun", kSun},
                                         Lit{{"s3s", "0-11"}, "_sun", kSun}, Lit{{"s1s", "0-0"}, "_sky", kSky},
                                         Lit{{"s3s", "0-11"}, "_sky", kSky}, Lit{{"s2s", "0-0"}, "_lamp", kLamp, {1}},
                                         Lit{{"s3s", "0-2"}, "_spot", kSpot}),
                         [](const auto& each) { return std::string(each.param.film.film) + each.param.how; });

INSTANTIATE_TEST_SUITE_P(Examples, Forecasts,
                         testing::Values(Case{"demo", "0-7"}, Case{"visit", "100-109"}, Case{"s3", "0-11"},
                                         Case{"robot-arm", "10-40"}, Case{"bodies", "5-12"}, Case{"stones", "0-15"},
                                         Case{"caterpillar", "0-9"}, Case{"teapot", "0-11"}),
                         [](const auto& each) {
                           std::string name = each.param.film;
                           std::erase(name, '-');
                           return name;
                         });

// Of all numbers of groups, the one chosen takes hardly longer than the best.
void expect_best_groups(const SimulatedFilm& film, int nodes) {
  const auto most = std::min(static_cast<std::uint32_t>(nodes), static_cast<std::uint32_t>(film.tasks().size()));
  const Forecast chosen = film.forecast(nodes, 0);
  const double own = film.render(chosen).total_seconds;
  double best = 1e30;
  for (std::uint32_t groups = 1; groups <= most; ++groups)
    best = std::min(best, film.render(nodes, groups).total_seconds);
  EXPECT_LE(own, 1.05 * best) << chosen.groups << " groups of " << nodes << " nodes on " << film.platform().name;
  EXPECT_GT(own, 0);
}

TEST(Groups, AreChosenAsBySearch) {
  for (const char* platform : {"fat-tree", "ethernet"}) {
    expect_best_groups(SimulatedFilm("robot-arm", "10-33", platform), 4);
    expect_best_groups(SimulatedFilm("cubes", "40-60", platform), 2);
  }
  expect_best_groups(SimulatedFilm("bodies", "6-17", "ethernet"), 4);
}

TEST(Groups, AreTheSameEveryTime) {
  const Forecast first = SimulatedFilm("robot-arm", "0-60", "ethernet").forecast(8, 0);
  const Forecast second = SimulatedFilm("robot-arm", "0-60", "ethernet").forecast(8, 0);
  EXPECT_EQ(first.groups, second.groups);
  EXPECT_EQ(first.run.seconds, second.run.seconds);
}

TEST(Forecast, OfFewFramesCountedIsCloseToThatOfAll) {
  const SimulatedFilm film("caterpillar", "0-47", "fat-tree");
  const wire::PackedFilm view = film.view();
  Setting setting{view, film.platform()};
  setting.files = false;
  const FilmCounts few = count_film(view, film.tasks(), *programs::make_node_counter(view, Lines::some), {10, 0.05},
                                    images::PictureFormat::png);
  EXPECT_LT(few.counted, 10u);
  EXPECT_NEAR(forecast(few, film.tasks(), setting, 4, 1).run.seconds, film.forecast(4, 1).run.seconds,
              0.1 * film.forecast(4, 1).run.seconds);
}

TEST(FrameCosts, TheBandsOfATeamMakeUpTheFile) {
  const SimulatedFilm film("robot-arm", "10-11", "fat-tree", Files::nodes);
  const wire::PackedFilm view = film.view();
  const Setting setting{view, film.platform()};
  const FrameCosts costs(setting, 8);
  FrameTotals whole;
  whole.lines = whole.changed = view.settings().height;
  EXPECT_EQ(costs.inbetween(whole, {}, 1).team_bytes, 0);
  for (const int sharers : {2, 8})
    EXPECT_NEAR(sharers * costs.inbetween(whole, {}, sharers).team_bytes, costs.file_bytes(),
                1e-6 * costs.file_bytes());
}

}  // namespace
}  // namespace mars::forecast
