#include "node/wire/film.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>

#include "hal/failure/failure.h"

namespace mars::wire {
namespace {

static_assert(std::endian::native == std::endian::little, "the film block is little-endian and read in place");

constexpr std::array<char, 8> kFilmMagic = {'M', 'A', 'R', 'S', 'F', 'I', 'L', 'M'};
constexpr std::size_t kAlignment = 64;
constexpr std::size_t kSlack = kMeshSlack * sizeof(std::array<float, 3>);  // bytes behind every section
constexpr double kLargest = 1e12;  // of any number in a film: squares and products stay far inside a float

// clang-format off
enum Section : std::size_t {
  kSettings, kPatches, kMeshPlaces, kMeshNormals, kMeshTriangles, kMeshlets, kNetPoints, kStencilTerms, kStencils,
  kNetPatches, kSkinBones, kSkinWeights, kShapes, kSegments, kBones, kMaterials, kMatrices, kCameras, kLights,
  kLightTracks, kChanges, kIntervals, kMoving, kNames, kSections
};
// clang-format on

struct Place {
  std::uint64_t offset;
  std::uint64_t count;
};

struct Header {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t sections;
  std::array<Place, kSections> place;
};

static_assert(sizeof(Header) <= kMatricesOffset && kMatricesOffset % kAlignment == 0);

std::size_t aligned(std::size_t offset) { return (offset + kAlignment - 1) / kAlignment * kAlignment; }

void require(bool holds, const std::string& where, const char* what) {
  if (holds) return;
  throw Failure(std::string("is not a sound compiled film: ") + what, where,
                "compile the film again with `mars compile`");
}

template <typename T>
std::span<const T> section(std::span<const std::byte> block, const Place& place, const std::string& where) {
  const std::size_t end = block.size() - kSlack;
  const bool inside =
      place.offset % kAlignment == 0 && place.offset <= end && place.count <= (end - place.offset) / sizeof(T);
  require(inside, where, "a section lies outside the file");
  return {reinterpret_cast<const T*>(block.data() + place.offset), static_cast<std::size_t>(place.count)};
}

Header read_header(std::span<const std::byte> block, const std::string& where) {
  Header header;
  require(block.size() >= sizeof header + kSlack, where, "it is too short");
  std::memcpy(&header, block.data(), sizeof header);
  require(header.magic == kFilmMagic, where, "it does not begin as one");
  require(header.version == kFilmVersion, where, "it has another version");
  require(header.sections == kSections, where, "it has another number of sections");
  return header;
}

template <typename Range>
bool all_finite(const Range& numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](auto number) { return number >= -kLargest && number <= kLargest; });
}

bool is_light(const std::array<float, 3>& color) {
  return std::ranges::all_of(color, [](float channel) { return channel >= 0 && channel <= kMostLight; });
}

bool is_share(float number) { return number >= 0 && number <= 1; }

// Whether `size` pixels from `first` on lie within `whole` ones and kMostMargin on either side.
bool is_beside(std::int32_t first, std::uint32_t size, std::uint32_t whole) {
  constexpr std::int64_t kMargin = kMostMargin;
  return first >= -kMargin && std::int64_t{first} + size <= std::int64_t{whole} + kMargin;
}

bool sound(const PictureWindow& window, std::uint32_t width, std::uint32_t height) {
  if (window.is_whole()) return window == PictureWindow();
  return window.whole_width <= kMaxSide && window.whole_height >= 1 && window.whole_height <= kMaxSide &&
         is_beside(window.left, width, window.whole_width) && is_beside(window.top, height, window.whole_height);
}

bool sound(const FilmSettings& s) {
  return s.width >= 1 && s.width <= kMaxSide && s.height >= 1 && s.height <= kMaxSide && s.frames >= 1 &&
         s.frames <= kMostFrames && s.dice <= 256 && is_light(s.background) && s.rate > 0 && s.rate <= 1e6f &&
         std::has_single_bit(s.samples) && s.samples <= kMostSamples && s.color_space <= ColorSpace::linear &&
         s.curve <= kLastCurve && is_light(s.ambient.sky) && is_light(s.ambient.ground) && is_light(s.fog.color) &&
         all_finite(std::array{s.fog.start, s.fog.end}) && sound(s.window, s.width, s.height) &&
         s.pixel_aspect >= 1 / kMostPixelAspect && s.pixel_aspect <= kMostPixelAspect;
}

