#include "host/experiments/forecast/film_counts.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <mutex>
#include <optional>
#include <utility>

#include "host/images/picture_bands.h"
#include "host/render/farm/rough_work.h"

namespace mars::forecast {
namespace {

// Seconds that counting takes, about.
double counting_seconds(const FrameTotals& frame) {
  using wire::Work;
  const wire::UnitCounts& made = frame.made;
  return 5e-4 + (made[Work::patch] + made[Work::meshlet]) * 1e-6 + made[Work::vertex] * 8e-9 +
         made[Work::mesh_vertex] * 4e-9 + made[Work::net_term] * 1e-9 + made[Work::skin_weight] * 5e-10 +
         made[Work::dual_weight] * 2e-9 + made[Work::triangle_tested] * 5e-9 + made[Work::triangle] * 2e-8 +
         made[Work::edge_box_made] * 4e-9 + frame.casters[Work::caster] * 2e-6 +
         frame.casters[Work::diced_vertex] * 8e-9;
}

// Inbetweens of a task that were counted.
struct Known {
  std::size_t place;  // among the task's inbetweens
  FrameTotals totals;
};

// At `place`, from the known ones on either side of it.
FrameTotals between(const std::vector<Known>& known, double place) {
  const auto after = std::ranges::find_if(known, [&](const Known& k) { return static_cast<double>(k.place) >= place; });
  if (after == known.begin()) return after->totals;
  if (after == known.end()) return known.back().totals;
  const Known& before = *(after - 1);
  const double part = (place - static_cast<double>(before.place)) / static_cast<double>(after->place - before.place);
  return before.totals * (1 - part) + after->totals * part;
}

class FilmCount {
 public:
  FilmCount(const wire::PackedFilm& film, std::span<const farm::Task> tasks, Counter& counter, std::uint32_t band_lines)
      : film_(film), tasks_(tasks), counter_(counter), band_lines_(band_lines), known_(tasks.size()) {}

  FilmCounts count(const Budget& budget);

 private:
  void count_first();
  static std::size_t inbetweens_of(const farm::Task& task) { return task.frames.size() - 1; }
  void count_keyframe(std::size_t task);
  void count_inbetween(std::size_t task, std::size_t place);
  void count_inbetweens(std::size_t task, std::size_t count);
  void estimate(std::size_t task);
  double moving_patches(const farm::Task& task) const;

