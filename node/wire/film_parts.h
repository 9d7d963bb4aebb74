// The parts of a compiled film (film.h): plain structs, as they lie in the block. Angles are gone here:
// matrices only.
//
// Units: world lengths; colours and light in the film's ColorSpace; frames count from 0.
#pragma once

#include <array>
#include <cstdint>

namespace mars::wire {

// Bumped whenever the layout or the meaning of a field changes; other versions are refused.
inline constexpr std::uint32_t kFilmVersion = 9;
inline constexpr std::uint32_t kMaxSide = 16384;         // pixels
inline constexpr std::uint32_t kMostMargin = 8192;       // pixels that are drawn beyond a side of the whole picture
inline constexpr std::uint32_t kMostFrames = 1'000'000;  // of a film
inline constexpr std::uint32_t kMostSamples = 16;        // of a pixel

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

// What a meshlet's vertices, or a net's point, follow: the bones skin_bones[first_bone, first_bone + bone_count), which
// are numbers among those of a segment, ascending; bone by bone, skin_weights from first_weight on have the weight of
// each point. A point has kMostPointBones weights above 0 at most, whose sum is 1.
struct Skin {
  std::uint32_t first_bone = 0;
  std::uint32_t bone_count = 0;  // 0: it is rigid; of a meshlet kMeshletBones at most
  std::uint32_t first_weight = 0;
};

inline constexpr std::uint32_t kMostPointBones = 4;
inline constexpr double kWeightRounding = 1e-6;  // of the sum of a point's weights, and of a mean's, from 1
inline constexpr std::uint32_t kPatchPoints = 16;
inline constexpr std::uint32_t kMeshletBones = 16;
static_assert(kMeshletBones >= 3 * kMostPointBones);  // any triangle has room

// Patches with a skin. Bones move the control points of a net, of a B-spline surface or a Catmull-Clark cage, in the
// unit cube; the patches' Bezier points are means of these, so what was smooth stays so however it is bent.
struct NetPoint {
  std::array<float, 3> place;
  Skin skin;  // of one point
};

// A mean: stencil_terms[first_term, first_term + term_count), ascending by point, with weights above 0 whose sum is 1.
struct Stencil {
  std::uint32_t first_term = 0;
  std::uint32_t term_count = 0;  // 1..kMostTerms

  bool operator==(const Stencil&) const = default;
};

struct StencilTerm {
  std::uint32_t point = 0;  // a number of net_points
  float weight = 0;

  bool operator==(const StencilTerm&) const = default;
};

inline constexpr std::uint32_t kMostTerms = 256;

// Numbers of stencils, in the order of Patch::points. Neighbours have the same.
using PatchStencils = std::array<std::uint32_t, kPatchPoints>;

// A patch that bends; the means' points follow skin_bones[first_bone, first_bone + bone_count), ascending.
struct NetPatch {
  PatchStencils stencils{};
  std::uint32_t first_bone = 0;
  std::uint32_t bone_count = 0;
};

// A part of a polygon mesh, of bounded size so that a mesh is divided over nodes as patches are: vertices
// [first_vertex, first_vertex + vertex_count) of the film's places and normals, and triangles whose corners count from
// first_vertex, counter-clockwise seen from outside. Meshlets that meet have vertices at the same places, bit for bit.
//
// With a skin its vertices follow bones; vertices at one place have the same weights, bit for bit, in all meshlets.
struct Meshlet {
  std::uint32_t first_vertex;
  std::uint32_t vertex_count;  // 1..kMeshletVertices
  std::uint32_t first_triangle;
  std::uint32_t triangle_count;  // 1..kMeshletTriangles
  std::array<float, 3> low;      // of the box round its vertices
  std::array<float, 3> high;
  Skin skin{};
};

inline constexpr std::uint32_t kMeshletVertices = 192;
inline constexpr std::uint32_t kMeshletTriangles = 128;

// Numbers of a meshlet's vertices.
using MeshTriangle = std::array<std::uint8_t, 3>;

// Its patches, then its meshlets; most shapes have one kind. Of a shape with a skin all have bones; its patches, which
// are as they stand at rest, bend as net_patches[first_net_patch, first_net_patch + patch_count) do.
struct Shape {
  std::uint32_t first_patch;
  std::uint32_t patch_count;
  std::uint32_t first_meshlet = 0;
  std::uint32_t meshlet_count = 0;
  std::uint32_t bone_count = 0;  // that a segment of it has at least; 0: it is rigid
  std::uint32_t first_net_patch = 0;

