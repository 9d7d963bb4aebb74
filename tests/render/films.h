// Small films for tests, made without files: shapes from the library of primitives, moved by hand.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/content/modeler/meshlets.h"
#include "host/content/modeler/model.h"
#include "node/wire/film.h"

namespace mars::test {

using Vec3 = std::array<double, 3>;

// Turned by `angle` about z (radians), scaled by `size`, moved to `place`.
wire::Matrix placed(const Vec3& place, double size, double angle = 0);

// A camera at `eye` that looks at `at`, z up, `fov` degrees vertically.
wire::Camera looking(const Vec3& eye, const Vec3& at, double fov, double near = 0.05, double far = 1000);

// A closed ball in the unit cube: `rows` rows of quads between two rows of triangles. `crease` as in model files.
modeler::Mesh mesh_ball(std::uint32_t rows, double crease);

class FilmMaker {
 public:
  FilmMaker(std::uint32_t width, std::uint32_t height, std::uint32_t frames);

  std::uint32_t add_shape(const std::vector<wire::Patch>& patches);
  std::uint32_t add_shape(const modeler::Meshlets& mesh);
  std::uint32_t add_shape(const modeler::Shape& skin);  // of patches
  std::uint32_t add_material(const wire::Material& material);
  // One matrix (stands still) or one a frame (only changes are stored).
  void add_segment(std::uint32_t shape, std::uint32_t material, const std::vector<wire::Matrix>& motion);
  // Of a shape with a skin: the motion of each bone.
  void add_skin(std::uint32_t shape, std::uint32_t material, const std::vector<std::vector<wire::Matrix>>& bones);
  void add_light(const wire::Light& light);
  // One camera, or one a frame.
  void set_cameras(const std::vector<wire::Camera>& cameras);

  // Cut into intervals of at most `length` frames, each with its movers.
  wire::FilmData make(std::uint32_t length = 1000);

  wire::FilmData film;

 private:
  wire::Track still(std::uint32_t value);
  wire::Track track_of(const std::vector<wire::Matrix>& motion);
  bool changes(const wire::Track& track, std::uint32_t first, std::uint32_t end) const;
  bool moves(std::uint32_t segment, std::uint32_t first, std::uint32_t end) const;

  bool camera_moves_ = false;
};

inline constexpr wire::Material kClay{{0.8f, 0.5f, 0.3f}, 0.1f, 0.65f, 0.45f, 32, 2};
inline constexpr std::array<float, 3> kMagenta{1, 0, 1};  // a background no material here can show

// Bodies that stand still, overlap and touch; some turn and cross the others; two lights, three materials.
wire::FilmData crowd(std::uint32_t width, std::uint32_t height, std::uint32_t frames, std::uint32_t interval);
// A camera flying through the crowd, near plane in its midst: everything moves.
wire::FilmData flight(std::uint32_t width, std::uint32_t height, std::uint32_t frames);
// Coinciding bodies, stationary and moving: every depth ties.
wire::FilmData ties(std::uint32_t width, std::uint32_t height);
// Balls that fly above the picture, whose shadows run over still bodies on a floor, with a light from afar and a lamp
// above them.
wire::FilmData overhead(std::uint32_t width, std::uint32_t height, std::uint32_t frames, std::uint32_t interval);
// A floor in whose corner a small ball rolls.
wire::FilmData corner(std::uint32_t width, std::uint32_t height, std::uint32_t frames);
// A tube along z in the unit cube, `rows` rows of quads between two caps, as a skin of `bones` bones one above the
// other: vertices follow the two, three or four nearest.
modeler::Mesh tube(std::uint32_t rows, std::uint32_t bones);
// Tubes with skins that bend before and behind bodies that stand still; one of them holds still, bent. A light casts
// shadows.
wire::FilmData bending(std::uint32_t width, std::uint32_t height, std::uint32_t frames, std::uint32_t interval,
                       wire::Blend blend = wire::Blend::linear);
// No patch at all.
wire::FilmData nothing(std::uint32_t width, std::uint32_t height, std::uint32_t frames);

}  // namespace mars::test
