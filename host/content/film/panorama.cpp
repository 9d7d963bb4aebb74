#include "host/content/film/panorama.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "hal/failure/failure.h"
#include "host/content/film/unpacked.h"

namespace mars::film {
namespace {

// What the camera's axes are to the face, from the world.
wire::Camera face_camera(const wire::Camera& camera, const FaceAxes& axes, std::uint32_t width) {
  const auto& [right, up, behind] = camera.world_to_eye.m;
  const auto along = [&](const std::array<int, 3>& axis, int sign) {
    std::array<double, 4> row{};
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = sign * (axis[0] * right[i] + axis[1] * up[i] - axis[2] * behind[i]);
    return row;
  };
  wire::Camera face = camera;
  face.world_to_eye.m = {along(axes.right, 1), along(axes.up, 1), along(axes.ahead, -1)};
  face.focal = static_cast<double>(face_pixels(width)) / face_side(width);
  face.projection = wire::Projection::perspective;
  return face;
}

// Writes what changes over the frames of a panorama six times, one face after the other.
class FaceTracks {
 public:
  FaceTracks(const wire::PackedFilm& panorama, wire::FilmData& faces) : panorama_(panorama), faces_(faces) {}

  // Of what all faces see alike.
  wire::Track track(const wire::Track& of_panorama) {
    const auto [known, is_new] = known_.try_emplace({of_panorama.first, of_panorama.count});
    if (is_new) known->second = of_panorama.count == 1 ? once(of_panorama) : six_times(of_panorama);
    return known->second;
  }

  wire::Track camera() {
    const wire::FilmSettings& settings = panorama_.settings();
    const auto first = static_cast<std::uint32_t>(faces_.changes.size());
    for (std::size_t face = 0; face < kFaces; ++face) {
      for (const wire::Change& change : changes_of(settings.camera)) {
        add(face, change.frame, static_cast<std::uint32_t>(faces_.cameras.size()));
        faces_.cameras.push_back(face_camera(panorama_.cameras()[change.value], kFaceAxes[face], settings.width));
      }
    }
    return {first, static_cast<std::uint32_t>(faces_.changes.size()) - first};
  }

 private:
  std::span<const wire::Change> changes_of(const wire::Track& track) const {
    return panorama_.changes().subspan(track.first, track.count);
  }

  void add(std::size_t face, std::uint32_t frame, std::uint32_t value) {
    faces_.changes.push_back({static_cast<std::uint32_t>(face) * panorama_.settings().frames + frame, value});
  }

  wire::Track once(const wire::Track& constant) {
    faces_.changes.push_back(changes_of(constant).front());
    return {static_cast<std::uint32_t>(faces_.changes.size()) - 1, 1};
  }

  wire::Track six_times(const wire::Track& track) {
    const auto first = static_cast<std::uint32_t>(faces_.changes.size());
    for (std::size_t face = 0; face < kFaces; ++face)
      for (const wire::Change& change : changes_of(track)) add(face, change.frame, change.value);
    return {first, static_cast<std::uint32_t>(faces_.changes.size()) - first};
  }

  const wire::PackedFilm& panorama_;
  wire::FilmData& faces_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, wire::Track> known_;
};

// Of all faces the same segments move.
void write_intervals(const wire::PackedFilm& panorama, wire::FilmData& faces) {
  std::vector<wire::Interval> of_face(panorama.intervals().begin(), panorama.intervals().end());
  for (wire::Interval& interval : of_face) {
    const auto moving = panorama.moving(interval);
    interval.first_moving = static_cast<std::uint32_t>(faces.moving.size());
    faces.moving.insert(faces.moving.end(), moving.begin(), moving.end());
  }
  for (std::size_t face = 0; face < kFaces; ++face) {
    faces.intervals.insert(faces.intervals.end(), of_face.begin(), of_face.end());
    for (wire::Interval& interval : of_face) interval.first_frame += panorama.settings().frames;
  }
}

}  // namespace

std::uint32_t face_pixels(std::uint32_t width) {
  return 2 * static_cast<std::uint32_t>(std::ceil(width / (2 * std::numbers::pi)));
}

bool is_panorama(const wire::PackedFilm& film) { return film.camera_at(0).projection == wire::Projection::panorama; }

void check_panorama(const CompiledFilm& panorama) {
  const wire::PackedFilm view = panorama.view();
  const wire::FilmSettings& settings = view.settings();
  if (settings.width != 2 * settings.height)
    throw Failure("is a panorama, whose picture is twice as wide as high, not " + std::to_string(settings.width) + "x" +
                      std::to_string(settings.height),
                  panorama.source, "make the size 2048x1024, for example");
  constexpr std::uint32_t kMost = wire::kMostFrames / kFaces;
  if (settings.frames > kMost)
    throw Failure("is a panorama of more than " + std::to_string(kMost) + " frames", panorama.source,
                  "divide it into several films");
}

CompiledFilm faces_of(const CompiledFilm& panorama) {
  check_panorama(panorama);
  const wire::PackedFilm view = panorama.view();
  wire::FilmData data = unpacked(view);
  data.cameras.clear();
  data.settings.width = data.settings.height = face_side(view.settings().width);
  data.settings.frames = static_cast<std::uint32_t>(kFaces) * view.settings().frames;
  FaceTracks tracks(view, data);
  data.settings.camera = tracks.camera();
  for (wire::Track& light : data.light_tracks) light = tracks.track(light);
  for (wire::Segment& segment : data.segments) {
    segment.motion = tracks.track(segment.motion);
    segment.material = tracks.track(segment.material);
  }
  for (wire::Track& bone : data.bones) bone = tracks.track(bone);
  write_intervals(view, data);
  return packed(data, view.matrices(), panorama);
}

std::vector<std::uint32_t> face_frames(const std::vector<std::uint32_t>& frames, std::uint32_t film_frames) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t face = 0; face < kFaces; ++face)
    for (const std::uint32_t frame : frames) all.push_back(face * film_frames + frame);
  return all;
}

}  // namespace mars::film