  std::uint64_t size() const { return std::uint64_t{patch_count} + meshlet_count; }
};

// How a skin's bones are blended at a point: by the sum of their matrices, each times its weight, or by dual
// quaternions (node/shape/dual_quaternion.h), which keep the volume where bones turn far against each other.
enum class Blend : std::uint32_t { linear, dual_quaternions };
inline constexpr Blend kLastBlend = Blend::dual_quaternions;

// One instance of a shape. `motion` gives indices into matrices: T-matrices from the unit cube to the world. Of a shape
// with a skin they are where the segment's joint would put it if it were rigid; what is drawn follows bones[first_bone,
// first_bone + bone_count), tracks of such matrices too: a vertex, or a net's point, goes by a blend of its bones.
// `material` gives indices into materials. Patches and meshlets of the whole film are numbered segment by segment.
struct Segment {
  std::uint32_t shape;
  std::uint32_t name;  // offset into names
  Track motion;
  Track material;
  std::uint32_t material_name = 0;  // offset into names: of what it is made of
  std::uint32_t first_bone = 0;
  std::uint32_t bone_count = 0;  // 0: it is rigid
  Blend blend = Blend::linear;   // of a skin
};

// What is interpolated over a triangle: its normal, shaded at each sample; or the colours of its vertices; or nothing,
// one colour for all of it (thesis 4.2).
enum class Interpolation : std::uint32_t { phong, gouraud, flat };

// How a surface reflects light (thesis 4.1).
enum class Reflection : std::uint32_t { phong, blinn_phong, cook_torrance, metallic_roughness };
inline constexpr Reflection kLastReflection = Reflection::metallic_roughness;

// What a reflection model does not name, it does not use.
struct Material {
  std::array<float, 3> color;  // 0..1
  float ambient;        // share of AmbientLight that is reflected, in the colour; by metallic_roughness mirrored too
  float diffuse;        // share of lights, in the colour; all but metallic_roughness
  float specular;       // strength of white highlights; all but metallic_roughness
  float exponent;       // phong's highlight is (R.V)^exponent, blinn_phong's (N.H)^exponent
  std::uint32_t sides;  // 1: seen from outside only; 2: the normal turns to the eye
  Interpolation interpolation = Interpolation::phong;
  Reflection reflection = Reflection::phong;
  float roughness = 0.5f;   // cook_torrance: Beckmann's m; metallic_roughness: glTF's
  float metallic = 0;       // metallic_roughness's, 0..1
  float refraction = 1.5f;  // cook_torrance's index, above 1
  // Of lights that cast shadows: 1 if surfaces of it block their light; 1 if their shadows fall on it. Nothing falls on
  // surfaces without Interpolation::phong.
  std::uint32_t casts = 1;
  std::uint32_t receives = 1;

  bool operator==(const Material&) const = default;
};

// What nodes take of a material's numbers.
struct MaterialBounds {
  float Material::*number;
  float least, most;
};
inline constexpr MaterialBounds kMaterialBounds[] = {
    {&Material::ambient, 0, 10},          {&Material::diffuse, 0, 10},  {&Material::specular, 0, 10},
    {&Material::exponent, 0, 65535},      {&Material::roughness, 0, 1}, {&Material::metallic, 0, 1},
    {&Material::refraction, 1.0001f, 100}};

enum class LightKind : std::uint32_t { directional, point, spot };
inline constexpr LightKind kLastLightKind = LightKind::spot;

// Light of a kind's colour at most, in the sum of what nodes compute always finite.
inline constexpr float kMostLight = 1e5f;

struct Light {
  LightKind kind;
  std::array<float, 3> vector;  // the unit direction to a directional light, else the light's place
  std::array<float, 3> color;   // times intensity, 0..kMostLight
  // A spot shines along this unit direction: fully within the inner cone, not at all outside the outer one, smoothly
  // between. Cosines of the cones' half angles, outer <= inner.
  std::array<float, 3> axis = {};
  float cos_inner = 1;
  float cos_outer = 1;
  // Where a point light or spot has half its brightness: at distance d it is 1 / (1 + (d / reach)^2). 0: it does not
  // fall off.
  float reach = 0;
  std::uint32_t casts = 0;  // 1: what stands before it throws a shadow
  // How large a light that casts is: of a directional one the tangent of half the angle that it takes up in the sky, of
  // others the radius of the ball that shines. 0: a point, whose shadows have sharp edges.
  float size = 0;

