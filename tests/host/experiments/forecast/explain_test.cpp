#include "host/experiments/forecast/explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

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

TEST_P(Explained, AsByAblation) {
  const Bound& one = GetParam();
  SimulatedFilm film = this->film();
  const walls::Explanation explanation = film.explain(one.nodes, 1);
  const double whole = film.render(one.nodes, 1).total_seconds;
  std::cout << walls::line_of(explanation) << "\n" << walls::table_of(explanation) << whole << " s simulated\n";
  for (const walls::FoundWall& found : explanation.walls) {
    SimulatedFilm ablated = film;
    ablated.set_platform(
        without(film.platform(), {found.wall}, one.files == Files::nodes ? Writers::nodes : Writers::host));
    const double seconds = ablated.render(one.nodes, 1).total_seconds;
    std::cout << walls::name_of(found.wall) << " " << explanation.seconds - found.without << " " << whole - seconds
              << "\n";
  }
}

void as_it_is(experiments::Platform&) {}

INSTANTIATE_TEST_SUITE_P(Walls, Explained,
                         testing::Values(Bound{Wall::compute, "demo", "0-7", 2, Files::none, "fat-tree", as_it_is},
                                         Bound{Wall::imbalance, "s1", "0-0", 16, Files::none, "fat-tree", as_it_is},
                                         Bound{Wall::sum, "s1", "0-0", 16, Files::none, "ethernet", as_it_is},
                                         Bound{Wall::exchange, "bodies", "5-5", 16, Files::none, "ethernet", as_it_is},
                                         Bound{Wall::still, "s3", "0-11", 16, Files::none, "ethernet", as_it_is},
                                         Bound{Wall::bands, "visit", "100-109", 8, Files::nodes, "ethernet", as_it_is},
                                         Bound{Wall::host, "visit", "100-109", 8, Files::host, "fat-tree", as_it_is},
                                         Bound{Wall::encoder, "visit", "100-109", 8, Files::host, "fat-tree", as_it_is},
                                         Bound{Wall::storage, "visit", "100-109", 8, Files::nodes, "fat-tree",
                                               [](experiments::Platform& platform) {
                                                 platform.machine.storage.opening = 0.01;
                                               }},
                                         Bound{Wall::frame, "demo", "0-1", 8, Files::none, "fat-tree", as_it_is}),
                         [](const auto& each) {
                           std::string name(walls::name_of(each.param.wall));
                           std::erase(name, ' ');
                           return name;
                         });

}  // namespace
}  // namespace mars::forecast
