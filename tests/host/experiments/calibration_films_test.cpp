#include "host/experiments/calibration_films.h"

#include <gtest/gtest.h>

#include <set>

#include "host/content/animator/reading/read_film.h"
#include "host/content/document/document.h"
#include "host/content/film/compile.h"

namespace mars::experiments {
namespace {

TEST(CalibrationFilms, AreFilms) {
  std::set<std::string> names;
  for (const CalibrationFilm& each : calibration_films()) {
    EXPECT_TRUE(names.insert(each.name).second) << each.name;
    const film::CompiledFilm film =
        film::compile(animator::read_film(document::Document(each.text, each.name).root(), {}), {});
    EXPECT_GE(film.view().settings().frames, 4u);
    EXPECT_GE(film.view().intervals().size(), 1u);
  }
}

}  // namespace
}  // namespace mars::experiments