  bool operator==(const Light&) const = default;
};

// Light from all around, scaled by each material's `ambient`: from above `sky`, from below `ground`, by the z of the
// normal in the world evenly between them.
struct AmbientLight {
  std::array<float, 3> sky = {1, 1, 1};
  std::array<float, 3> ground = {1, 1, 1};

  bool operator==(const AmbientLight&) const = default;
};

// Surfaces take on the fog's colour evenly from `start` to `end`, distances along the view axis; none if end <= start.
struct Fog {
  std::array<float, 3> color = {};
  float start = 0;
  float end = 0;

  bool operator==(const Fog&) const = default;
};

// coded: colours are numbers as they are shown, lit as if they were light. linear: they are light, which exposure, a
// curve and sRGB's encoding make pixels of.
enum class ColorSpace : std::uint32_t { coded, linear };

// From exposed light to what is shown of it, both linear.
enum class Curve : std::uint32_t { none, filmic, agx };
inline constexpr Curve kLastCurve = Curve::agx;

// Rays meet in the eye, or all run along the view axis. A panorama shows all directions from the eye: nodes draw its
// six faces, a film of their own in perspective (host/content/film/panorama.h), and of the panorama itself, for a
// studio's view, what is in front. As wide as Camera's other members.
enum class Projection : std::uint64_t { perspective, orthographic, panorama };
inline constexpr Projection kLastProjection = Projection::panorama;

inline constexpr double kMostShift = 1;  // of a picture's width or height

// The eye looks along -z of its own frame, x to the right, y up. The whole picture shows 2 / `focal` of the height at
// distance 1, or, if orthographic, at every distance. Nothing nearer than near or farther than far is drawn.
struct Camera {
  Matrix world_to_eye;
  double focal;
  double near;
  double far;
  double exposure = 1;  // light is multiplied by it; the same throughout a render interval
  // How far the picture is moved over the image plane from where the view axis meets it, in widths to the right and in
  // heights up; kMostShift at most.
  double shift_x = 0;
  double shift_y = 0;
  Projection projection = Projection::perspective;  // the same throughout a film

  bool operator==(const Camera&) const = default;
};

// Frames [first_frame, first_frame + frame_count) over which the same segments and bones move and all others stand
// still, unseen by a moving camera or light. Those that move are moving[first_moving, first_moving + moving_count), in
// ascending order: numbers of segments; then, each plus the number of all segments, of bones. Of a segment with a skin
// its patches and meshlets move that follow a bone which does. If camera or light move, every segment and bone is
// listed.
struct Interval {
  std::uint32_t first_frame;
  std::uint32_t frame_count;
  std::uint32_t first_moving;
  std::uint32_t moving_count;
};

// Where the picture that is drawn lies in the one that the camera sees, which may be larger, or smaller: its left top
// pixel, and the size of the whole; a width of 0: it is the whole.
struct PictureWindow {
  std::int32_t left = 0;  // -kMostMargin..kMaxSide - 1
  std::int32_t top = 0;
  std::uint32_t whole_width = 0;  // pixels, 1..kMaxSide
  std::uint32_t whole_height = 0;

  bool is_whole() const { return whole_width == 0; }
  bool operator==(const PictureWindow&) const = default;
};

inline constexpr float kMostPixelAspect = 16;  // and its inverse the least

struct FilmSettings {
  std::uint32_t width;  // pixels that are drawn, 1..kMaxSide
  std::uint32_t height;
  std::uint32_t frames;  // 1..kMostFrames
  std::uint32_t dice;    // 0: adaptive; N: every patch N x N quads
  std::array<float, 3> background;
  float rate;                 // frames a second
  Track camera;               // indices into cameras
  std::uint32_t samples = 1;  // a pixel: 1, 2, 4, 8 or 16
  ColorSpace color_space = ColorSpace::coded;
  Curve curve = Curve::none;  // of linear films
  AmbientLight ambient{};
  Fog fog{};
  PictureWindow window{};
  float pixel_aspect = 1;  // width of a pixel by its height

  // The size of the picture that the camera sees.
  std::uint32_t whole_width() const { return window.is_whole() ? width : window.whole_width; }
  std::uint32_t whole_height() const { return window.is_whole() ? height : window.whole_height; }
};

}  // namespace mars::wire