  const wire::PackedFilm& film_;
  const std::span<const farm::Task> tasks_;
  Counter& counter_;
  const std::uint32_t band_lines_;
  FilmCounts counts_;
  std::size_t first_ = 0;        // task that was counted first
  double keyframe_seconds_ = 0;  // that counting one takes
  double inbetween_seconds_ = 0;
  std::vector<std::size_t> counted_tasks_;  // by keyframe
  std::vector<std::vector<Known>> known_;   // by task, in order
};

FilmCounts FilmCount::count(const Budget& budget) {
  count_first();
  const auto at_least_one = [](double count) { return static_cast<std::size_t>(std::max(1.0, std::floor(count))); };
  const auto tasks = static_cast<double>(tasks_.size());
  double all_inbetweens = 0, inbetweens = 0;  // inbetweens: of the chosen tasks
  for (const farm::Task& task : tasks_) all_inbetweens += static_cast<double>(inbetweens_of(task));
  const double whole = tasks * keyframe_seconds_ + all_inbetweens * inbetween_seconds_;
  const double part = std::min(budget.part, budget.seconds / whole);
  // Intervals differ more than their frames: for one frame of each there is half of what may be counted.
  const double keyframes = std::min(tasks, std::max(tasks * part, part * whole / 2 / keyframe_seconds_));
  const std::size_t count = at_least_one(keyframes);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back((first_ + i * tasks_.size() / count) % tasks_.size());
  for (const std::size_t task : chosen) inbetweens += static_cast<double>(inbetweens_of(tasks_[task]));
  const double of_each = (part * whole - keyframes * keyframe_seconds_) / inbetween_seconds_ / inbetweens;
  for (const std::size_t task : chosen) {
    if (task != first_) count_keyframe(task);
    const std::size_t all = inbetweens_of(tasks_[task]);
    if (all > 0) count_inbetweens(task, std::min(all, at_least_one(static_cast<double>(all) * of_each + 0.5)));
  }
  for (std::size_t task = 0; task < tasks_.size(); ++task) estimate(task);
  return std::move(counts_);
}

// The first task with inbetweens tells what counting takes.
void FilmCount::count_first() {
  while (first_ + 1 < tasks_.size() && inbetweens_of(tasks_[first_]) == 0) ++first_;
  if (inbetweens_of(tasks_[first_]) == 0) first_ = 0;
  count_keyframe(first_);
  keyframe_seconds_ = inbetween_seconds_ = counting_seconds(totals_of(counts_.keyframes.front(), band_lines_));
  const std::size_t all = inbetweens_of(tasks_[first_]);
  if (all == 0) return;
  count_inbetween(first_, all / 2);
  inbetween_seconds_ = counting_seconds(known_[first_].front().totals);
}

void FilmCount::count_keyframe(std::size_t task) {
  counts_.add_keyframe(counter_.count_keyframe(tasks_[task]));
  counted_tasks_.push_back(task);
  ++counts_.counted;
}

void FilmCount::count_inbetween(std::size_t task, std::size_t place) {
  known_[task].push_back({place, totals_of(counter_.count_inbetween(tasks_[task].frames[place + 1]), band_lines_)});
  ++counts_.counted;
}

// The first, the last and some between, or the one in the middle.
void FilmCount::count_inbetweens(std::size_t task, std::size_t count) {
  const std::size_t all = inbetweens_of(tasks_[task]);
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i) places.push_back(count == 1 ? all / 2 : i * (all - 1) / (count - 1));
  for (const std::size_t place : places)
    if (std::ranges::find(known_[task], place, &Known::place) == known_[task].end()) count_inbetween(task, place);
  std::ranges::sort(known_[task], {}, &Known::place);
}

double FilmCount::moving_patches(const farm::Task& task) const {
  return 1 + farm::moving_patches(film_, film_.intervals()[task.interval]);
}

// As in the nearest task whose frames of this kind were counted; of inbetweens as much as its moving parts are.
void FilmCount::estimate(std::size_t task) {
  const auto nearest = [&](const auto& is_known) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < counted_tasks_.size(); ++i) {
      const auto away = [&](std::size_t k) {
        const std::size_t other = counted_tasks_[k];
        return is_known(other) ? std::max(task, other) - std::min(task, other) : tasks_.size();
      };
      if (away(i) < away(best)) best = i;
    }
    return best;
  };
  TaskCounts counts{nearest([](std::size_t) { return true; }), {}};
  const std::size_t like = counted_tasks_[nearest([&](std::size_t other) { return !known_[other].empty(); })];
  const std::size_t all = inbetweens_of(tasks_[task]), there = inbetweens_of(tasks_[like]);
  const double scale = moving_patches(tasks_[task]) / moving_patches(tasks_[like]);
  for (std::size_t i = 0; i < all; ++i) {
    const double place = static_cast<double>(i) * static_cast<double>(there) / static_cast<double>(all);
    counts.inbetweens.push_back(between(known_[like], place) * scale);
  }
  counts_.tasks.push_back(std::move(counts));
}

// Each counter takes the next task; what it counted is added in the order of tasks.
class ExactCount {
 public:
  ExactCount(std::span<const farm::Task> tasks, std::uint32_t band_lines, const CountProgress& progress)
      : tasks_(tasks), band_lines_(band_lines), progress_(progress), counted_(tasks.size()) {
    for (const farm::Task& task : tasks) frames_ += static_cast<int>(task.frames.size());
  }

  void run(Counter& counter) try {
    while (const auto task = next()) count(*task, counter);
  } catch (...) {
    next_ = tasks_.size();  // others need not go on
    throw;
  }

  FilmCounts take() {
    counts_.is_exact = true;
    return std::move(counts_);
  }

