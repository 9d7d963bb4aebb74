#include "host/experiments/forecast/film_counts.h"

#include <algorithm>
#include <cmath>

namespace mars::forecast {
namespace {

// Seconds that counting takes, about.
double counting_seconds(const FrameTotals& frame) {
  return 5e-4 + frame.made.patches * 5e-7 + frame.made.vertices * 8e-9 + frame.made.triangles_tested * 5e-9 +
         frame.made.triangles * 2e-8 + frame.made.edge_boxes * 4e-9;
}

FrameTotals combined(const FrameTotals& a, double part_a, const FrameTotals& b, double part_b) {
  const auto both = [&](double x, double y) { return x * part_a + y * part_b; };
  return {{both(a.made.patches, b.made.patches), both(a.made.vertices, b.made.vertices),
           both(a.made.triangles_tested, b.made.triangles_tested), both(a.made.triangles, b.made.triangles),
           both(a.made.edge_boxes, b.made.edge_boxes)},
          both(a.samples, b.samples),
          both(a.pixels, b.pixels),
          both(a.runs, b.runs),
          both(a.groups, b.groups)};
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
  return combined(before.totals, 1 - part, after->totals, part);
}

class FilmCount {
 public:
  FilmCount(const wire::FilmView& film, std::span<const farm::Task> tasks, Counter& counter)
      : film_(film), tasks_(tasks), counter_(counter), known_(tasks.size()) {}

  FilmCounts count(const Budget& budget);

 private:
  double count_first(const Budget& budget);
  static std::size_t inbetweens_of(const farm::Task& task) { return task.frames.size() - 1; }
  void count_keyframe(std::size_t task);
  void count_inbetween(std::size_t task, std::size_t place);
  void count_inbetweens(std::size_t task, std::size_t count);
  void estimate(std::size_t task);
  double moving_patches(const farm::Task& task) const;

  const wire::FilmView& film_;
  const std::span<const farm::Task> tasks_;
  Counter& counter_;
  FilmCounts counts_;
  std::size_t first_ = 0;                   // task that was counted first
  double keyframe_seconds_ = 0;             // that counting one takes
  double inbetween_seconds_ = 0;            // likewise
  std::vector<std::size_t> counted_tasks_;  // by keyframe
  std::vector<std::vector<Known>> known_;   // by task, in order
};

FilmCounts FilmCount::count(const Budget& budget) {
  const auto fit = [](double seconds, double each) { return static_cast<std::size_t>(std::max(1.0, seconds / each)); };
  const double left = count_first(budget);
  const std::size_t keyframes = std::min(tasks_.size(), fit(left / 2, keyframe_seconds_));
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < keyframes; ++i)
    chosen.push_back((first_ + i * tasks_.size() / keyframes) % tasks_.size());
  double inbetweens = 0;
  for (const std::size_t task : chosen) inbetweens += static_cast<double>(inbetweens_of(tasks_[task]));
  for (const std::size_t task : chosen) {
    if (task != first_) count_keyframe(task);
    const std::size_t all = inbetweens_of(tasks_[task]);
    if (all == 0) continue;
    const double part = static_cast<double>(all) / inbetweens;
    count_inbetweens(task, std::min(all, fit(left / 2 * part, inbetween_seconds_)));
  }
  for (std::size_t task = 0; task < tasks_.size(); ++task) estimate(task);
  return std::move(counts_);
}

// The first task with inbetweens tells what counting takes. The seconds that are left for it.
double FilmCount::count_first(const Budget& budget) {
  while (first_ + 1 < tasks_.size() && inbetweens_of(tasks_[first_]) == 0) ++first_;
  if (inbetweens_of(tasks_[first_]) == 0) first_ = 0;
  count_keyframe(first_);
  keyframe_seconds_ = counting_seconds(totals_of(counts_.keyframes.front()));
  inbetween_seconds_ = keyframe_seconds_;
  const std::size_t all = inbetweens_of(tasks_[first_]);
  if (all > 0) {
    count_inbetween(first_, all / 2);
    inbetween_seconds_ = counting_seconds(known_[first_].front().totals);
  }
  double whole = 0;
  for (const farm::Task& task : tasks_)
    whole += keyframe_seconds_ + static_cast<double>(inbetweens_of(task)) * inbetween_seconds_;
  return std::min(budget.seconds, budget.part * whole);
}

void FilmCount::count_keyframe(std::size_t task) {
  counts_.keyframes.push_back(counter_.count_keyframe(tasks_[task]));
  counted_tasks_.push_back(task);
  ++counts_.counted;
}

void FilmCount::count_inbetween(std::size_t task, std::size_t place) {
  known_[task].push_back({place, totals_of(counter_.count_inbetween(tasks_[task].frames[place + 1]))});
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
  double patches = 1;
  for (const std::uint32_t segment : film_.moving(film_.intervals()[task.interval]))
    patches += film_.shapes()[film_.segments()[segment].shape].size();
  return patches;
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
    counts.inbetweens.push_back(combined(between(known_[like], place), scale, {}, 0));
  }
  counts_.tasks.push_back(std::move(counts));
}

}  // namespace

FrameTotals totals_of(const wire::FrameCounts& counts) {
  FrameTotals totals;
  for (const wire::ShareCounts& share : counts.shares) {
    totals.made.patches += share.patches;
    totals.made.vertices += share.vertices;
    totals.made.triangles_tested += share.triangles_tested;
    totals.made.triangles += share.triangles;
    totals.made.edge_boxes += share.edge_boxes;
  }
  for (const wire::LineCounts& line : counts.lines) {
    totals.samples += line.samples;
    totals.pixels += line.constant_pixels + line.moving_pixels;
    totals.runs += line.constant_runs + line.moving_runs;
    totals.groups += line.constant_groups + line.moving_groups;
  }
  return totals;
}

FilmCounts count_film(const wire::FilmView& film, std::span<const farm::Task> tasks, Counter& counter,
                      const Budget& budget) {
  return FilmCount(film, tasks, counter).count(budget);
}

}  // namespace mars::forecast
