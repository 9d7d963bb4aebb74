#include "host/render/walls/walls_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "host/content/document/text.h"

namespace mars::walls {
namespace {

using document::formatted;

std::string padded(std::string_view word, std::size_t width) {
  return std::string(word) + std::string(width - std::min(width, word.size()), ' ');
}

Wall wall_named(const std::string& name) {
  const auto found = std::ranges::find(kWallWords, name, &WallWords::name);
  if (found == kWallWords.end()) throw Failure("is no wall", name, "");
  return static_cast<Wall>(found - kWallWords.begin());
}

// Why the first wall binds.
std::string rule_of(const Explanation& explanation) {
  const FoundWall* const first = explanation.binding();
  if (first == nullptr) return "";
  if (first->gain <= kNoGain * explanation.seconds)
    return formatted("  no gain is more than %.0f %%, so several walls bind together: the longest alone is first\n",
                     100 * kNoGain);
  const auto differs = [&](const FoundWall& wall) { return wall.gain < explanation.seconds - wall.without; };
  const bool is_uneven = std::ranges::any_of(explanation.walls, differs);
  return std::string("  the wall with the greatest gain binds") +
         (is_uneven ? "; compute gains only what evenly divided work takes\n" : "\n");
}

}  // namespace

std::string line_of(const Explanation& explanation) {
  const FoundWall* const first = explanation.binding();
  if (first == nullptr) return "none";
  std::string line =
      std::string(name_of(first->wall)) + formatted(" %.3g s; without it %.3g s", first->alone, first->without);
  if (explanation.next)
    line += "; then " + std::string(name_of(*explanation.next)) +
            formatted(", without both %.3g s", explanation.without_next);
  return line;
}

std::string table_of(const Explanation& explanation) {
  std::string text = "  wall          alone (s)   without it (s)     gain (s)\n";
  for (const FoundWall& wall : explanation.walls)
    text += "  " + padded(name_of(wall.wall), 12) +
            formatted(" %10.3g %16.3g %12.3g   ", wall.alone, wall.without, wall.gain) +
            std::string(kWallWords[static_cast<std::size_t>(wall.wall)].about) + "\n";
  return text + rule_of(explanation);
}

nlohmann::ordered_json json_of(const Explanation& explanation) {
  nlohmann::ordered_json json = {{"seconds", explanation.seconds}};
  if (const FoundWall* const first = explanation.binding()) json["binding"] = name_of(first->wall);
  if (explanation.next) {
    json["next"] = name_of(*explanation.next);
    json["without_both"] = explanation.without_next;
  }
  json["walls"] = nlohmann::ordered_json::array();
  for (const FoundWall& wall : explanation.walls)
    json["walls"].push_back(
        {{"wall", name_of(wall.wall)}, {"alone", wall.alone}, {"without", wall.without}, {"gain", wall.gain}});
  return json;
}

Explanation explanation_of(const nlohmann::json& json) {
  Explanation explanation{json.at("seconds"), {}, {}, 0};
  for (const nlohmann::json& wall : json.at("walls"))
    explanation.walls.push_back({wall_named(wall.at("wall")), wall.at("alone"), wall.at("without"), wall.at("gain")});
  if (json.contains("next")) {
    explanation.next = wall_named(json.at("next"));
    explanation.without_next = json.at("without_both");
  }
  return explanation;
}

}  // namespace mars::walls
