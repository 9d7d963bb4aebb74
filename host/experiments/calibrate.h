// What work costs on this machine: small films (calibration_films.h) are rendered by one node, several times, and what
// was counted explains the times of each film's shortest rendering.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "host/experiments/message_costs.h"

namespace mars::experiments {

struct CalibrationTask {
  std::filesystem::path renderer;  // the program mars-threads
  std::filesystem::path folder;    // empty, for films and reports
  int repeats = 4;
  std::function<void(int done, int all)> progress;
};

// How well the costs explain the times of one phase.
struct PhaseFit {
  std::string phase;
  std::size_t measured;  // frames, or renderings
  double median_error;
  double high_error;  // of nine of ten frames
};

struct Calibration {
  std::vector<double> work;  // by kind (node/wire/work.h), seconds a unit
  std::vector<PhaseFit> phases;
  double spread = 0;  // how far repeats differ from the least, in the middle; 0.1: by a tenth
  double copy_rate = 0;
};

// A machine whose repeats differ by more is too busy to be measured.
inline constexpr double kMostSpread = 0.2;

// Throws Failure where a rendering fails.
Calibration calibrate(const CalibrationTask& task);

// Where and when it was measured.
struct CalibratedMachine {
  std::string name;  // of the platform
  std::string about;
  int processors;
  std::uint64_t memory;  // bytes a node may use
};

// As a platform file.
std::string platform_text(const Calibration& calibration, const MessageCosts& messages,
                          const CalibratedMachine& machine);

// For people: costs by kind, then residuals by phase.
std::string table_text(const Calibration& calibration);

}  // namespace mars::experiments
