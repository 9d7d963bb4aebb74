// The compiled film: what a node knows of a film, and, byte for byte, the body of a .mars file. Model data
// (shapes, segments, materials) and motion data (only what changed, with the frame from which it holds),
// cut into render intervals. One contiguous block that a machine's nodes share; FilmView reads it in place,
// FilmData is the same film in vectors, from which the block is made.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "node/wire/film_parts.h"

namespace mars::wire {

// Vertices that vectors may read behind those of a mesh.
inline constexpr std::size_t kMeshSlack = 16;

// A film as vectors; pack() makes the block, FilmView reads it.
struct FilmData {
  FilmSettings settings{};
  std::vector<Patch> patches;
  std::vector<std::array<float, 3>> mesh_places;   // of vertices, in the unit cube
  std::vector<std::array<float, 3>> mesh_normals;  // to the outside, one a vertex; of any length, 0: none
  std::vector<MeshTriangle> mesh_triangles;
  std::vector<Meshlet> meshlets;
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
  std::vector<char> names;  // zero-ended strings: "actor/joint"
};

// The block, little-endian, every section aligned to 64 bytes. check()s that changes can be counted.
std::vector<std::byte> pack(const FilmData& film);

// The same for a block whose matrices already stand where they belong, `matrices` of them, kMatricesOffset bytes
// behind its beginning; those of `film` do not count. `resize` gives the block its size without changing what
// is in it, and returns where it begins.
inline constexpr std::size_t kMatricesOffset = 320;
void pack_around(const FilmData& film, std::size_t matrices,
                 const std::function<std::byte*(std::size_t bytes)>& resize);

// Reads a packed film in place; the block must outlive it and be aligned to 8 bytes.
class FilmView {
 public:
  // Checks every count, index and range, so that no later access can go wrong, and that numbers are finite;
  // throws Failure("...", where, ...) otherwise. `trusted`: the block was checked before (by the host).
  FilmView(std::span<const std::byte> block, const std::string& where, bool trusted = false);

  const FilmSettings& settings() const { return *settings_; }
  std::span<const Patch> patches() const { return patches_; }
  // Of places and normals, kMeshSlack more than there are may be read, whatever they are.
  std::span<const std::array<float, 3>> mesh_places() const { return mesh_places_; }
  std::span<const std::array<float, 3>> mesh_normals() const { return mesh_normals_; }
  std::span<const MeshTriangle> mesh_triangles() const { return mesh_triangles_; }
  std::span<const Meshlet> meshlets() const { return meshlets_; }
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

  // Patches and meshlets of all segments together: the instances, as they are numbered and scattered.
  std::uint64_t patch_instances() const;

 private:
  void check_all(const std::string& where) const;
  void check_meshlets(const std::string& where) const;
  void check_segments(const std::string& where) const;
  void check_intervals(const std::string& where) const;
  bool exposed_evenly(const Interval& interval) const;

  const FilmSettings* settings_ = nullptr;
  std::span<const Patch> patches_;
  std::span<const std::array<float, 3>> mesh_places_;
  std::span<const std::array<float, 3>> mesh_normals_;
  std::span<const MeshTriangle> mesh_triangles_;
  std::span<const Meshlet> meshlets_;
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

}  // namespace mars::wire
