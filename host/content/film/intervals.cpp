#include "host/content/film/intervals.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "hal/failure/failure.h"

namespace mars::film {
namespace {

using Frames = std::vector<std::uint32_t>;

class Cutter {
 public:
  explicit Cutter(const wire::FilmData& film)
      : film_(film), global_(film.settings.frames, false), exposed_(film.settings.frames, false) {
    for (const wire::Segment& segment : film.segments) {
      weights_.push_back(double(film.shapes[segment.shape].size()));
      all_ += weights_.back();
    }
    mark_global(film.settings.camera);
    mark_exposure();
    for (const wire::Track& track : film.light_tracks) mark_global(track);
  }

  // Whether an interval must begin there: the camera's exposure changes.
  bool must_begin(std::uint32_t frame) const { return exposed_[frame]; }

  // First frames of the intervals that cost least.
  Frames cheapest() const {
    const std::uint32_t frames = film_.settings.frames;
    const double exchange = double(film_.settings.width) * film_.settings.height / kPixelsPerPatch;
    const auto [starts, changed] = changes_by_frame();
    std::vector<double> best(frames + 1, 0), last_moved(frames, 0);
    std::vector<std::uint32_t> last_change(weights_.size(), 0), cut(frames + 1, 0);
    std::uint32_t last_global = 0;
    for (std::uint32_t end = 1; end <= frames; ++end) {
      const std::uint32_t now = end - 1;
      for (std::uint32_t i = starts[now]; i < starts[end]; ++i) {
        const std::uint32_t segment = changed[i];
        if (last_change[segment] > 0) last_moved[last_change[segment]] -= weights_[segment];
        last_moved[now] += weights_[segment];
        last_change[segment] = now;
      }
      if (global_[now]) last_global = now;
      const double *best_of = best.data(), *moved = last_moved.data();
      const char* exposed = exposed_.data();
      double least = std::numeric_limits<double>::max();
      std::uint32_t from = now;
      double moving = 0;  // patches that move between `first` and `end`
      for (std::uint32_t first = now;; --first) {
        const double inbetween = last_global > first ? all_ : moving;
        const double cost = best_of[first] + all_ + exchange + (now - first) * inbetween;
        if (cost <= least) {
          least = cost;
          from = first;
        }
        if (first == 0 || exposed[first] || end - first == kLongest) break;
        moving += moved[first];
      }
      best[end] = least;
      cut[end] = from;
    }
    return starts_of(cut);
  }

  // First frames of intervals that begin at the keyframes, and where they must.
  Frames at(std::span<const std::uint32_t> keyframes) const {
    Frames starts = {0};
    auto key = keyframes.begin();
    for (std::uint32_t frame = 1; frame < film_.settings.frames; ++frame) {
      key = std::find_if(key, keyframes.end(), [&](std::uint32_t each) { return each >= frame; });
      if (must_begin(frame) || (key != keyframes.end() && *key == frame)) starts.push_back(frame);
    }
    return starts;
  }

  // Intervals beginning at `starts`, with what moves in each.
  void fill(const Frames& starts, wire::FilmData& film) const {
    std::vector<std::uint32_t> interval_of(film_.settings.frames);
    for (std::size_t i = 0; i < starts.size(); ++i)
      std::fill(interval_of.begin() + starts[i], interval_of.begin() + end_of(starts, i), std::uint32_t(i));
    const auto movers = movers_of(starts, interval_of);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const std::uint32_t end = end_of(starts, i);
      const bool global =
          std::find(global_.begin() + starts[i] + 1, global_.begin() + end, true) != global_.begin() + end;
      const wire::Track list = add_list(global ? everything() : movers[i], film);
      film.intervals.push_back({starts[i], end - starts[i], list.first, list.count});
    }
  }

 private:
  void mark_global(const wire::Track& track) {
    for (std::uint32_t i = 1; i < track.count; ++i) global_[film_.changes[track.first + i].frame] = true;
  }

  void mark_exposure() {
    const wire::Track& track = film_.settings.camera;
    for (std::uint32_t i = 1; i < track.count; ++i) {
      const wire::Change &before = film_.changes[track.first + i - 1], &now = film_.changes[track.first + i];
      exposed_[now.frame] = film_.cameras[now.value].exposure != film_.cameras[before.value].exposure;
    }
  }

