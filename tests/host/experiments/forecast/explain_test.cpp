#include "host/experiments/forecast/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "host/render/report/replay.h"
#include "host/render/walls/walls_text.h"
#include "tests/host/experiments/forecast/simulated_film.h"

namespace mars::forecast {
namespace {

using experiments::Platform;
using walls::Wall;
using wire::Work;

constexpr double kWithin = 0.1;   // of the rendering's time
constexpr double kLittle = 0.02;  // of it: what gains less, by forecast and report, is tried together

// A rendering, on a platform that is changed so that the wall binds.
struct Bound {
  Wall wall;
  const char* film;
  const char* frames;
  int nodes;
  Files files;
  const char* platform;
  void (*change)(Platform& platform);
};

void PrintTo(const Bound& one, std::ostream* out) { *out << walls::name_of(one.wall); }

double& cost(Platform& platform, Work kind) { return platform.machine.work[static_cast<std::size_t>(kind)]; }

// Kinds from `first` to before `end`.
void scale(Platform& platform, std::size_t first, std::size_t end, double times) {
  for (std::size_t kind = first; kind < end; ++kind) platform.machine.work[kind] *= times;
}

void scale_nodes(Platform& platform, double times) { scale(platform, 0, wire::kNodeKinds, times); }

// Seconds that each node worked for frames of a kind.
std::vector<double> work_of(const farm::FarmReport& report, wire::FrameKind kind) {
  std::vector<double> seconds(report.nodes.size());
  for (const wire::Strip& strip : report.strips) {
    const wire::PhaseTimes& times = strip.times;
    if (strip.last == 1 && strip.kind == kind)
      seconds[static_cast<std::size_t>(strip.node)] +=
          times.dice + times.fill + times.map + times.scanline + times.shadow + times.compose;
  }
  return seconds;
}

// Computers that are as fast as makes their work even: of a keyframe, or of inbetweens where nodes without any help.
Platform without_unevenness(Platform platform, Wall wall, const farm::FarmReport& report) {
  const bool inbetweens = wall == Wall::frame;
  const std::vector<double> own = work_of(report, inbetweens ? wire::FrameKind::inbetween : wire::FrameKind::keyframe);
  const double mean = std::reduce(own.begin(), own.end()) / static_cast<double>(own.size());
  platform.machine.slowness = [own, mean, inbetweens](int computer, double) {
    const auto place = static_cast<std::size_t>(computer);
    if (place >= own.size() || own[place] <= 0) return 1.0;
    return inbetweens ? std::min(1.0, mean / own[place]) : mean / own[place];
  };
  return platform;
}

double gain_of(const walls::Explanation& explanation, Wall wall) {
  const auto found = std::ranges::find(explanation.walls, wall, &walls::FoundWall::wall);
  return found == explanation.walls.end() ? 0 : (explanation.seconds - found->without) / explanation.seconds;
}

class Explained : public testing::TestWithParam<Bound> {
 protected:
  Explained() : film_(GetParam().film, GetParam().frames, GetParam().platform, GetParam().files) {
    Platform platform = film_.platform();
    GetParam().change(platform);
    film_.set_platform(platform);
    report_ = film_.render(GetParam().nodes, 1);
  }

  // By how much a simulation on a platform without the wall is shorter, as part of its time; none: it cannot be, as all
  // of a keyframe's steps are uneven in their own way, or several keyframes are.
  std::optional<double> simulated_gain(Wall wall) const {
    const bool uneven = wall == Wall::frame || wall == Wall::imbalance;
    if (wall == Wall::imbalance && GetParam().wall != Wall::imbalance) return std::nullopt;
    const Writers writers = GetParam().files == Files::nodes ? Writers::nodes : Writers::host;
    return simulated_gain(uneven ? without_unevenness(film_.platform(), wall, report_)
                                 : without(film_.platform(), {wall}, writers));
  }

  double simulated_gain(const Platform& platform) const {
    SimulatedFilm film = film_;
    film.set_platform(platform);
    return 1 - film.render(GetParam().nodes, 1).total_seconds / report_.total_seconds;
  }