bool sound(const Material& m) {
  return std::ranges::all_of(m.color, is_share) &&
         std::ranges::all_of(
             kMaterialBounds,
             [&](const MaterialBounds& each) { return m.*each.number >= each.least && m.*each.number <= each.most; }) &&
         (m.sides == 1 || m.sides == 2) && m.interpolation <= Interpolation::flat && m.reflection <= kLastReflection &&
         m.casts <= 1 && m.receives <= 1;
}

}  // namespace

bool sound(const Matrix& matrix) {
  return std::all_of(matrix.m.begin(), matrix.m.end(), [](const auto& row) { return all_finite(row); });
}

bool sound(const Patch& patch) {
  return std::all_of(patch.points.begin(), patch.points.end(), [](const auto& p) { return all_finite(p); });
}

namespace {

bool sound(const Camera& camera) {
  return sound(camera.world_to_eye) && camera.focal > 0 && camera.focal <= 1e6 && camera.near >= 1e-9 &&
         camera.far > camera.near && camera.far <= kLargest && camera.exposure > 0 && camera.exposure <= 1e6 &&
         std::abs(camera.shift_x) <= kMostShift && std::abs(camera.shift_y) <= kMostShift &&
         camera.projection <= kLastProjection;
}

bool sound(const Light& light) {
  return light.kind <= kLastLightKind && all_finite(light.vector) && is_light(light.color) && all_finite(light.axis) &&
         light.cos_outer >= -1 && light.cos_outer <= light.cos_inner && light.cos_inner <= 1 && light.reach >= 0 &&
         light.reach <= kLargest && light.casts <= 1 && light.size >= 0 && light.size <= kLargest;
}

bool sound(const std::array<float, 3>& vector) { return all_finite(vector); }

template <typename T>
bool all_sound(std::span<const T> items) {
  return std::all_of(items.begin(), items.end(), [](const T& item) { return sound(item); });
}

// Whether [first, first + count) lies within `size`.
bool within(std::uint64_t first, std::uint64_t count, std::size_t size) { return first + count <= size; }

bool inside(const std::array<float, 3>& place, const Meshlet& box) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(box.low[axis] <= place[axis] && place[axis] <= box.high[axis])) return false;
  return true;
}

// Whether a track lies within `changes`, starts at frame 0, ascends, and names values below `values`.
bool sound(const Track& track, std::span<const Change> changes, std::size_t values) {
  if (track.count == 0 || track.first > changes.size() || track.count > changes.size() - track.first) return false;
  const auto steps = changes.subspan(track.first, track.count);
  const auto not_later = [](const Change& a, const Change& b) { return a.frame >= b.frame; };
  return steps[0].frame == 0 && std::adjacent_find(steps.begin(), steps.end(), not_later) == steps.end() &&
         std::all_of(steps.begin(), steps.end(), [&](const Change& c) { return c.value < values; });
}

}  // namespace

std::vector<std::byte> pack(const FilmData& film) {
  std::vector<std::byte> block;
  pack_around(film, film.matrices.size(), [&](std::size_t bytes) {
    block.resize(bytes);
    return block.data();
  });
  const auto matrices = std::as_bytes(std::span(film.matrices));
  std::copy(matrices.begin(), matrices.end(), block.begin() + kMatricesOffset);
  return block;
}

