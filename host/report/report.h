// `--report FILE`: what a rendering measured, as one JSON object, described key by key in docs/report.md.
#pragma once

#include <filesystem>
#include <string>

#include "host/farm/farm.h"

namespace mars::host {

struct ReportHeader {
  std::string film;
  std::string backend;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

// Written whole or not at all; throws Failure naming the file.
void write_report(const std::filesystem::path& file, const ReportHeader& header, const FarmReport& report);

}  // namespace mars::host
