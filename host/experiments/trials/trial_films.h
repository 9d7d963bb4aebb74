// Films on which forecasts are tried: mixed, as people's are, where calibration films (calibration_films.h) show one
// kind of work each. Random, and the same every time.
#pragma once

#include <string>
#include <vector>

namespace mars::trials {

struct TrialFilm {
  std::string name;
  std::string text;  // a film file
};

std::vector<TrialFilm> trial_films(int count);

}  // namespace mars::trials