void pack_around(const FilmData& film, std::size_t matrices,
                 const std::function<std::byte*(std::size_t bytes)>& resize) {
  check(film.changes.size() <= std::numeric_limits<std::uint32_t>::max(), "a film's changes fit 32 bits");
  const std::array settings{film.settings};
  const auto each_section = [&](const auto& visit) {
    visit(kSettings, settings);
    visit(kPatches, film.patches);
    visit(kMeshPlaces, film.mesh_places);
    visit(kMeshNormals, film.mesh_normals);
    visit(kMeshTriangles, film.mesh_triangles);
    visit(kMeshlets, film.meshlets);
    visit(kNetPoints, film.net_points);
    visit(kStencilTerms, film.stencil_terms);
    visit(kStencils, film.stencils);
    visit(kNetPatches, film.net_patches);
    visit(kSkinBones, film.skin_bones);
    visit(kSkinWeights, film.skin_weights);
    visit(kShapes, film.shapes);
    visit(kSegments, film.segments);
    visit(kBones, film.bones);
    visit(kMaterials, film.materials);
    visit(kCameras, film.cameras);
    visit(kLights, film.lights);
    visit(kLightTracks, film.light_tracks);
    visit(kChanges, film.changes);
    visit(kIntervals, film.intervals);
    visit(kMoving, film.moving);
    visit(kNames, film.names);
  };
  Header header{kFilmMagic, kFilmVersion, kSections, {}};
  header.place[kMatrices] = {kMatricesOffset, matrices};
  std::size_t end = kMatricesOffset + matrices * sizeof(Matrix);
  each_section([&](Section number, const auto& items) {
    header.place[number] = {aligned(end), items.size()};
    end = aligned(end) + std::as_bytes(std::span(items)).size();
  });
  const std::size_t bytes = aligned(end + kSlack);
  std::byte* const block = resize(bytes);
  std::memset(block, 0, kMatricesOffset);
  std::memcpy(block, &header, sizeof header);
  std::size_t written = kMatricesOffset + matrices * sizeof(Matrix);
  each_section([&](Section number, const auto& items) {
    const auto from = std::as_bytes(std::span(items));
    const std::size_t offset = header.place[number].offset;
    std::memset(block + written, 0, offset - written);
    if (!from.empty()) std::memcpy(block + offset, from.data(), from.size());
    written = offset + from.size();
  });
  std::memset(block + written, 0, bytes - written);
}

PackedFilm::PackedFilm(std::span<const std::byte> block, const std::string& where, bool trusted) {
  read(block, where);
  if (!trusted) check_all(where);
}

PackedFilm::PackedFilm(std::span<const std::byte> block, const PackedFilm& base, const std::string& where)
    : base_patches_(base.patches_), base_shapes_(base.shapes_) {
  read(block, where);
  require(settings_->frames == 1, where, "a scene is one moment");
  require(mesh_places_.empty() && mesh_normals_.empty() && mesh_triangles_.empty() && meshlets_.empty(), where,
          "a scene has no meshes");
  require(net_points_.empty() && stencil_terms_.empty() && stencils_.empty() && net_patches_.empty() &&
              skin_bones_.empty() && skin_weights_.empty(),
          where, "a scene has no skins");
  check_all(where);
  net_points_ = base.net_points_;
  stencil_terms_ = base.stencil_terms_;
  stencils_ = base.stencils_;
  net_patches_ = base.net_patches_;
  skin_bones_ = base.skin_bones_;
  skin_weights_ = base.skin_weights_;
  mesh_places_ = base.mesh_places_;
  mesh_normals_ = base.mesh_normals_;
  mesh_triangles_ = base.mesh_triangles_;
  meshlets_ = base.meshlets_;
}

void PackedFilm::read(std::span<const std::byte> block, const std::string& where) {
  const Header header = read_header(block, where);
  const auto read = [&]<typename T>(Section number, std::span<const T>& items) {
    items = section<T>(block, header.place[number], where);
  };
  const auto settings = section<FilmSettings>(block, header.place[kSettings], where);
  require(settings.size() == 1, where, "it has no settings");
  settings_ = settings.data();
  read(kPatches, patches_);
  read(kMeshPlaces, mesh_places_);
  read(kMeshNormals, mesh_normals_);
  read(kMeshTriangles, mesh_triangles_);
  read(kMeshlets, meshlets_);
  read(kNetPoints, net_points_);
  read(kStencilTerms, stencil_terms_);
  read(kStencils, stencils_);
  read(kNetPatches, net_patches_);
  read(kSkinBones, skin_bones_);
  read(kSkinWeights, skin_weights_);
  read(kShapes, shapes_);
  read(kSegments, segments_);
  read(kBones, bones_);
  read(kMaterials, materials_);
  read(kMatrices, matrices_);
  read(kCameras, cameras_);
  read(kLights, lights_);
  read(kLightTracks, light_tracks_);
  read(kChanges, changes_);
  read(kIntervals, intervals_);
  read(kMoving, moving_);
  read(kNames, names_);
}

