// What `mars info` prints of a report: the run, and what bound it.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace mars::report {

// None: the file is no report.
std::optional<nlohmann::json> read_report(const std::filesystem::path& path);
// Throws Failure where the report is not as MARS writes it, naming `path`.
std::string describe(const nlohmann::json& report, const std::filesystem::path& path);

}  // namespace mars::report
