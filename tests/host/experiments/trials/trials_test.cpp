#include "host/experiments/trials/trials.h"

#include <gtest/gtest.h>

#include <set>

#include "host/content/animator/reading/read_film.h"
#include "host/content/document/document.h"
#include "host/content/document/whole_file.h"
#include "host/content/film/compile.h"
#include "host/programs/node_counter.h"
#include "tests/temporary_folder.h"

namespace mars::trials {
namespace {

namespace fs = std::filesystem;

TEST(TrialFilms, AreFilmsOfAllKinds) {
  std::set<std::uint32_t> samples;
  std::size_t intervals = 0;
  for (const TrialFilm& each : trial_films(39)) {
    const film::CompiledFilm film =
        film::compile(animator::read_film(document::Document(each.text, each.name).root(), {}), {});
    samples.insert(film.view().settings().samples);
    intervals += film.view().intervals().size();
  }
  EXPECT_EQ(samples, (std::set<std::uint32_t>{1, 2, 4, 8, 16}));
  EXPECT_GT(intervals, 2 * 39u);
}

TEST(TrialFilms, AreTheSameEveryTime) { EXPECT_EQ(trial_films(3).back().text, trial_films(4)[2].text); }

TEST(Trials, AreForOneTwoAndAllProcessors) {
  EXPECT_EQ(tried_nodes(1), (std::vector{1}));
  EXPECT_EQ(tried_nodes(2), (std::vector{1, 2}));
  EXPECT_EQ(tried_nodes(12), (std::vector{1, 2, 12}));
}

// Its renderer is planted: it writes a report of the seconds that it is given, one after the other.
class PlantedRenderer {
 public:
  explicit PlantedRenderer(const std::string& seconds) {
    const fs::path program = folder_ / "renderer", count = folder_ / "count";
    document::write_whole_file(program,
                               "#!/bin/sh\n"
                               "set -- \"$3\" " +
                                   seconds +
                                   "\n"  // FILM --report REPORT ...
                                   "report=$1; shift\n"
                                   "n=$(cat " +
                                   count.string() +
                                   " 2>/dev/null || echo 0)\n"
                                   "echo $((n + 1)) > " +
                                   count.string() +
                                   "\n"
                                   "shift $((n % $#))\n"
                                   "echo \"{\\\"total_seconds\\\": $1}\" > \"$report\"\n");
    fs::permissions(program, fs::perms::owner_all);
  }

  std::vector<experiments::Spread> spread() const {
    const std::string cube = R"({"frames": 4, "size": [16, 9], "models": {"cube": {"joints": [{"name": "cube",
      "segment": {"shape": "box"}}]}}, "actors": [{"name": "a", "model": "cube"}],
      "camera": {"eye": [0, -5, 1], "at": [0, 0, 0]}})";
    const std::vector<TrialFilm> films(19, {"cube", cube});
    experiments::Platform platform =
        experiments::like_here("reference", std::string(MARS_SOURCE_DIR) + "/cluster/platforms", 2);
    return try_forecasts({films, {folder_ / "renderer", folder_.path()}, platform, programs::make_node_counter, {}});
  }

 private:
  test::TemporaryFolder folder_;
};

double width(const experiments::Spread& spread) { return spread.high / spread.low; }

TEST(Trials, HaveNoSpreadWhereAllRenderingsTakeAsLong) {
  const std::vector<experiments::Spread> spread = PlantedRenderer("0.5").spread();
  ASSERT_EQ(spread.size(), 4u) << "1 and 2 nodes, without and with files";
  for (const experiments::Spread& each : spread) EXPECT_DOUBLE_EQ(width(each), 1);
  EXPECT_EQ(spread[1].nodes, 2);
  EXPECT_TRUE(spread[3].files);
  EXPECT_GT(spread[0].middle, 1) << "a tiny film never takes half a second";
}

TEST(Trials, HaveTheSpreadOfNoisyRenderings) {
  for (const experiments::Spread& each : PlantedRenderer("0.5 0.5 0.5 0.4 0.7").spread())
    EXPECT_NEAR(width(each), 0.7 / 0.4, 1e-9);
}

}  // namespace
}  // namespace mars::trials