void PackedFilm::check_all(const std::string& where) const {
  require(sound(*settings_), where, "its settings are out of range");
  require(all_sound(patches_), where, "a patch is not finite");
  require(all_sound(materials_), where, "a material is out of range");
  require(all_sound(matrices_), where, "a matrix is not finite");
  require(all_sound(cameras_), where, "a camera is out of range");
  require(all_sound(lights_), where, "a light is out of range");
  require(names_.empty() ? segments_.empty() : names_.back() == '\0', where, "its names do not end");
  require(sound(settings_->camera, changes_, cameras_.size()), where, "the camera's track is broken");
  require(has_one_projection(), where, "the camera changes its projection");
  for (const Track& track : light_tracks_)
    require(sound(track, changes_, lights_.size()), where, "a light's track is broken");
  check_meshlets(where);
  check_nets(where);
  check_segments(where);
  check_intervals(where);
}

void PackedFilm::check_segments(const std::string& where) const {
  for (const Shape& shape : shapes_) {
    require(within(shape.first_patch, shape.patch_count, patches_.size()), where, "a shape has no such patches");
    require(within(shape.first_meshlet, shape.meshlet_count, meshlets_.size()), where, "a shape has no such meshlets");
    check_bones(shape, where);
  }
  for (const Segment& segment : segments_) {
    require(segment.shape < shape_count(), where, "a segment has no such shape");
    require(segment.name < names_.size() && segment.material_name < names_.size(), where, "a segment has no such name");
    require(segment.blend <= kLastBlend, where, "a segment's blend is unknown");
    require(sound(segment.motion, changes_, matrices_.size()), where, "a segment's motion is broken");
    require(sound(segment.material, changes_, materials_.size()), where, "a segment's material is broken");
    const std::uint32_t bones = shape(segment.shape).bone_count;
    require((bones > 0) == (segment.bone_count > 0) && bones <= segment.bone_count &&
                within(segment.first_bone, segment.bone_count, bones_.size()),
            where, "a segment has no such bones");
  }
  for (const Track& bone : bones_) require(sound(bone, changes_, matrices_.size()), where, "a bone's motion is broken");
  require(patch_instances() <= std::numeric_limits<std::uint32_t>::max(), where, "it has too many patches");
}

void PackedFilm::check_bones(const Shape& shape, const std::string& where) const {
  const auto check_bones = [&](const Skin& skin) {
    require((skin.bone_count > 0) == (shape.bone_count > 0), where, "a shape has parts with and without a skin");
    if (skin.bone_count > 0) require(bones_of(skin).back() < shape.bone_count, where, "a skin has no such bones");
  };
  for (const Meshlet& meshlet : meshlets_.subspan(shape.first_meshlet, shape.meshlet_count)) check_bones(meshlet.skin);
  if (shape.bone_count == 0) return;
  require(within(shape.first_net_patch, shape.patch_count, net_patches_.size()), where, "a shape has no such net");
  for (const NetPatch& patch : net_patches_of(shape)) {
    for (const std::uint32_t stencil : patch.stencils)
      for (const StencilTerm& term : terms_of(stencils_[stencil])) check_bones(net_points_[term.point].skin);
    check_patch_bones(patch, where);
  }
}

