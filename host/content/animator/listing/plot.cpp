#include "host/content/animator/listing/plot.h"

#include <algorithm>
#include <array>
#include <limits>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/tracks.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

constexpr std::size_t kMostPanels = 12;
constexpr std::size_t kWidth = 1000, kPanelHeight = 230, kMargin = 40;  // pixels
constexpr std::array kColors = {"#c0392b", "#1e8449", "#2e5fa3"};       // x, y, z

// A part of a thing, as it is drawn.
struct Panel {
  std::string title;
  const KeyedPart* part;
  const Track* track;
  double lowest = std::numeric_limits<double>::max(), highest = -std::numeric_limits<double>::max();
};

int axes_of(const document::Json& value) { return value.is_array() ? static_cast<int>(value.size()) : 1; }

double number_of(const document::Json& value, int axis) {
  return value.is_array() ? value.at(axis).get<double>() : value.get<double>();
}

bool drawn(const KeyedPart& part, const document::Json& value, int axis) {
  if (axis >= axes_of(value)) return false;
  return !part.joint || part.joint->limits[axis].free();
}

// In gnuplot's double quotes, with nothing that its enhanced text would take as a command.
std::string gnuplot_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' || c == '\\' ? std::string("'") : std::string(1, c);
  return quoted + "\"";
}

std::string row_of(std::uint32_t frame, const document::Json& value) {
  std::string row = std::to_string(frame);
  for (int axis = 0; axis < axes_of(value); ++axis) row += " " + document::shown(number_of(value, axis));
  return row + "\n";
}

// The data of a panel, number `i`: $curve_i for every frame, or for as many as a picture can show, $keys_i.
std::string data_of(Panel& panel, std::size_t i, std::uint32_t frames) {
  std::string text = "$curve" + std::to_string(i) + " << END\n";
  constexpr std::uint32_t kMost = 5000;
  for (std::uint32_t frame = 0; frame < frames; frame += 1 + frames / kMost) {
    const document::Json value = panel.part->value_at(frame);
    text += row_of(frame, value);
    for (int axis = 0; axis < 3; ++axis) {
      if (!drawn(*panel.part, value, axis)) continue;
      panel.lowest = std::min(panel.lowest, number_of(value, axis));
      panel.highest = std::max(panel.highest, number_of(value, axis));
    }
  }
  text += "END\n$keys" + std::to_string(i) + " << END\n";
  for (const TrackKey& key : *panel.track) text += row_of(key.frame, panel.part->value_at(key.frame));
  return text + "END\n";
}

// Limits as far as they are in sight; the picture is as high as the curves, and a little more.
std::string bands_of(const Panel& panel, const document::Json& value) {
  std::string text;
  const bool angles = panel.part->joint || panel.part->name == "turn";
  const double margin =
      std::max(0.1 * (panel.highest - panel.lowest), angles ? 10.0 : 1e-3 + 0.05 * std::abs(panel.highest));
  const double low = panel.lowest - margin, high = panel.highest + margin;
  text += "set yrange [" + document::shown(low) + ":" + document::shown(high) + "]\n";
  for (int axis = 0; axis < 3; ++axis) {
    if (!panel.part->joint || !drawn(*panel.part, value, axis)) continue;
    const modeler::Limits& limits = panel.part->joint->limits[axis];
    const double bottom = std::clamp(limits.lower, low, high), top = std::clamp(limits.upper, low, high);
    const std::string color = kColors[axis];
    text += "set object rectangle from graph 0, first " + document::shown(bottom) + " to graph 1, first " +
            document::shown(top) + " fillcolor rgb \"" + color +
            "\" fillstyle transparent solid 0.07 noborder behind\n";
    for (const double limit : {limits.lower, limits.upper})
      if (limit > low && limit < high)
        text += "set arrow from graph 0, first " + document::shown(limit) + " to graph 1, first " +
                document::shown(limit) + " nohead dashtype 2 linecolor rgb \"" + color + "\"\n";
  }
  return text;
}

std::string panel_text(const Panel& panel, std::size_t i) {
  const document::Json value = panel.part->value_at(0);
  std::string text =
      "unset object\nunset arrow\nset title " + gnuplot_text(panel.title) + "\n" + bands_of(panel, value);
  text += panel.part->joint || panel.part->name == "turn" ? "set ylabel \"degrees\"\n" : "unset ylabel\n";
  std::string plots;
  const std::string number = std::to_string(i);
  for (int axis = 0; axis < 3; ++axis) {
    if (!drawn(*panel.part, value, axis)) continue;
    const std::string column = std::to_string(axis + 2), color = std::string("linecolor rgb \"") + kColors[axis] + "\"";
    const std::string name = value.is_array() ? std::string(1, "xyz"[axis]) : panel.part->name;
    plots += (plots.empty() ? "plot " : ", ") + ("$curve" + number) + " using 1:" + column +
             " with lines linewidth 2 " + color + " title \"" + name + "\", $keys" + number + " using 1:" + column +
             " with points pointtype 7 pointsize 1 " + color + " notitle";
  }
  return text + plots + "\n";
}

}  // namespace

std::string plot_script(document::Json& film, const Film& meaning, const Choice& choice, PlotAs as) {
  const std::vector<Chosen> chosen = choose(film, meaning, choice);
  std::vector<Tracks> tracks;
  for (const Chosen& one : chosen) tracks.push_back(tracks_of(*one.thing.json));
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (const std::string& name : chosen[i].parts) {
      const auto track = tracks[i].find(name);
      const KeyedPart& part = chosen[i].thing.part(name);
      if (track == tracks[i].end() || (part.joint && part.joint->freedoms() == 0) || part.value_at(0).is_null())
        continue;
      panels.push_back({chosen[i].thing.name + ": " + shown_part(name), &part, &track->second});
    }
  const std::string whose = choice.all ? meaning.source : chosen[0].thing.name;
  if (panels.empty()) throw Failure("has no keys to draw", whose, "`mars animate FILM list` shows what is keyed");
  if (panels.size() > kMostPanels)
    throw Failure("has " + std::to_string(panels.size()) + " keyed parts, too many for one picture", whose,
                  "name an actor and at most " + std::to_string(kMostPanels) + " of its parts");
  const std::string size = std::to_string(kWidth) + "," + std::to_string(kMargin + kPanelHeight * panels.size());
  std::string text = std::string("set terminal ") + (as == PlotAs::png ? "pngcairo" : "svg") + " size " + size +
                     " noenhanced background rgb \"white\"\n";
  for (std::size_t i = 0; i < panels.size(); ++i) text += data_of(panels[i], i, meaning.frames);
  text +=
      "set multiplot layout " + std::to_string(panels.size()) +
      ",1\nset grid linecolor rgb \"#dddddd\"\nset key outside right\nset lmargin 10\nset rmargin 12\nset xrange [0:" +
      std::to_string(std::max(meaning.frames - 1, 1u)) + "]\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (i + 1 == panels.size()) text += "set xlabel \"frame\"\n";
    text += panel_text(panels[i], i);
  }
  return text + "unset multiplot\n";
}

}  // namespace mars::animator
