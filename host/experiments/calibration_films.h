// Small films that span the kinds of work (node/wire/work.h): rows of bodies, some of which turn, of patches and of
// meshes, coarse and fine, with all models of reflection, few and many lights, one sample a pixel and several, with and
// without shadows.
#pragma once

#include <string>
#include <vector>

namespace mars::experiments {

struct CalibrationFilm {
  std::string name;
  std::string text;                // a film file
  std::vector<std::string> words;  // options of its rendering
};

std::vector<CalibrationFilm> calibration_films();

}  // namespace mars::experiments
