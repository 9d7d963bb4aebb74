#include "host/content/film/excerpt.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "host/content/film/unpacked.h"

namespace mars::film {
namespace {

// Frames whose matrices the excerpt has, ascending; the first is 0, as tracks have it.
std::vector<std::uint32_t> known_frames(const wire::PackedFilm& film, std::span<const std::uint32_t> frames) {
  std::vector<std::uint32_t> known = {0};
  const auto add = [&](std::uint32_t frame) {  // and the one before, from which motion is seen
    known.push_back(frame);
    if (frame > 0) known.push_back(frame - 1);
  };
  for (const std::uint32_t frame : frames) {
    add(frame);
    add(film.interval_at(frame).first_frame);
  }
  std::ranges::sort(known);
  const auto twice = std::ranges::unique(known);
  known.erase(twice.begin(), twice.end());
  return known;
}

// Calls visit(motion) for the motions of segments and bones.
template <typename Visit>
void visit_motions(const wire::PackedFilm& film, const Visit& visit) {
  for (const wire::Segment& segment : film.segments()) visit(segment.motion);
  for (const wire::Track& bone : film.bones()) visit(bone);
}

bool is_worthwhile(const wire::PackedFilm& film, std::size_t film_bytes, std::size_t frames) {
  std::size_t left_out = 0;  // matrices
  visit_motions(
      film, [&](const wire::Track& motion) { left_out += motion.count - std::min(frames, std::size_t{motion.count}); });
  return left_out * (sizeof(wire::Matrix) + sizeof(wire::Change)) > film_bytes / 2;
}

constexpr std::size_t kMotionsAtATime = 1024;  // of a film in a file: the machine reads beside what is looked at

class Excerpt {
 public:
  Excerpt(const CompiledFilm& film, std::vector<std::uint32_t> known)
      : whole_(film), film_(film.view()), known_(std::move(known)), data_(unpacked(film_)) {
    data_.settings.camera = whole(data_.settings.camera);
    for (wire::Track& light : data_.light_tracks) light = whole(light);
    for (wire::Segment& segment : data_.segments) {
      segment.motion = some(segment.motion);
      segment.material = whole(segment.material);
    }
    for (wire::Track& bone : data_.bones) bone = some(bone);
    write_intervals();
  }

  const wire::FilmData& data() const { return data_; }

 private:
  // Many segments have the same material.
  wire::Track whole(const wire::Track& track) {
    const auto [known, is_new] = tracks_.try_emplace({track.first, track.count});
    if (is_new) {
      known->second = {static_cast<std::uint32_t>(data_.changes.size()), track.count};
      const auto changes = film_.changes().subspan(track.first, track.count);
      data_.changes.insert(data_.changes.end(), changes.begin(), changes.end());
    }
    return known->second;
  }

  wire::Track some(const wire::Track& motion) {
    const auto first = static_cast<std::uint32_t>(data_.changes.size());
    std::optional<std::uint32_t> last;
    for (const std::uint32_t frame : known_) {
      const std::uint32_t value = film_.value_at(motion, frame);
      if (std::exchange(last, value) == value) continue;
      data_.changes.push_back({frame, static_cast<std::uint32_t>(data_.matrices.size())});
      data_.matrices.push_back(film_.matrices()[value]);
    }
    if (++motions_ % kMotionsAtATime == 0) let_pages_go(whole_.lines);
    return {first, static_cast<std::uint32_t>(data_.changes.size()) - first};
  }

  // Nothing moves in intervals whose frames are not known. Intervals that share a list follow each other.
  void write_intervals() {
    const wire::Interval* last = nullptr;
    wire::Track list{};
    for (const wire::Interval& interval : film_.intervals()) {
      data_.intervals.push_back({interval.first_frame, interval.frame_count, 0, 0});
      if (!std::ranges::binary_search(known_, interval.first_frame)) continue;
      if (last == nullptr || last->first_moving != interval.first_moving ||
          last->moving_count != interval.moving_count) {
        const auto moving = film_.moving(interval);
        list = {static_cast<std::uint32_t>(data_.moving.size()), interval.moving_count};
        data_.moving.insert(data_.moving.end(), moving.begin(), moving.end());
      }
      last = &interval;
      data_.intervals.back().first_moving = list.first;
      data_.intervals.back().moving_count = list.count;
    }
  }

  const CompiledFilm& whole_;
  const wire::PackedFilm film_;
  const std::vector<std::uint32_t> known_;
  std::size_t motions_ = 0;  // so far
  wire::FilmData data_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, wire::Track> tracks_;
};

}  // namespace

std::optional<CompiledFilm> excerpt_of(const CompiledFilm& film, std::span<const std::uint32_t> frames) {
  const wire::PackedFilm view = film.view();
  std::vector<std::uint32_t> known = known_frames(view, frames);
  if (!is_worthwhile(view, film.block().size(), known.size())) return std::nullopt;
  const Excerpt excerpt(film, std::move(known));
  return packed(excerpt.data(), excerpt.data().matrices, film);
}

}  // namespace mars::film
