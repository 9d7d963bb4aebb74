#include "host/experiments/measured_run.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "host/child/child.h"

namespace mars::experiments {

nlohmann::json report_of_run(const Renderer& renderer, const std::filesystem::path& film,
                             const std::vector<std::string>& words) {
  const std::filesystem::path report = renderer.folder / "report";
  std::vector<std::string> command{renderer.program.string(), film.string(), "--report", report.string()};
  command.insert(command.end(), words.begin(), words.end());
  child::Child child({{}, command});
  std::string trouble;
  const child::Ending ending =
      child.wait({[](const std::string&) {}, [&](const std::string& line) { trouble = line; }, [] {}});
  child::fail_if_stopped(child);
  if (!ending.well()) throw Failure("a rendering for the calibration failed", film.stem(), trouble);
  std::ifstream file(report);
  return nlohmann::json::parse(file);
}

}  // namespace mars::experiments
