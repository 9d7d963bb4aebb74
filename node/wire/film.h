// The compiled film: what a node knows of a film, and, byte for byte, the body of a .mars file. Model data
// (shapes, segments, materials) and motion data (only what changed, with the frame from which it holds),
// cut into render intervals. One contiguous block that a machine's nodes share; PackedFilm reads it in place,
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

// A film as vectors; pack() makes the block, PackedFilm reads it.
struct FilmData {
  FilmSettings settings{};
  std::vector<Patch> patches;
  std::vector<std::array<float, 3>> mesh_places;   // of vertices, in the unit cube
  std::vector<std::array<float, 3>> mesh_normals;  // to the outside, one a vertex; of any length, 0: none
  std::vector<MeshTriangle> mesh_triangles;
  std::vector<Meshlet> meshlets;
  std::vector<NetPoint> net_points;
  std::vector<StencilTerm> stencil_terms;
  std::vector<Stencil> stencils;
  std::vector<NetPatch> net_patches;
  std::vector<std::uint32_t> skin_bones;
  std::vector<float> skin_weights;
  std::vector<Shape> shapes;
  std::vector<Segment> segments;
  std::vector<Track> bones;  // of segments with skins: indices into matrices
  std::vector<Material> materials;
  std::vector<Matrix> matrices;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<Track> light_tracks;  // one a light of the film: indices into lights
  std::vector<Change> changes;
  std::vector<Interval> intervals;  // in order, covering every frame once
  std::vector<std::uint32_t> moving;
  std::vector<char> names;  // zero-ended strings: "actor/joint", materials
};

// The block, little-endian, every section aligned to 64 bytes. check()s that changes can be counted.
std::vector<std::byte> pack(const FilmData& film);

// The same for a block whose matrices already stand where they belong, `matrices` of them, kMatricesOffset bytes
// behind its beginning; those of `film` do not count. `resize` gives the block its size without changing what
// is in it, and returns where it begins.
inline constexpr std::size_t kMatricesOffset = 448;
void pack_around(const FilmData& film, std::size_t matrices,
                 const std::function<std::byte*(std::size_t bytes)>& resize);

// Whether it may stand in a film: finite, and not too large.
bool sound(const Matrix& matrix);
bool sound(const Patch& patch);

// Reads a packed film in place; the block must outlive it and be aligned to 8 bytes.
class PackedFilm {
 public:
  // Checks every count, index and range, so that no later access can go wrong, and that numbers are finite;
  // throws Failure("...", where, ...) otherwise. `trusted`: the block was checked before (by the host).
  PackedFilm(std::span<const std::byte> block, const std::string& where, bool trusted = false);
  // A scene block (scene.h) of `base`, whose block outlives it too. It is checked as well. Its shapes' skins are the
  // base's.
  PackedFilm(std::span<const std::byte> block, const PackedFilm& base, const std::string& where);

  const FilmSettings& settings() const { return *settings_; }
  // Of the block itself; of a scene, shape() and what follows it know the base's too.
  std::span<const Patch> patches() const { return patches_; }
  // Of places, normals and weights, kMeshSlack more than there are may be read, whatever they are.
  std::span<const std::array<float, 3>> mesh_places() const { return mesh_places_; }
  std::span<const std::array<float, 3>> mesh_normals() const { return mesh_normals_; }
  std::span<const MeshTriangle> mesh_triangles() const { return mesh_triangles_; }
  std::span<const Meshlet> meshlets() const { return meshlets_; }
  std::span<const NetPoint> net_points() const { return net_points_; }
  std::span<const StencilTerm> stencil_terms() const { return stencil_terms_; }
  std::span<const Stencil> stencils() const { return stencils_; }
  std::span<const NetPatch> net_patches() const { return net_patches_; }
  std::span<const std::uint32_t> skin_bones() const { return skin_bones_; }
  std::span<const float> skin_weights() const { return skin_weights_; }
  std::span<const Shape> shapes() const { return shapes_; }
  std::span<const Segment> segments() const { return segments_; }
  std::span<const Track> bones() const { return bones_; }
  std::span<const Material> materials() const { return materials_; }
  std::span<const Matrix> matrices() const { return matrices_; }
  std::span<const Camera> cameras() const { return cameras_; }
  std::span<const Light> lights() const { return lights_; }
  std::span<const Track> light_tracks() const { return light_tracks_; }
  // Whether the light of a track casts shadows, at all frames; and how many do.
  bool casts(const Track& light) const { return lights_[value_at(light, 0)].casts == 1; }
  std::uint32_t casting_count() const;
  std::span<const Change> changes() const { return changes_; }
  std::span<const Interval> intervals() const { return intervals_; }
  std::span<const char> names() const { return names_; }

