// A scene: one moment of a film, seen by one camera, as a live view shows it. The scene block is a packed film (film.h)
// of one frame and one interval, whose moving segments and bones are those that the view's inbetweens may change. It
// has no meshes; its shapes and patches are those that differ from the loaded film's: shape numbers below the film's
// are the film's own, those from there on are the block's, whose patches count from the block's first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "node/wire/film.h"
#include "node/wire/protocol.h"

namespace mars::wire {

// The block of a scene; `scene.settings.frames` is 1.
std::vector<std::byte> pack_scene(const FilmData& scene);

// What a view's Draws may change: moving segments and bones, and patches of which nothing else is made.
class MovingParts {
 public:
  MovingParts() = default;
  explicit MovingParts(const PackedFilm& scene);

  // As MovedSegment numbers segments and bones. A segment with a skin may be changed, for what it is made of, where all
  // its bones move.
  bool has_segment(std::size_t segment) const { return segment < segments_.size() && segments_[segment] == 1; }
  bool has_patch(std::size_t patch) const { return patch < patches_.size() && patches_[patch] == 1; }
  // Of the scene's, which a segment may be made of.
  std::size_t materials() const { return materials_; }
  // Whether nothing stands still, and whether nothing moves.
  bool are_all() const { return moving_ == segments_.size(); }
  bool are_none() const { return moving_ == 0; }

 private:
  std::vector<std::uint8_t> segments_;  // and bones
  std::vector<std::uint8_t> patches_;   // of the block
  std::size_t materials_ = 0;
  std::size_t moving_ = 0;  // segments and bones
};

}  // namespace mars::wire
