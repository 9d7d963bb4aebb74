#include "host/content/film/intervals.h"

#include <algorithm>
#include <limits>
#include <map>
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
    weigh_parts();
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
    std::vector<std::uint32_t> last_change(weights_.size(), 0), cut(frames + 1, 0);  // of parts, of frames
    std::uint32_t last_global = 0;
    for (std::uint32_t end = 1; end <= frames; ++end) {
      const std::uint32_t now = end - 1;
      for (std::uint32_t i = starts[now]; i < starts[end]; ++i) {
        const std::uint32_t part = changed[i];
        if (last_change[part] > 0) last_moved[last_change[part]] -= weights_[part];
        last_moved[now] += weights_[part];
        last_change[part] = now;
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
      const wire::Track list = add_list(global ? everything() : with_segments(movers[i]), film);
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

  // A patch with a skin weighs for its bones in equal parts.
  void weigh_parts() {
    weights_.assign(film_.segments.size() + film_.bones.size(), 0);
    owners_.resize(film_.bones.size());
    std::map<std::uint32_t, std::vector<double>> of_bones;  // by shape
    for (std::uint32_t number = 0; number < film_.segments.size(); ++number) {
      const wire::Segment& segment = film_.segments[number];
      const wire::Shape& shape = film_.shapes[segment.shape];
      all_ += double(shape.size());
      if (segment.bone_count == 0) weights_[number] = double(shape.size());
      if (segment.bone_count == 0) continue;
      std::fill_n(owners_.begin() + segment.first_bone, segment.bone_count, number);
      const auto [known, is_new] = of_bones.try_emplace(segment.shape);
      if (is_new) known->second = weights_of_bones(shape);
      std::ranges::copy(known->second, weights_.begin() + number_of(segment, 0));
    }
  }

  std::vector<double> weights_of_bones(const wire::Shape& shape) const {
    std::vector<double> weights(shape.bone_count);
    for (std::uint32_t piece = 0; piece < shape.size(); ++piece) {
      const auto bones = bones_of_piece(shape, piece);
      for (const std::uint32_t bone : bones) weights[bone] += 1.0 / double(bones.size());
    }
    return weights;
  }

  std::span<const std::uint32_t> bones_of_piece(const wire::Shape& shape, std::uint32_t piece) const {
    const auto all = std::span(film_.skin_bones);
    if (piece >= shape.patch_count) {
      const wire::Skin& skin = film_.meshlets[shape.first_meshlet + piece - shape.patch_count].skin;
      return all.subspan(skin.first_bone, skin.bone_count);
    }
    const wire::NetPatch& patch = film_.net_patches[shape.first_net_patch + piece];
    return all.subspan(patch.first_bone, patch.bone_count);
  }

  // A part is a segment or a bone, numbered as wire::Interval does.
  std::uint32_t number_of(const wire::Segment& segment, std::uint32_t bone) const {
    return static_cast<std::uint32_t>(film_.segments.size()) + segment.first_bone + bone;
  }

  // Calls visit(part, frame) for every change of motion or material after frame 0, part by part.
  template <typename Visit>
  void visit_changes(Visit visit) const {
    const auto visit_track = [&](std::uint32_t part, const wire::Track& track) {
      for (std::uint32_t i = 1; i < track.count; ++i) visit(part, film_.changes[track.first + i].frame);
    };
    for (std::uint32_t number = 0; number < film_.segments.size(); ++number) {
      const wire::Segment& segment = film_.segments[number];
      if (segment.bone_count > 0) continue;
      visit_track(number, segment.motion);
      visit_track(number, segment.material);
    }
    for (const wire::Segment& segment : film_.segments)
      for (std::uint32_t bone = 0; bone < segment.bone_count; ++bone) {
        visit_track(number_of(segment, bone), film_.bones[segment.first_bone + bone]);
        visit_track(number_of(segment, bone), segment.material);
      }
  }

  struct ByFrame {
    std::vector<std::size_t> starts;  // where each frame's parts begin; one more at the end
    std::vector<std::uint32_t> parts;
  };

  ByFrame changes_by_frame() const {
    ByFrame by_frame{std::vector<std::size_t>(film_.settings.frames + 2, 0), {}};
    visit_changes([&](std::uint32_t, std::uint32_t frame) { ++by_frame.starts[frame + 2]; });
    std::partial_sum(by_frame.starts.begin(), by_frame.starts.end(), by_frame.starts.begin());
    by_frame.parts.resize(by_frame.starts.back());
    visit_changes(
        [&](std::uint32_t part, std::uint32_t frame) { by_frame.parts[by_frame.starts[frame + 1]++] = part; });
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

  // Of each interval, the parts that change after its first frame, ascending, but for segments with a skin.
  std::vector<Frames> movers_of(const Frames& starts, const std::vector<std::uint32_t>& interval_of) const {
    std::vector<Frames> movers(starts.size());
    visit_changes([&](std::uint32_t part, std::uint32_t frame) {
      Frames& list = movers[interval_of[frame]];
      if (frame != starts[interval_of[frame]] && (list.empty() || list.back() != part)) list.push_back(part);
    });
    return movers;
  }

  // With the segments whose bones are among the parts.
  Frames with_segments(Frames parts) const {
    Frames segments;
    for (const std::uint32_t part : parts)
      if (part >= film_.segments.size())
        if (const std::uint32_t owner = owners_[part - film_.segments.size()];
            segments.empty() || segments.back() != owner)
          segments.push_back(owner);
    parts.insert(parts.end(), segments.begin(), segments.end());
    std::ranges::sort(parts);
    return parts;
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
  std::vector<char> global_;           // frames at which camera or a light changes
  std::vector<char> exposed_;          // frames at which the camera's exposure changes
  std::vector<double> weights_;        // patches and meshlets of each part
  std::vector<std::uint32_t> owners_;  // of each bone the number of its segment
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