  // By number, as segments have it: of a scene the base's come first.
  std::size_t shape_count() const { return base_shapes_.size() + shapes_.size(); }
  const Shape& shape(std::uint32_t number) const {
    return is_base(number) ? base_shapes_[number] : shapes_[number - base_shapes_.size()];
  }
  std::span<const Patch> patches_of(std::uint32_t shape_number) const {
    const Shape& of = shape(shape_number);
    return (is_base(shape_number) ? base_patches_ : patches_).subspan(of.first_patch, of.patch_count);
  }
  std::span<const Meshlet> meshlets_of(std::uint32_t shape_number) const {
    const Shape& of = shape(shape_number);
    return meshlets_.subspan(of.first_meshlet, of.meshlet_count);
  }

  // One a patch; none where the shape has no skin.
  std::span<const NetPatch> net_patches_of(const Shape& of) const {
    return of.bone_count > 0 ? net_patches_.subspan(of.first_net_patch, of.patch_count) : std::span<const NetPatch>{};
  }
  std::span<const NetPatch> net_patches_of(std::uint32_t shape_number) const {
    return net_patches_of(shape(shape_number));
  }
  std::span<const StencilTerm> terms_of(const Stencil& stencil) const {
    return stencil_terms_.subspan(stencil.first_term, stencil.term_count);
  }
  std::span<const std::uint32_t> bones_of(const Skin& skin) const {
    return skin_bones_.subspan(skin.first_bone, skin.bone_count);
  }
  std::span<const std::uint32_t> bones_of(const NetPatch& patch) const {
    return skin_bones_.subspan(patch.first_bone, patch.bone_count);
  }
  // That patch or meshlet number `piece` of a shape with a skin follows.
  std::span<const std::uint32_t> bones_of_piece(std::uint32_t shape_number, std::size_t piece) const;
  // Bone by bone, of `points` points each.
  std::span<const float> weights_of(const Skin& skin, std::uint32_t points) const {
    return skin_weights_.subspan(skin.first_weight, std::size_t{skin.bone_count} * points);
  }
  std::span<const Track> bones_of(const Segment& segment) const {
    return bones_.subspan(segment.first_bone, segment.bone_count);
  }

  const Interval& interval_at(std::uint32_t frame) const;
  // Segments and bones; and the segments alone.
  std::span<const std::uint32_t> moving(const Interval& interval) const;
  std::span<const std::uint32_t> moving_segments(const Interval& interval) const;
  std::string_view name(const Segment& segment) const;
  std::string_view material_name(const Segment& segment) const;

  // The index of the value a track has at `frame`.
  std::uint32_t value_at(const Track& track, std::uint32_t frame) const;
  const Matrix& matrix_at(const Track& motion, std::uint32_t frame) const;
  const Matrix& matrix_at(const Segment& segment, std::uint32_t frame) const {
    return matrix_at(segment.motion, frame);
  }
  const Material& material_at(const Segment& segment, std::uint32_t frame) const;
  const Camera& camera_at(std::uint32_t frame) const;

  // Patches and meshlets of all segments together: the instances, as they are numbered and scattered.
  std::uint64_t patch_instances() const;

 private:
  void read(std::span<const std::byte> block, const std::string& where);
  bool is_base(std::uint32_t shape_number) const { return shape_number < base_shapes_.size(); }
  void check_all(const std::string& where) const;
  void check_meshlets(const std::string& where) const;
  void check_bones(const Shape& shape, const std::string& where) const;
  void check_patch_bones(const NetPatch& patch, const std::string& where) const;
  void check_nets(const std::string& where) const;
  void check_bone_list(std::uint32_t first, std::uint32_t count, const std::string& where) const;
  void check_skin(const Skin& skin, std::uint32_t points, const std::string& where) const;
  void check_segments(const std::string& where) const;
  void check_intervals(const std::string& where) const;
  bool exposed_evenly(const Interval& interval) const;
  bool has_one_projection() const;

  std::span<const Patch> base_patches_;  // of a scene
  std::span<const Shape> base_shapes_;
  const FilmSettings* settings_ = nullptr;
  std::span<const Patch> patches_;
  std::span<const std::array<float, 3>> mesh_places_;
  std::span<const std::array<float, 3>> mesh_normals_;
  std::span<const MeshTriangle> mesh_triangles_;
  std::span<const Meshlet> meshlets_;
  std::span<const NetPoint> net_points_;
  std::span<const StencilTerm> stencil_terms_;
  std::span<const Stencil> stencils_;
  std::span<const NetPatch> net_patches_;
  std::span<const std::uint32_t> skin_bones_;
  std::span<const float> skin_weights_;
  std::span<const Shape> shapes_;
  std::span<const Segment> segments_;
  std::span<const Track> bones_;
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
