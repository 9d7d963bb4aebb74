#include "host/experiments/calibration_films.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

#include "host/content/animator/reading/read_film.h"
#include "host/content/document/document.h"
#include "host/content/film/compile.h"

namespace mars::experiments {
namespace {

TEST(CalibrationFilms, AreFilms) {
  std::set<std::string> names;
  std::set<std::pair<bool, wire::Blend>> bent;  // nets or not
  for (const CalibrationFilm& each : calibration_films()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    const film::CompiledFilm film =
        film::compile(animator::read_film(document::Document(each.text, each.name).root(), {}), {});
    EXPECT_GE(film.view().settings().frames, 4u);
    EXPECT_GE(film.view().intervals().size(), 1u);
    for (const wire::Segment& segment : film.view().segments())
      if (segment.bone_count > 0) bent.emplace(film.view().shape(segment.shape).patch_count > 0, segment.blend);
  }
  EXPECT_EQ(bent.size(), 4u) << "skins of meshes and nets, by both blends, have costs too";
}

}  // namespace
}  // namespace mars::experiments