 private:
  struct Counted {
    std::optional<wire::FrameCounts> keyframe;
    std::vector<FrameTotals> inbetweens;
  };

  std::optional<std::size_t> next() {
    const std::size_t task = next_++;
    return task < tasks_.size() ? std::optional(task) : std::nullopt;
  }

  void count(std::size_t number, Counter& counter) {
    const farm::Task& task = tasks_[number];
    Counted counted;
    counted.keyframe = counter.count_keyframe(task);
    note_frame();
    for (const std::uint32_t frame : std::span(task.frames).subspan(1)) {
      counted.inbetweens.push_back(totals_of(counter.count_inbetween(frame), band_lines_));
      note_frame();
    }
    add(number, std::move(counted));
  }

  void note_frame() {
    const std::lock_guard lock(mutex_);
    ++counts_.counted;
    if (progress_) progress_(static_cast<int>(counts_.counted), frames_);
  }

  void add(std::size_t number, Counted counted) {
    const std::lock_guard lock(mutex_);
    counted_[number] = std::move(counted);
    for (; added_ < tasks_.size() && counted_[added_].keyframe; ++added_) {
      Counted next = std::exchange(counted_[added_], {});
      counts_.tasks.push_back({counts_.keyframes.size(), std::move(next.inbetweens)});
      counts_.add_keyframe(*std::move(next.keyframe));
    }
  }

  const std::span<const farm::Task> tasks_;
  const std::uint32_t band_lines_;
  const CountProgress& progress_;
  int frames_ = 0;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::vector<Counted> counted_;  // by task, and not added yet
  std::size_t added_ = 0;         // tasks
  FilmCounts counts_;
};

}  // namespace

void FilmCounts::add_keyframe(wire::FrameCounts counts) {
  KeyframeCounts& keyframe = keyframes.emplace_back(KeyframeCounts{std::move(counts), {}});
  std::span<const wire::SurfaceLine> lines = keyframe.surface_lines;
  for (const wire::MadeSurface& surface : keyframe.surfaces) {
    keyframe.placed.push_back({surface.number, surfaces.add(surface, lines.first(surface.lines))});
    lines = lines.subspan(surface.lines);
  }
  keyframe.surfaces = {};
  keyframe.surface_lines = {};
}

wire::UnitCounts operator+(wire::UnitCounts a, const wire::UnitCounts& b) {
  for (std::size_t kind = 0; kind < a.units.size(); ++kind) a.units[kind] += b.units[kind];
  return a;
}

wire::UnitCounts operator*(wire::UnitCounts a, double part) {
  for (double& units : a.units) units *= part;
  return a;
}

wire::LineCounts operator+(const wire::LineCounts& a, const wire::LineCounts& b) {
  wire::LineCounts both{a.edge_boxes + b.edge_boxes,
                        a.samples + b.samples,
                        a.moving_edge_boxes + b.moving_edge_boxes,
                        a.moving_samples + b.moving_samples,
                        a.moving_width + b.moving_width,
                        a.constant,
                        a.moving,
                        a.kept_width + b.kept_width,
                        a.swept_width + b.swept_width};
  both.constant += b.constant;
  both.moving += b.moving;
  return both;
}

FrameTotals operator+(FrameTotals a, const FrameTotals& b) {
  return {a.made + b.made,       a.drawn + b.drawn,     a.lines + b.lines,
          a.changed + b.changed, a.casters + b.casters, a.kept_points + b.kept_points};
}

FrameTotals operator*(FrameTotals a, double part) {
  wire::LineCounts& drawn = a.drawn;
  for (double* number : {&drawn.edge_boxes, &drawn.samples, &drawn.moving_edge_boxes, &drawn.moving_samples,
                         &drawn.moving_width, &a.lines, &a.changed, &a.kept_points})
    *number *= part;
  drawn.constant = drawn.constant * part;
  drawn.moving = drawn.moving * part;
  a.made = a.made * part;
  a.casters = a.casters * part;
  return a;
}

