// The film as a node sees it: the segments that move in the current interval, and camera, lights and matrices of the
// current frame, in eye space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "node/geometry/eye_light.h"
#include "node/geometry/line_range.h"
#include "node/shape/bezier.h"
#include "node/shape/sample_pattern.h"
#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::geometry {

// The boxes round control points and vertices of a film's shapes.
class ShapeBoxes {
 public:
  struct Box {
    float low[3];
    float high[3];

    bool is_empty() const { return low[0] > high[0]; }
  };

  // Two bones, the lower number first, and the box round what follows both.
  struct Pair {
    std::array<std::uint32_t, 2> bones;
    Box box;
  };

  explicit ShapeBoxes(const wire::PackedFilm& film);
  const Box& of(std::uint32_t shape) const { return boxes_[shape]; }
  // Of a shape with a skin, for each bone round the vertices and points that follow it.
  std::span<const Box> of_bones(std::uint32_t shape) const {
    return std::span(bones_).subspan(first_bone_[shape], first_bone_[shape + 1] - first_bone_[shape]);
  }

  // Of a shape that some segment blends by dual quaternions, each two bones that a point follows; else none.
  std::span<const Pair> pairs(std::uint32_t shape) const {
    return std::span(pairs_).subspan(first_pair_[shape], first_pair_[shape + 1] - first_pair_[shape]);
  }

 private:
  void add_bones(const wire::PackedFilm& film, std::uint32_t shape);
  void add_pairs(const wire::PackedFilm& film, std::uint32_t shape);

  std::vector<Box> boxes_;
  std::vector<Box> bones_;
  std::vector<Pair> pairs_;
  std::vector<std::size_t> first_bone_, first_pair_;  // of each shape, and the end
};

// Which of a meshlet's bones share a vertex: bit b of row a, a < b, by their places in the meshlet's list.
using BonePairs = std::array<std::uint16_t, wire::kMeshletBones>;

class Scene {
 public:
  explicit Scene(const wire::PackedFilm& film);

  void set_interval(std::uint32_t number);
  void set_frame(std::uint32_t frame);
  // Until the next call these segments and bones are as they are here, whatever the frame.
  void move(std::span<const wire::MovedSegment> moved);

  const wire::PackedFilm& film() const { return film_; }
  std::int32_t width() const { return static_cast<std::int32_t>(film_.settings().width); }
  std::int32_t height() const { return static_cast<std::int32_t>(film_.settings().height); }
  const shape::Projection& projection() const { return projection_; }
  // In the film's order, but those that cast shadows last.
  std::span<const EyeLight> lights() const { return lights_; }
  std::uint32_t casting_count() const { return casting_count_; }
  std::span<const EyeLight> casting_lights() const { return lights().last(casting_count_); }
  const shape::SamplePattern& pattern() const { return shape::sample_pattern(film_.settings().samples); }
  // How its patches are diced.
  shape::Dicing dicing() const { return {static_cast<int>(film_.settings().dice), tolerances_}; }
  const wire::Camera& camera() const { return film_.camera_at(frame_); }
  // The world's z axis in eye space.
  std::array<float, 3> up() const;

  // Segments of which something moves.
  std::span<const std::uint32_t> movers() const { return movers_; }
  bool any_moves() const { return !movers_.empty(); }
  bool moves(std::size_t segment) const { return moves_[segment] != 0; }
  // How many of the segment's patches and meshlets move: of a skin those of which a bone does, else all or none.
  std::uint32_t moving_pieces(std::size_t segment) const { return moving_pieces_[segment]; }
  // Whether any of them stands still, and whether anything does.
  bool stands(std::size_t segment) const;
  bool any_stands() const;
  // Of one of them, by its number in the shape.
  bool moves(std::size_t segment, std::size_t piece) const {
    const std::size_t first = first_skin_piece_[segment];
    return first == kRigid ? moves(segment) : piece_moves_[first + piece] != 0;
  }
  bool bone_moves(std::size_t segment, std::uint32_t bone) const {
    return moves_[film_.segments().size() + film_.segments()[segment].first_bone + bone] != 0;
  }
  // Number of the segment's first patch or meshlet among all of the film.
  std::uint32_t first_patch(std::size_t segment) const { return first_patch_[segment]; }
  // Whose a patch or meshlet of that number is.
  std::uint32_t segment_of(std::uint32_t patch) const;
  shape::EyeMatrix matrix(std::size_t segment) const;  // segment_place.h knows skins
  // Of one of a skin's bones; a segment has most_bones() at most.
  shape::EyeMatrix bone_matrix(std::size_t segment, std::uint32_t bone) const;
  std::size_t most_bones() const { return most_bones_; }
  // By meshlet, where some segment blends by dual quaternions; else none.
  std::span<const BonePairs> bone_pairs() const { return bone_pairs_; }
  std::uint32_t material(std::size_t segment) const;

 private:
  static constexpr std::size_t kRigid = std::numeric_limits<std::size_t>::max();

  std::uint32_t mark_moving_pieces(std::size_t segment);

  wire::PackedFilm film_;
  shape::Tolerances tolerances_;
  std::vector<std::uint32_t> first_patch_;
  std::vector<std::uint8_t> moves_;  // by segment, then by bone
  std::vector<std::uint32_t> moving_pieces_;
  std::vector<std::size_t> first_skin_piece_;  // by segment, among those of skins
  std::vector<std::uint8_t> piece_moves_;      // of skins
  std::span<const std::uint32_t> movers_;
  std::vector<wire::MovedSegment> moved_;
  std::vector<std::uint32_t> moved_at_;  // by segment, then by bone: its place in moved_ and one; 0: it is not there
  std::uint32_t frame_ = 0;
  shape::Projection projection_;
  std::size_t most_bones_ = 0;
  std::vector<BonePairs> bone_pairs_;
  std::vector<std::size_t> light_order_;  // numbers of tracks
  std::uint32_t casting_count_;
  std::vector<EyeLight> lights_;
};

// Of one of the film's meshlets among Scene::bone_pairs(); nullptr where there are none.
const BonePairs* pairs_of(const wire::PackedFilm& film, const wire::Meshlet& meshlet, std::span<const BonePairs> all);

// How `camera` shows the world on a film's pictures.
shape::Projection projection_of(const wire::Camera& camera, const wire::FilmSettings& settings);

}  // namespace mars::geometry
