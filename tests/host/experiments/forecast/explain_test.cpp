#include "host/experiments/forecast/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "host/render/report/replay.h"
#include "host/render/walls/walls_text.h"
#include "tests/host/experiments/forecast/simulated_film.h"

namespace mars::forecast {
namespace {

using walls::Wall;
using walls::Walls;

constexpr double kWithin = 0.1;

// A rendering, on a platform that is changed so that the wall binds.
struct Bound {
  Wall wall;
  const char* film;
  const char* frames;
  int nodes;
  Files files;
  const char* platform;
  void (*change)(experiments::Platform&);
};

void PrintTo(const Bound& one, std::ostream* out) { *out << walls::name_of(one.wall); }

class Explained : public testing::TestWithParam<Bound> {
 protected:
  SimulatedFilm film() const {
    const Bound& one = GetParam();
    SimulatedFilm film(one.film, one.frames, one.platform, one.files);
    film.set_platform(platform());
    return film;
  }
  experiments::Platform platform() const {
    const Bound& one = GetParam();
    experiments::Platform platform = SimulatedFilm(one.film, one.frames, one.platform, one.files).platform();
    one.change(platform);
    return platform;
  }
};


// Seconds that each node worked for frames of a kind.
std::vector<double> work_of(const farm::FarmReport& report, wire::FrameKind kind) {
  std::vector<double> seconds(report.nodes.size());
  for (const wire::Strip& strip : report.strips)
    if (strip.last == 1 && strip.kind == kind)
      seconds[static_cast<std::size_t>(strip.node)] += strip.times.dice + strip.times.fill + strip.times.map + strip.times.scanline + strip.times.shadow;
  return seconds;
}

experiments::Platform without_unevenness(experiments::Platform platform, Wall wall, const farm::FarmReport& report) {
  std::vector<double> seconds = work_of(report, wall == Wall::frame ? wire::FrameKind::inbetween : wire::FrameKind::keyframe);
  const double mean = std::reduce(seconds.begin(), seconds.end()) / static_cast<double>(seconds.size());
  for (double& own : seconds) own = own <= 0 ? 1 : wall == Wall::frame ? std::min(1.0, mean / own) : mean / own;
  platform.machine.slowness = [seconds](int computer, double) { return computer < (int)seconds.size() ? seconds[static_cast<std::size_t>(computer)] : 1.0; };
  return platform;
}

TEST_P(Explained, AsByAblation) {
  const Bound& one = GetParam();
  const SimulatedFilm film = this->film();
  const walls::Explanation explanation = film.explain(one.nodes, 1);
  const farm::FarmReport report = film.render(one.nodes, 1);
  const walls::Explanation recorded = report::explain(report);
  const double whole = report.total_seconds;
  printf("%s\n%s\n%.5g simulated %.5g replayed\n", walls::line_of(explanation).c_str(), walls::line_of(recorded).c_str(), whole, report::Replay(report).seconds({}));
  for (const walls::FoundWall& found : explanation.walls) {
    SimulatedFilm ablated = film;
    ablated.set_platform(without(film.platform(), {found.wall}, one.files == Files::nodes ? Writers::nodes : Writers::host));
    if (found.wall == Wall::frame || found.wall == Wall::imbalance) ablated.set_platform(without_unevenness(film.platform(), found.wall, report));
    const double seconds = ablated.render(one.nodes, 1).total_seconds;
    double rec = 0;
    for (auto& r : recorded.walls) if (r.wall == found.wall) rec = recorded.seconds - r.without;
    printf("%12s alone %5.1f forecast %6.2f %%  recorded %6.2f  simulated %6.2f\n", std::string(walls::name_of(found.wall)).c_str(), 100*found.alone/whole, 100*(explanation.seconds - found.without)/explanation.seconds, 100*rec/recorded.seconds,
        100*(whole - seconds)/whole);
  }
}

void as_it_is(experiments::Platform&) {}
void scale(experiments::Platform& p, std::size_t from, std::size_t to, double by) { for (auto i = from; i < to; ++i) p.machine.work[i] *= by; }

INSTANTIATE_TEST_SUITE_P(
    Walls, Explained,
    testing::Values(Bound{Wall::compute, "demo", "0-7", 2, Files::none, "fat-tree", as_it_is},
                    Bound{Wall::imbalance, "s3s", "0-0", 32, Files::none, "fat-tree", [](experiments::Platform& p) { scale(p, 0, (size_t)wire::Work::casting_light, 0); }},
                    Bound{Wall::imbalance, "s3s", "0-0", 64, Files::none, "fat-tree", [](experiments::Platform& p) { scale(p, 0, (size_t)wire::Work::casting_light, 0);scale(p, (size_t)wire::Work::casting_light,wire::kNodeKinds, 10); }},
                    Bound{Wall::imbalance, "s1", "0-0", 32, Files::none, "fat-tree", [](experiments::Platform& p) { scale(p, 0, wire::kNodeKinds, 0); p.machine.work[(size_t)wire::Work::line]=1e-4; }},
                    Bound{Wall::sum, "s1", "0-0", 64, Files::none, "fat-tree", [](experiments::Platform& p) { scale(p, 0, wire::kNodeKinds, 0.05); p.machine.network.latency = 1e-3; }},
                    Bound{Wall::exchange, "bodies", "5-5", 16, Files::none, "ethernet", [](experiments::Platform& p) { p.machine.network.byte *= 5; p.machine.network.host_byte=1e-12; }},
                    Bound{Wall::still, "caterpillar", "0-11", 16, Files::none, "ethernet", [](experiments::Platform& p) { scale(p, 0, wire::kNodeKinds, 0.2);p.machine.network.host_byte=1e-12;}},
                    Bound{Wall::still, "stones", "0-11", 16, Files::none, "ethernet", [](experiments::Platform& p) { scale(p, 0, wire::kNodeKinds, 0.2);p.machine.network.host_byte=1e-12;}},
                    Bound{Wall::still, "stones", "0-11", 4, Files::none, "ethernet", [](experiments::Platform& p) { scale(p, 0, wire::kNodeKinds, 0.2);p.machine.network.host_byte=1e-12;}},
                    Bound{Wall::still, "teapot", "0-11", 4, Files::none, "ethernet", [](experiments::Platform& p) { scale(p, 0, wire::kNodeKinds, 0.1);p.machine.network.host_byte=1e-12;}},
                    Bound{Wall::bands, "visit", "100-109", 8, Files::nodes, "ethernet", [](experiments::Platform& p) { p.file_part=1; }},
                    Bound{Wall::bands, "demo", "0-7", 8, Files::nodes, "ethernet", [](experiments::Platform& p) { p.file_part=1;p.machine.storage={}; }},
                    Bound{Wall::bands, "demo", "0-7", 4, Files::nodes, "ethernet", [](experiments::Platform& p) { p.file_part=1;p.machine.storage={}; p.machine.network.byte *=4; }},
                    Bound{Wall::host, "visit", "100-109", 8, Files::host, "fat-tree", [](experiments::Platform& p) { scale(p, wire::kNodeKinds, (size_t)wire::Work::file, 20); }},
                    Bound{Wall::encoder, "visit", "100-109", 8, Files::host, "fat-tree", [](experiments::Platform& p) { p.machine.host_processors=1; scale(p, (size_t)wire::Work::file,  p.machine.work.size(), 5);}},
                    Bound{Wall::encoder, "visit", "100-109", 8, Files::nodes, "fat-tree", [](experiments::Platform& p) { scale(p, (size_t)wire::Work::file,  p.machine.work.size(), 50);}},
                    Bound{Wall::storage, "visit", "100-109", 8, Files::nodes, "fat-tree",
                          [](experiments::Platform& platform) { platform.machine.storage.opening = 0.01; }},
                    Bound{Wall::frame, "demo", "0-1", 8, Files::none, "fat-tree", as_it_is}),
    [](const auto& each) {
      std::string name(walls::name_of(each.param.wall));
      std::erase(name, ' ');
      return name + std::to_string(each.index);
    });

}  // namespace
}  // namespace mars::forecast
