// What a film's frames have to be drawn: some of them are counted, the others estimated from these.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "host/experiments/forecast/counter.h"
#include "host/experiments/forecast/surface_table.h"
#include "host/images/picture_format.h"

namespace mars::forecast {

// Of a frame, or of a node's part of it.
struct FrameTotals {
  wire::UnitCounts made;
  wire::LineCounts drawn;    // on all lines
  double lines = 0;          // with moving parts
  double changed = 0;        // lines of bands in which these are seen (host/images/picture_bands.h)
  wire::UnitCounts casters;  // that are diced once for all these lines
  double kept_points = 0;
  std::vector<wire::BlockStretch> blocks{};  // that moving parts change, if it was counted exactly

  double pixels() const { return drawn.constant.pixels + drawn.moving.pixels; }
  double runs() const { return drawn.constant.runs + drawn.moving.runs; }
};

// `band_lines`: of a band.
FrameTotals totals_of(const wire::FrameCounts& counts, std::uint32_t band_lines);
FrameTotals totals_on(const wire::FrameCounts& counts, std::uint32_t first_line, std::uint32_t last_line,
                      std::uint32_t band_lines);
FrameTotals operator+(FrameTotals a, const FrameTotals& b);
FrameTotals operator*(FrameTotals a, double part);
// Of casters that matter on lines [first_line, last_line), for one of `nodes` that share the dicing for the camera.
wire::UnitCounts casters_on(const wire::FrameCounts& counts, std::uint32_t first_line, std::uint32_t last_line,
                            int nodes);
wire::UnitCounts operator+(wire::UnitCounts a, const wire::UnitCounts& b);
wire::UnitCounts operator*(wire::UnitCounts a, double part);

struct TaskCounts {
  std::size_t keyframe;                 // in FilmCounts::keyframes
  std::vector<FrameTotals> inbetweens;  // of each
};

// Its own surfaces are in the film's table.
struct KeyframeCounts : wire::FrameCounts {
  std::vector<PlacedSurface> placed;
};

struct FilmCounts {
  std::vector<KeyframeCounts> keyframes;  // that were counted
  SurfaceTable surfaces;                  // of all of them
  std::vector<TaskCounts> tasks;
  std::size_t counted = 0;  // frames
  bool is_exact = false;    // all frames, and what they show on all lines

  void add_keyframe(wire::FrameCounts counts);
};

// Of the pieces that `tasks`, which were counted, are cut into (farm::cut_tasks). A piece's keyframe is taken to have
// what its interval's first frame has.
FilmCounts cut_counts(const FilmCounts& counts, std::span<const farm::Task> tasks, std::span<const farm::Task> pieces);

// What counting may take, by the work that it does: so that the same frames are counted every time.
struct Budget {
  double seconds;   // on a processor of today, about
  double part = 1;  // of what it would take to count all frames
};

// Of one task at least, the keyframe and one inbetween are counted.
// For pictures of that format.
FilmCounts count_film(const wire::PackedFilm& film, std::span<const farm::Task> tasks, Counter& counter,
                      const Budget& budget, images::PictureFormat format);

// Of all frames exactly, by that many counters at a time, each of which may take a gigabyte.
using CountProgress = std::function<void(int frames, int of_all)>;
FilmCounts count_exactly(const wire::PackedFilm& film, std::span<const farm::Task> tasks, const MakeCounter& make,
                         images::PictureFormat format, int counters, const CountProgress& progress);

}  // namespace mars::forecast
