// An explanation in words, and in JSON for programs and reports.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/render/walls/walls.h"

namespace mars::walls {

// "storage 0.33 s, without it 0.21 s; then encoder, without it 0.1 s".
std::string line_of(const Explanation& explanation);
// A line for each wall, the one that binds first.
std::string table_of(const Explanation& explanation);

nlohmann::ordered_json json_of(const Explanation& explanation);
// Throws nlohmann::json::exception, or Failure where it names no wall.
Explanation explanation_of(const nlohmann::json& json);

}  // namespace mars::walls
