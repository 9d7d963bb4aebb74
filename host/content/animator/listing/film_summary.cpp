#include "host/content/animator/listing/film_summary.h"

#include <algorithm>

#include "host/content/animator/keys/things.h"
#include "host/content/document/text.h"

namespace mars::animator {
namespace {

using document::Json;

// Shown elsewhere, or too long.
constexpr std::string_view kNotShown[] = {"keys", "name", "model", "matrices", "pose", "materials"};

// "frames 0 to 24" of a thing's keys, or what it is beside them.
std::string keys_of(const Json& thing) {
  const auto keys = thing.find("keys");
  if (keys == thing.end() || keys->empty()) return "no keys";
  const auto frame = [](const Json& key) { return std::to_string(key.at("frame").get<std::uint32_t>()); };
  return "keys in frames " + frame(keys->front()) + " to " + frame(keys->back());
}

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_object()) {
    const std::string joint = value.value("joint", "");
    return value.at("actor").get<std::string>() + (joint.empty() ? "" : "/" + joint);
  }
  std::string text = value.dump();
  std::erase(text, '[');
  std::erase(text, ']');
  std::ranges::replace(text, ',', ' ');
  return text;
}

// "place 1 2 0  intensity 2", of what stands beside its keys.
std::string values_of(const Json& thing) {
  std::string text;
  for (const auto& [key, value] : thing.items())
    if (std::ranges::find(kNotShown, key) == std::end(kNotShown)) text += "  " + key + " " + text_of(value);
  return text;
}

struct SummaryRow {
  std::string name, what;
};

std::string summary_table(const std::vector<SummaryRow>& rows) {
  std::size_t widest = 0;
  for (const SummaryRow& row : rows) widest = std::max(widest, row.name.size());
  std::string text;
  for (const SummaryRow& row : rows)
    text += row.name + std::string(widest - row.name.size() + 2, ' ') + row.what + "\n";
  return text;
}

std::string settings_of(const Film& film) {
  return document::formatted("%u frames at %g a second, %u x %u, %u samples", film.frames, film.rate, film.width,
                             film.height, film.samples);
}

}  // namespace

std::string film_summary(Json& film, const Film& meaning) {
  std::vector<SummaryRow> rows = {{"film", settings_of(meaning)}};
  for (const Chosen& chosen : choose(film, meaning, {true, "", {}}))
    if (!chosen.thing.actor)
      rows.push_back({chosen.thing.name, keys_of(*chosen.thing.json) + values_of(*chosen.thing.json)});
  if (!film.contains("lights"))
    rows.push_back({"lights", "none of its own: it is shown with three (light-and-materials.md)"});
  for (const Json& actor : film.at("actors"))
    rows.push_back({actor.at("name"), "model " + actor.at("model").get<std::string>() + ", " +
                                          (actor.contains("matrices") ? "moved by matrices" : keys_of(actor)) +
                                          values_of(actor)});
  return summary_table(rows);
}

}  // namespace mars::animator
