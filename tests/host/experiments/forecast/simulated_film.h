// A film of examples/, or one whose name is a path without .json, counted and forecast, and rendered on simulated
// machines to compare.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "hal/simulated/world.h"
#include "host/content/film/compile.h"
#include "host/experiments/forecast/explain.h"
#include "host/experiments/forecast/forecast.h"
#include "host/render/farm/farm.h"

namespace mars::forecast {

// Who writes files, which are counted.
enum class Files { none, host, nodes };

class SimulatedFilm {
 public:
  // Small pictures, of some frames; with files of several bands. `light` changes lights that
  // cast shadows: a patch of JSON (RFC 7396).
  SimulatedFilm(const std::string& name, const std::string& frames, const std::string& platform,
                Files files = Files::none, const std::string& light = "");

  wire::PackedFilm view() const { return film_.view(); }
  const std::vector<farm::Task>& tasks() const { return tasks_; }
  const FilmCounts& counts() const { return counts_; }
  FilmCounts count_exactly() const;
  const experiments::Platform& platform() const { return platform_; }

  // Of both forecasts and renderings from now on.
  void set_platform(experiments::Platform platform) { platform_ = std::move(platform); }
  void set_exchange(wire::Exchange exchange) { exchange_ = exchange; }

  // `sharers`, `most_frames`: as in Setting.
  Forecast forecast(int nodes, std::uint32_t groups, std::int32_t sharers = 0, std::uint32_t most_frames = 0) const;
  // The same from all frames, counted exactly.
  Rehearsed counted(int nodes, std::uint32_t groups) const;
  // All nodes of a group draw keyframes, one an inbetween.
  farm::FarmReport render(int nodes, std::uint32_t groups) const;
  // As the forecast says.
  farm::FarmReport render(const Forecast& forecast) const;
  // Of the forecast in which all nodes of a group contribute to keyframes, as in render().
  walls::Explanation explain(int nodes, std::uint32_t groups) const;

 private:
  farm::Plan plan(int nodes, std::uint32_t groups) const;
  Setting setting(const wire::PackedFilm& film) const;
  farm::FarmReport render(const farm::Plan& plan, int nodes, simulated::World& world) const;

  const Files files_;
  film::CompiledFilm film_;
  experiments::Platform platform_;
  wire::Exchange exchange_ = wire::Exchange::send;
  std::vector<farm::Task> tasks_;
  FilmCounts counts_;
  mutable std::optional<FilmCounts> exact_;  // once they were needed
};

}  // namespace mars::forecast
