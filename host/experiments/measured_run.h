// A rendering by threads, in a process of its own, to be measured.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace mars::experiments {

struct Renderer {
  std::filesystem::path program;  // mars-threads
  std::filesystem::path folder;   // for its reports
};

// The report of a rendering of a film file, with more words of a command line. Throws Failure where it fails.
nlohmann::json report_of_run(const Renderer& renderer, const std::filesystem::path& film,
                             const std::vector<std::string>& words);

}  // namespace mars::experiments