  SimulatedFilm film_;
  farm::FarmReport report_;
};

TEST_P(Explained, AsByAblation) {
  const walls::Explanation forecast = film_.explain(GetParam().nodes, 1), recorded = report::explain(report_);
  for (const walls::Explanation& explanation : {forecast, recorded}) {
    ASSERT_NE(explanation.binding(), nullptr);
    EXPECT_EQ(walls::name_of(explanation.binding()->wall), walls::name_of(GetParam().wall))
        << walls::table_of(explanation);
  }
  walls::Walls little;
  for (const walls::FoundWall& found : forecast.walls) {
    const bool uneven = found.wall == Wall::frame || found.wall == Wall::imbalance;
    if (!uneven && std::max(gain_of(forecast, found.wall), gain_of(recorded, found.wall)) < kLittle) {
      little.add(found.wall);
      continue;
    }
    const std::optional<double> gain = simulated_gain(found.wall);
    if (!gain) continue;
    EXPECT_NEAR(gain_of(forecast, found.wall), *gain, kWithin) << "forecast, " << walls::name_of(found.wall);
    EXPECT_NEAR(gain_of(recorded, found.wall), *gain, kWithin) << "recorded, " << walls::name_of(found.wall);
  }
  const Writers writers = GetParam().files == Files::nodes ? Writers::nodes : Writers::host;
  if (!little.list().empty()) {
    EXPECT_LT(simulated_gain(without(film_.platform(), little, writers)), kWithin) << "all that gain little";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Walls, Explained,
    testing::Values(Bound{Wall::compute, "demo", "0-7", 2, Files::none, "fat-tree", [](Platform&) {}},
                    // Lines cost what the mapping does not expect.
                    Bound{Wall::imbalance, "s1", "0-0", 32, Files::none, "fat-tree",
                          [](Platform& platform) {
                            scale_nodes(platform, 0);
                            cost(platform, Work::line) = 1e-4;
                          }},
                    Bound{Wall::sum, "s1", "0-0", 64, Files::none, "fat-tree",
                          [](Platform& platform) {
                            scale_nodes(platform, 0.05);
                            platform.machine.network.latency = 1e-3;
                          }},
                    Bound{Wall::exchange, "bodies", "5-5", 16, Files::none, "ethernet",
                          [](Platform& platform) {
                            platform.machine.network.byte *= 5;
                            platform.machine.network.host_byte = 1e-12;
                          }},
                    Bound{Wall::still, "stones", "0-11", 4, Files::none, "ethernet",
                          [](Platform& platform) {
                            scale_nodes(platform, 0.05);
                            platform.machine.network.host_byte = 1e-12;
                            platform.machine.network.host_end = {{0, 1e-7}};
                          }},
                    Bound{Wall::still, "stones", "0-11", 16, Files::nodes, "ethernet",
                          [](Platform& platform) {
                            scale_nodes(platform, 0.2);
                            platform.machine.storage = {};
                          }},
                    Bound{Wall::bands, "s3", "0-11", 4, Files::nodes, "ethernet",
                          [](Platform& platform) {
                            scale_nodes(platform, 0.3);
                            platform.file_part = 2;
                            platform.machine.storage = {};
                          }},
                    Bound{Wall::host, "visit", "100-104", 8, Files::host, "fat-tree",
                          [](Platform& platform) {
                            scale(platform, wire::kNodeKinds, static_cast<std::size_t>(Work::file), 20);
                          }},
                    Bound{Wall::encoder, "visit", "100-109", 8, Files::host, "fat-tree",
                          [](Platform& platform) {
                            platform.machine.host_processors = 1;
                            cost(platform, Work::encoded_byte) *= 5;
                            cost(platform, Work::file_byte) *= 5;
                          }},
                    Bound{Wall::encoder, "visit", "100-109", 8, Files::nodes, "fat-tree",
                          [](Platform& platform) { cost(platform, Work::encoded_byte) *= 30; }},
                    Bound{Wall::storage, "visit", "100-104", 8, Files::nodes, "fat-tree",
                          [](Platform& platform) { platform.machine.storage.opening = 0.01; }},
                    Bound{Wall::storage, "visit", "100-104", 8, Files::host, "fat-tree",
                          [](Platform& platform) { platform.machine.storage.opening = 0.01; }},
                    Bound{Wall::frame, "demo", "0-1", 8, Files::none, "fat-tree", [](Platform&) {}}),
    [](const auto& each) {
      std::string name(walls::name_of(each.param.wall));
      std::erase(name, ' ');
      const Files files = each.param.files;
      return name + (files == Files::host ? "_by_host" : files == Files::nodes ? "_by_nodes" : "");
    });

}  // namespace
}  // namespace mars::forecast