// Of all its points, and no other.
void PackedFilm::check_patch_bones(const NetPatch& patch, const std::string& where) const {
  require(patch.bone_count <= kPatchPoints * kMostTerms * kMostPointBones, where, "a net's patch has too many bones");
  const auto bones = bones_of(patch);
  std::vector<bool> followed(bones.size());
  for (const std::uint32_t stencil : patch.stencils)
    for (const StencilTerm& term : terms_of(stencils_[stencil]))
      for (const std::uint32_t bone : bones_of(net_points_[term.point].skin)) {
        const auto known = std::ranges::lower_bound(bones, bone);
        require(known != bones.end() && *known == bone, where, "a net's patch lacks a bone");
        followed[static_cast<std::size_t>(known - bones.begin())] = true;
      }
  require(std::ranges::count(followed, false) == 0, where, "a net's patch has a bone that its points do not follow");
}

void PackedFilm::check_nets(const std::string& where) const {
  for (const NetPoint& point : net_points_) {
    require(sound(point.place), where, "a net's point is not finite");
    require(point.skin.bone_count >= 1, where, "a net's point follows nothing");
    check_skin(point.skin, 1, where);
  }
  for (const Stencil& stencil : stencils_) {
    require(stencil.term_count >= 1 && stencil.term_count <= kMostTerms &&
                within(stencil.first_term, stencil.term_count, stencil_terms_.size()),
            where, "a stencil has no such terms");
    double sum = 0;
    std::int64_t last = -1;
    for (const StencilTerm& term : terms_of(stencil)) {
      require(term.point < net_points_.size() && term.point > last && term.weight > 0, where, "a term is out of range");
      sum += term.weight, last = term.point;
    }
    require(std::abs(sum - 1) <= kWeightRounding, where, "a stencil's weights do not add up to 1");
  }
  for (const NetPatch& patch : net_patches_) {
    check_bone_list(patch.first_bone, patch.bone_count, where);
    for (const std::uint32_t stencil : patch.stencils)
      require(stencil < stencils_.size(), where, "a net's patch has no such stencil");
  }
}

void PackedFilm::check_intervals(const std::string& where) const {
  std::uint64_t next = 0;
  for (const Interval& interval : intervals_) {
    require(interval.first_frame == next && interval.frame_count > 0, where, "its intervals leave a gap");
    next += interval.frame_count;
    const bool inside =
        interval.first_moving <= moving_.size() && interval.moving_count <= moving_.size() - interval.first_moving;
    require(inside, where, "an interval has no such moving parts");
    const auto list = moving(interval);
    const bool ascending = std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
    const bool known = list.empty() || list.back() < segments_.size() + bones_.size();
    require(ascending && known, where, "an interval's movers are broken");
    require(exposed_evenly(interval), where, "its exposure changes within an interval");
  }
  require(next == settings_->frames, where, "its intervals do not cover its frames");
}

bool PackedFilm::exposed_evenly(const Interval& interval) const {
  const double exposure = camera_at(interval.first_frame).exposure;
  return std::ranges::all_of(changes_.subspan(settings_->camera.first, settings_->camera.count), [&](const Change& c) {
    const bool within = c.frame > interval.first_frame && c.frame - interval.first_frame < interval.frame_count;
    return !within || cameras_[c.value].exposure == exposure;
  });
}

void PackedFilm::check_meshlets(const std::string& where) const {
  require(all_sound(mesh_places_) && all_sound(mesh_normals_), where, "a mesh is not finite");
  require(mesh_places_.size() == mesh_normals_.size(), where, "a mesh lacks normals");
  for (const Meshlet& m : meshlets_) {
    require(sound(m.low) && sound(m.high), where, "a meshlet's box is not finite");
    require(m.vertex_count >= 1 && m.vertex_count <= kMeshletVertices && m.triangle_count >= 1 &&
                m.triangle_count <= kMeshletTriangles,
            where, "a meshlet is out of range");
    require(within(m.first_vertex, m.vertex_count, mesh_places_.size()), where, "a meshlet has no such vertices");
    require(within(m.first_triangle, m.triangle_count, mesh_triangles_.size()), where,
            "a meshlet has no such triangles");
    for (const auto& place : mesh_places_.subspan(m.first_vertex, m.vertex_count))
      require(inside(place, m), where, "a meshlet leaves its box");
    for (const MeshTriangle& triangle : mesh_triangles_.subspan(m.first_triangle, m.triangle_count))
      for (const std::uint8_t corner : triangle)
        require(corner < m.vertex_count, where, "a triangle has no such vertex");
    require(m.skin.bone_count <= kMeshletBones, where, "a meshlet has too many bones");
    check_skin(m.skin, m.vertex_count, where);
  }
}

