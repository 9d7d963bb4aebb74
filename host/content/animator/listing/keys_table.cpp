#include "host/content/animator/listing/keys_table.h"

#include <algorithm>
#include <cstdio>

#include "host/content/animator/keys/tracks.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

struct KeyRow {
  std::uint32_t frame;
  std::string part, value, ease;
};

std::string shown_numbers(const document::Json& numbers) {
  std::string text;
  for (const document::Json& number : numbers) text += " " + document::shown(number.get<double>());
  return text;
}

// "tom/head + 0 0 0.2 level", "tom/right-hand place 0 0 0.1 turn 0 90 0"
std::string shown_carried(const document::Json& value) {
  std::string text = value.at("actor").get<std::string>();
  if (value.contains("joint")) text += "/" + value.at("joint").get<std::string>();
  if (value.contains("offset")) text += " +" + shown_numbers(value.at("offset"));
  if (value.value("axes", "") == "joint") text += " along its axes";
  if (value.value("level", false)) text += " level";
  for (const char* own : {"place", "turn"})
    if (value.contains(own)) text += std::string(" ") + own + shown_numbers(value.at(own));
  return text;
}

std::string shown_value(const KeyedPart& part, const document::Json& value) {
  if (value.is_null()) return "nothing";
  if (value.is_object()) return shown_carried(value);
  if (!value.is_array()) return document::shown(value.get<double>());
  std::string text;
  for (std::size_t axis = 0; axis < value.size(); ++axis) {
    if (part.joint && !part.joint->limits[axis].free()) continue;
    if (!text.empty()) text += "  ";
    constexpr const char* axes[] = {"x ", "y ", "z "};
    text +=
        (part.name == "color" || part.name == "cone" ? "" : axes[axis]) + document::shown(value.at(axis).get<double>());
  }
  return text.empty() ? "rests" : text;
}

std::string shown_ease(const Ease& ease) {
  const document::Json json = written(ease);
  if (json.is_string()) return json.get<std::string>();
  std::string curve;
  for (const document::Json& number : json)
    curve += (curve.empty() ? "" : ",") + document::formatted("%.3g", number.get<double>());
  return curve;
}

// "in 0 2 0"
std::string shown_slope(const char* name, const document::Json& slope) {
  if (slope.is_null()) return "";
  return std::string("  ") + name +
         (slope.is_array() ? shown_numbers(slope) : " " + document::shown(slope.get<double>()));
}

// How the part goes on from its key; `key` is the file's.
std::string shown_way(const TrackKey& part, const document::Json& key) {
  const bool plain = part.ease == kLinear && !key.contains("ease");
  const std::string text = plain ? "" : shown_ease(part.ease);
  const std::string slopes = shown_slope("in", part.in) + shown_slope("out", part.out);
  return text.empty() && !slopes.empty() ? slopes.substr(2) : text + slopes;
}

std::vector<KeyRow> rows_of(const Chosen& chosen, FrameRange range) {
  std::vector<KeyRow> rows;
  const auto keys = chosen.thing.json->find("keys");
  if (keys == chosen.thing.json->end()) return rows;
  Tracks tracks = tracks_of(*chosen.thing.json);
  for (const document::Json& key : *keys) {
    const std::uint32_t frame = key.at("frame");
    if (!range.holds(frame)) continue;
    for (const std::string& name : chosen.parts) {
      const auto track = tracks.find(name);
      if (track == tracks.end()) continue;
      if (const TrackKey* found = key_at(track->second, frame))
        rows.push_back(
            {frame, shown_part(name), shown_value(chosen.thing.part(name), found->value), shown_way(*found, key)});
    }
  }
  return rows;
}

// Of all parts at the frame: it is then shown once.
bool same_ease(const std::vector<KeyRow>& rows, std::uint32_t frame) {
  const auto first = std::ranges::lower_bound(rows, frame, {}, &KeyRow::frame);
  const auto end = std::ranges::upper_bound(rows, frame, {}, &KeyRow::frame);
  return std::all_of(first, end, [&](const KeyRow& row) { return row.ease == first->ease; });
}

std::string table_of_keys(const std::vector<KeyRow>& rows) {
  std::size_t parts = 4, values = 5;
  for (const KeyRow& row : rows) {
    parts = std::max(parts, row.part.size());
    values = std::max(values, row.value.size());
  }
  std::string text;
  const auto add = [&](const std::string& frame, const KeyRow& row) {
    std::string line = std::string(7 - std::min<std::size_t>(7, frame.size()), ' ') + frame + "  " + row.part +
                       std::string(parts - row.part.size() + 2, ' ') + row.value;
    if (!row.ease.empty()) line += std::string(values - row.value.size() + 2, ' ') + row.ease;
    text += line + "\n";
  };
  add("frame", {0, "part", "value", "ease"});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool again = i > 0 && rows[i - 1].frame == rows[i].frame;
    KeyRow row = rows[i];
    if (again && same_ease(rows, row.frame)) row.ease.clear();
    add(again ? "" : std::to_string(row.frame), row);
  }
  return text;
}

}  // namespace

std::string keys_table(document::Json& film, const Film& meaning, const Choice& choice, FrameRange range) {
  std::string text;
  std::vector<std::string> without;
  for (const Chosen& chosen : choose(film, meaning, choice)) {
    const std::vector<KeyRow> rows = rows_of(chosen, range);
    if (rows.empty())
      without.push_back(chosen.thing.name);
    else
      text += chosen.thing.name + "\n" + table_of_keys(rows);
  }
  if (!without.empty()) text += "no keys: " + document::joined(without) + "\n";
  return text;
}

}  // namespace mars::animator
