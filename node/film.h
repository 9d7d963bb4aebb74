// The compiled film: what a node knows of a film, and, byte for byte, the body of a .mars file. Model data
// (shapes, segments, materials) and motion data (only what changed, with the frame from which it holds),
// cut into render intervals. One contiguous block that a machine's nodes share; FilmView reads it in place,
// FilmData is the same film in vectors, for those who make one. Angles are gone here: matrices only.
//
// Units: world lengths; colours 0..1 as they are shown (no gamma); frames count from 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mars::node {

// Bumped whenever the layout or the meaning of a field changes; other versions are refused.
inline constexpr std::uint32_t kFilmVersion = 1;
inline constexpr std::uint32_t kMaxSide = 16384;  // pixels
inline constexpr std::uint32_t kMostFrames = 1'000'000;  // of a film

// A bicubic Bezier patch: point (i, j) is points[4 * j + i], i along u, j along v, in the unit cube.
// The outside is where d/du x d/dv points.
struct Patch {
  std::array<std::array<float, 3>, 16> points;
};

// Affine map, row by row: p' = m[r][0..2] . p + m[r][3].
struct Matrix {
  std::array<std::array<double, 4>, 3> m;

  bool operator==(const Matrix&) const = default;
};

// From `frame` on, until the track's next change, the element has the value numbered `value`.
struct Change {
  std::uint32_t frame;
  std::uint32_t value;
};

// changes[first, first + count): ascending frames, the first at frame 0.
struct Track {
  std::uint32_t first;
  std::uint32_t count;
};

struct Shape {
  std::uint32_t first_patch;
  std::uint32_t patch_count;
};

// One instance of a shape. `motion` gives indices into matrices: T-matrices from the unit cube to the world.
// `look` gives indices into materials. Patches of the whole film are numbered segment by segment.
struct Segment {
  std::uint32_t shape;
  std::uint32_t name;  // offset into names
  Track motion;
  Track look;
};

// Phong's: ambient + diffuse * N.L coloured, specular * (R.V)^exponent white, per light.
struct Material {
  std::array<float, 3> color;
  float ambient;
  float diffuse;
  float specular;
  float exponent;
  std::uint32_t sides;  // 1: seen from outside only; 2: the normal turns to the eye

  bool operator==(const Material&) const = default;
};

// kind 0: directional, `vector` is the unit direction to the light; 1: a point light at `vector`.
struct Light {
  std::uint32_t kind;
  std::array<float, 3> vector;
  std::array<float, 3> color;  // times intensity

  bool operator==(const Light&) const = default;
};

// The eye looks along -z of its own frame, x to the right, y up. `focal` = 1 / tan(half the vertical field of
// view). Nothing nearer than near or farther than far is drawn.
struct Camera {
  Matrix world_to_eye;
  double focal;
  double near;
  double far;

  bool operator==(const Camera&) const = default;
};

// Frames [first_frame, first_frame + frame_count) over which the same segments, moving[first_moving,
// first_moving + moving_count) in ascending order, move and all others stand still, unseen by a moving
// camera or light (if one moves, every segment is listed).
struct Interval {
  std::uint32_t first_frame;
  std::uint32_t frame_count;
  std::uint32_t first_moving;
  std::uint32_t moving_count;
};

struct FilmSettings {
  std::uint32_t width;   // pixels, 1..kMaxSide
  std::uint32_t height;
  std::uint32_t frames;  // 1..kMostFrames
  std::uint32_t dice;    // 0: adaptive; N: every patch N x N quads
  std::array<float, 3> background;
  float rate;            // frames a second
  Track camera;          // indices into cameras
};

// A film as vectors; pack() makes the block, FilmView reads it.
struct FilmData {
  FilmSettings settings{};
  std::vector<Patch> patches;
  std::vector<Shape> shapes;
  std::vector<Segment> segments;
  std::vector<Material> materials;
  std::vector<Matrix> matrices;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<Track> light_tracks;  // one a light of the film: indices into lights
  std::vector<Change> changes;
  std::vector<Interval> intervals;  // in order, covering every frame once
  std::vector<std::uint32_t> moving;
  std::vector<char> names;          // zero-ended strings: "actor/joint"
};

// The block, little-endian, every section aligned to 64 bytes. check()s that changes can be counted.
std::vector<std::byte> pack(const FilmData& film);

// Reads a packed film in place; the block must outlive it and be aligned to 8 bytes.
class FilmView {
 public:
  // Checks every count, index and range, so that no later access can go wrong, and that numbers are finite;
  // throws Failure("...", where, ...) otherwise. `trusted`: the block was checked before (by the host).
  FilmView(std::span<const std::byte> block, const std::string& where, bool trusted = false);

  const FilmSettings& settings() const { return *settings_; }
  std::span<const Patch> patches() const { return patches_; }
  std::span<const Shape> shapes() const { return shapes_; }
  std::span<const Segment> segments() const { return segments_; }
  std::span<const Material> materials() const { return materials_; }
  std::span<const Matrix> matrices() const { return matrices_; }
  std::span<const Camera> cameras() const { return cameras_; }
  std::span<const Light> lights() const { return lights_; }
  std::span<const Track> light_tracks() const { return light_tracks_; }
  std::span<const Change> changes() const { return changes_; }
  std::span<const Interval> intervals() const { return intervals_; }

  std::span<const std::uint32_t> moving(const Interval& interval) const;
  std::string_view name(const Segment& segment) const;

  // The index of the value a track has at `frame`.
  std::uint32_t value_at(const Track& track, std::uint32_t frame) const;
  const Matrix& matrix_at(const Segment& segment, std::uint32_t frame) const;
  const Material& material_at(const Segment& segment, std::uint32_t frame) const;
  const Camera& camera_at(std::uint32_t frame) const;

  // Patches of all segments together: the instances, as they are numbered and scattered.
  std::uint64_t patch_instances() const;

 private:
  void check_all(const std::string& where) const;

  const FilmSettings* settings_ = nullptr;
  std::span<const Patch> patches_;
  std::span<const Shape> shapes_;
  std::span<const Segment> segments_;
  std::span<const Material> materials_;
  std::span<const Matrix> matrices_;
  std::span<const Camera> cameras_;
  std::span<const Light> lights_;
  std::span<const Track> light_tracks_;
  std::span<const Change> changes_;
  std::span<const Interval> intervals_;
  std::span<const std::uint32_t> moving_;
  std::span<const char> names_;
};

}  // namespace mars::node
