// What work costs on this machine: small films (calibration_films.h) are rendered by one node, several times, and what
// was counted explains the times of each film's shortest rendering.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/experiments/measured_run.h"
#include "host/experiments/message_costs.h"
#include "host/experiments/spread.h"
#include "node/wire/work.h"

namespace mars::experiments {

struct CalibrationTask {
  Renderer renderer;  // its folder, empty, for films too
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
  std::vector<double> work;              // by kind (node/wire/work.h), seconds a unit
  std::vector<wire::Work> unidentified;  // kinds whose costs times cannot tell from those of others, ascending
  std::vector<PhaseFit> phases;
  double copy_rate = 0;
  std::vector<Spread> spread;  // of forecasts by it, where they were tried
  std::string doubt;           // why it cannot be trusted; "": it can
};

struct Busyness {
  double load = 0;     // programs that want to run at a time, in the last minute
  int processors = 1;  // of the whole machine
  double spread = 0;   // how far repeats of a rendering differ from the least, in the middle; 0.1: by a tenth
};

// Of the machine, now.
Busyness busyness();
// Why what is measured meanwhile cannot be trusted; "" where it can be.
std::string doubt_of(const Busyness& busyness);

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