// The part of the nodes that need a caster that dice it.
double diced_by(wire::DicedBy others, int nodes) {
  switch (others) {
    case wire::DicedBy::none: return 1;
    case wire::DicedBy::camera: return 1 - 1.0 / nodes;
    case wire::DicedBy::shadows: return 0;
  }
  return 1;
}

wire::UnitCounts casters_on(const wire::FrameCounts& counts, std::uint32_t first_line, std::uint32_t last_line,
                            int nodes) {
  wire::UnitCounts units;
  for (const wire::CasterCounts& caster : counts.casters) {
    const auto overlap = [&](std::uint32_t first, std::uint32_t last) {
      return first < last_line && first_line < last;
    };
    if (overlap(caster.first_line, caster.last_line)) {
      const double diced = diced_by(caster.diced_by, nodes);
      units[wire::Work::caster] += diced;
      units[wire::Work::diced_vertex] += diced * caster.vertices;
    }
    if (!overlap(caster.first_put, caster.last_put)) continue;
    units[wire::Work::caster_vertex] += caster.put_vertices;
    units[wire::Work::caster_triangle] += caster.triangles;
  }
  return units;
}

FrameTotals totals_on(const wire::FrameCounts& counts, std::uint32_t first_line, std::uint32_t last_line,
                      std::uint32_t band_lines) {
  FrameTotals totals;
  std::uint32_t changed_to = first_line;  // lines before were counted as changed, or are of bands that are not
  for (std::uint32_t line = first_line; line < last_line; ++line) {
    const wire::LineCounts& on_line = counts.lines[line];
    totals.drawn = totals.drawn + on_line;
    totals.lines += on_line.moving_edge_boxes > 0 ? 1 : 0;
    if (on_line.moving.pixels <= 0 || line < changed_to) continue;
    const std::uint32_t band = line / band_lines * band_lines;
    changed_to = std::min(band + band_lines, last_line);
    totals.changed += changed_to - std::max(band, first_line);
  }
  totals.casters = casters_on(counts, first_line, last_line, 1);
  return totals;
}

FrameTotals totals_of(const wire::FrameCounts& counts, std::uint32_t band_lines) {
  FrameTotals totals = totals_on(counts, 0, static_cast<std::uint32_t>(counts.lines.size()), band_lines);
  totals.made = counts.made;
  totals.blocks = counts.moving_blocks;
  totals.kept_points = counts.kept_points;
  return totals;
}

FilmCounts count_film(const wire::PackedFilm& film, std::span<const farm::Task> tasks, Counter& counter,
                      const Budget& budget, images::PictureFormat format) {
  const images::PictureBands bands(format, film.settings().width, film.settings().height);
  return FilmCount(film, tasks, counter, bands.lines_a_band()).count(budget);
}

FilmCounts count_exactly(const wire::PackedFilm& film, std::span<const farm::Task> tasks, const MakeCounter& make,
                         images::PictureFormat format, int counters, const CountProgress& progress) {
  const images::PictureBands bands(format, film.settings().width, film.settings().height);
  ExactCount count(tasks, bands.lines_a_band(), progress);
  std::vector<std::future<void>> others;
  for (int other = 1; other < counters; ++other)
    others.push_back(std::async(std::launch::async, [&] { count.run(*make(film, Lines::all)); }));
  count.run(*make(film, Lines::all));
  for (std::future<void>& other : others) other.get();
  return count.take();
}

FilmCounts cut_counts(const FilmCounts& counts, std::span<const farm::Task> tasks, std::span<const farm::Task> pieces) {
  FilmCounts cut = counts;
  cut.tasks.clear();
  std::size_t task = 0, first = 0;  // of the pieces' frames, the task and the place there
  for (const farm::Task& piece : pieces) {
    const TaskCounts& whole = counts.tasks[task];
    const auto begin = whole.inbetweens.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = static_cast<std::ptrdiff_t>(piece.frames.size());
    cut.tasks.push_back({whole.keyframe, {begin, begin + count - 1}});
    first += piece.frames.size();
    if (first == tasks[task].frames.size()) ++task, first = 0;
  }
  return cut;
}

}  // namespace mars::forecast