  // Calls visit(segment, frame) for every change of motion or material after frame 0, segment by segment.
  template <typename Visit>
  void visit_changes(Visit visit) const {
    const wire::Change* changes = film_.changes.data();
    for (std::uint32_t number = 0; number < film_.segments.size(); ++number) {
      const auto visit_track = [&](const wire::Track& track) {
        for (std::uint32_t i = 1; i < track.count; ++i) visit(number, changes[track.first + i].frame);
      };
      const wire::Segment& segment = film_.segments[number];
      if (segment.bone_count == 0) visit_track(segment.motion);
      for (std::uint32_t i = 0; i < segment.bone_count; ++i) visit_track(film_.bones[segment.first_bone + i]);
      visit_track(segment.material);
    }
  }

  struct ByFrame {
    std::vector<std::size_t> starts;  // where each frame's segments begin; one more at the end
    std::vector<std::uint32_t> segments;
  };

  ByFrame changes_by_frame() const {
    ByFrame by_frame{std::vector<std::size_t>(film_.settings.frames + 2, 0), {}};
    visit_changes([&](std::uint32_t, std::uint32_t frame) { ++by_frame.starts[frame + 2]; });
    std::partial_sum(by_frame.starts.begin(), by_frame.starts.end(), by_frame.starts.begin());
    by_frame.segments.resize(by_frame.starts.back());
    visit_changes(
        [&](std::uint32_t segment, std::uint32_t frame) { by_frame.segments[by_frame.starts[frame + 1]++] = segment; });
    by_frame.starts.pop_back();
    return by_frame;
  }

  // Back from the last frame, each cut the best one before.
  Frames starts_of(const std::vector<std::uint32_t>& cut) const {
    Frames starts;
    for (std::uint32_t end = film_.settings.frames; end > 0; end = cut[end]) starts.push_back(cut[end]);
    std::reverse(starts.begin(), starts.end());
    return starts;
  }

  std::uint32_t end_of(const Frames& starts, std::size_t i) const {
    return i + 1 < starts.size() ? starts[i + 1] : film_.settings.frames;
  }

  // Of each interval, the segments that change after its first frame, ascending.
  std::vector<Frames> movers_of(const Frames& starts, const std::vector<std::uint32_t>& interval_of) const {
    std::vector<Frames> movers(starts.size());
    visit_changes([&](std::uint32_t segment, std::uint32_t frame) {
      Frames& list = movers[interval_of[frame]];
      if (frame != starts[interval_of[frame]] && (list.empty() || list.back() != segment)) list.push_back(segment);
    });
    return movers;
  }

  Frames everything() const {
    Frames all(weights_.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  // Intervals whose lists are the same share one.
  static wire::Track add_list(const Frames& list, wire::FilmData& film) {
    if (!film.intervals.empty()) {
      const wire::Interval& last = film.intervals.back();
      if (std::equal(list.begin(), list.end(), film.moving.begin() + last.first_moving,
                     film.moving.begin() + last.first_moving + last.moving_count))
        return {last.first_moving, last.moving_count};
    }
    if (film.moving.size() + list.size() > std::numeric_limits<std::uint32_t>::max())
      throw Failure("has too many intervals in which too much moves", "", "compile it with --intervals auto");
    const auto first = static_cast<std::uint32_t>(film.moving.size());
    film.moving.insert(film.moving.end(), list.begin(), list.end());
    return {first, static_cast<std::uint32_t>(list.size())};
  }

  const wire::FilmData& film_;
  std::vector<char> global_;     // frames at which camera or a light changes
  std::vector<char> exposed_;    // frames at which the camera's exposure changes
  std::vector<double> weights_;  // patches and meshlets of each segment
  double all_ = 0;
};

}  // namespace

void cut_intervals(wire::FilmData& film, animator::Cutting cutting, std::span<const std::uint32_t> keyframes) {
  const Cutter cutter(film);
  const Frames starts = cutting == animator::Cutting::automatic ? cutter.cheapest() : cutter.at(keyframes);
  film.intervals.clear();
  film.moving.clear();
  cutter.fill(starts, film);
}

}  // namespace mars::film