void PackedFilm::check_bone_list(std::uint32_t first, std::uint32_t count, const std::string& where) const {
  require(within(first, count, skin_bones_.size()), where, "a skin has no such bones");
  const auto bones = skin_bones_.subspan(first, count);
  require(std::ranges::adjacent_find(bones, std::greater_equal<>()) == bones.end(), where,
          "a skin's bones do not ascend");
}

void PackedFilm::check_skin(const Skin& skin, std::uint32_t points, const std::string& where) const {
  check_bone_list(skin.first_bone, skin.bone_count, where);
  const std::uint64_t weights = std::uint64_t{skin.bone_count} * points;
  require(within(skin.first_weight, weights, skin_weights_.size()), where, "a skin has no such weights");
  const auto all = weights_of(skin, points);
  require(std::ranges::all_of(all, is_share), where, "a weight is not within 0 and 1");
  for (std::uint32_t point = 0; point < points && skin.bone_count > 0; ++point) {
    double sum = 0;
    std::uint32_t count = 0;
    for (std::size_t at = point; at < weights; at += points) sum += all[at], count += all[at] > 0;
    require(count <= kMostPointBones && std::abs(sum - 1) <= kWeightRounding, where,
            "a point's weights do not add up to 1, or are too many");
  }
}

const Interval& PackedFilm::interval_at(std::uint32_t frame) const {
  return *std::prev(std::ranges::upper_bound(intervals_, frame, {}, &Interval::first_frame));
}

std::span<const std::uint32_t> PackedFilm::moving(const Interval& interval) const {
  return moving_.subspan(interval.first_moving, interval.moving_count);
}

std::span<const std::uint32_t> PackedFilm::moving_segments(const Interval& interval) const {
  const auto all = moving(interval);
  return {all.begin(), std::ranges::lower_bound(all, segments_.size())};
}

std::span<const std::uint32_t> PackedFilm::bones_of_piece(std::uint32_t shape_number, std::size_t piece) const {
  const std::uint32_t patches = shape(shape_number).patch_count;
  return piece < patches ? bones_of(net_patches_of(shape_number)[piece])
                         : bones_of(meshlets_of(shape_number)[piece - patches].skin);
}

std::string_view PackedFilm::name(const Segment& segment) const { return names_.data() + segment.name; }

std::string_view PackedFilm::material_name(const Segment& segment) const {
  return names_.data() + segment.material_name;
}

std::uint32_t PackedFilm::value_at(const Track& track, std::uint32_t frame) const {
  const auto steps = changes_.subspan(track.first, track.count);
  const auto later = std::upper_bound(steps.begin(), steps.end(), frame,
                                      [](std::uint32_t f, const Change& change) { return f < change.frame; });
  return std::prev(later)->value;
}

const Matrix& PackedFilm::matrix_at(const Track& motion, std::uint32_t frame) const {
  return matrices_[value_at(motion, frame)];
}

std::uint32_t PackedFilm::casting_count() const {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(light_tracks_, [this](const Track& light) { return casts(light); }));
}

const Material& PackedFilm::material_at(const Segment& segment, std::uint32_t frame) const {
  return materials_[value_at(segment.material, frame)];
}

bool PackedFilm::has_one_projection() const {
  return std::ranges::all_of(changes_.subspan(settings_->camera.first, settings_->camera.count),
                             [&](const Change& c) { return cameras_[c.value].projection == camera_at(0).projection; });
}

const Camera& PackedFilm::camera_at(std::uint32_t frame) const { return cameras_[value_at(settings_->camera, frame)]; }

std::uint64_t PackedFilm::patch_instances() const {
  std::uint64_t patches = 0;
  for (const Segment& segment : segments_) patches += shape(segment.shape).size();
  return patches;
}

}  // namespace mars::wire
