#include "tests/bench/peers/gl_shaders.h"

#include "tests/bench/peers/gl_parts.h"

namespace mars::bench {
namespace {

constexpr const char* kSurfaceVertex = R"(
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
uniform mat4x3 motion;
centroid out vec3 n;
#ifdef SHADOWS
out vec3 s;
#endif
#ifdef KEEPS
out float away;
#endif
void main() {
  vec3 p = motion * vec4(place, 1.0);
  gl_Position = vec4(LENS.x * p.x, -LENS.y * p.y, -LENS.z * p.z + LENS.w, -p.z);
  n = mat3(motion) * normal;
#ifdef SHADOWS
  s = in_map(p);
#endif
#ifdef KEEPS
  away = -p.z;
#endif
}
)";

// A vertex of a skin goes by the sum of its bones, which turn and shift only, each times its weight.
constexpr const char* kSkinVertex = R"(
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in uvec4 bone;
layout(location = 3) in vec4 weight;
uniform mat4x3 bones[BONES];
centroid out vec3 n;
void main() {
  mat4x3 m = weight.x * bones[bone.x] + weight.y * bones[bone.y] + weight.z * bones[bone.z] + weight.w * bones[bone.w];
  vec3 p = m * vec4(place, 1.0);
  gl_Position = vec4(LENS.x * p.x, -LENS.y * p.y, -LENS.z * p.z + LENS.w, -p.z);
  n = mat3(m) * normal;
}
)";

constexpr const char* kSurfaceFragment = R"(
centroid in vec3 n;
#ifdef SHADOWS
in vec3 s;
#endif
uniform vec3 own;
layout(location = 0) out vec4 pixel;
#ifdef KEEPS
in float away;
layout(location = 1) out vec4 base;
layout(location = 2) out vec4 term;
#endif
void main() {
  vec3 d = vec3(gl_FragCoord.x * REACH.x + REACH.y, REACH.z - gl_FragCoord.y * REACH.x, -1.0);
  float shrink = inversesqrt(dot(n, n)), toward = -inversesqrt(dot(d, d));
  float nl = dot(n, TO_LIGHT) * shrink;
  float nv = dot(n, d) * shrink * toward;
  float shine = nl > 0.0 ? clamp(2.0 * nl * nv - dot(d, TO_LIGHT) * toward, 0.0, 1.0) : 0.0;
  for (int k = 0; k < SQUARINGS; ++k) shine *= shine;
  float share = 1.0;
#ifdef SHADOWS
  share = arriving(s);
#endif
  pixel = vec4(own * (AMBIENT + share * DIFFUSE * LIGHT * max(nl, 0.0)) + share * SPECULAR * LIGHT * shine, 1.0);
#ifdef KEEPS
  base = vec4(own * AMBIENT, away);
  term = vec4(own * DIFFUSE * LIGHT * max(nl, 0.0) + SPECULAR * LIGHT * shine, 1.0);
#endif
}
)";

constexpr const char* kShadowVertex = R"(
void main() {
  gl_Position = vec4(gl_VertexID == 2 ? 3.0 : -1.0, gl_VertexID == 1 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

constexpr const char* kShadowFragment = R"(
uniform PICTURE bases, terms;
out vec4 pixel;
void main() {
  vec4 base = texelFetch(bases, ivec2(gl_FragCoord.xy), SAMPLE), term = texelFetch(terms, ivec2(gl_FragCoord.xy), SAMPLE);
  if (base.a == 0.0) discard;
  vec2 at = floor(gl_FragCoord.xy) + 0.5;  // where `away` was interpolated, also for several samples
  vec3 d = vec3(at.x * REACH.x + REACH.y, REACH.z - at.y * REACH.x, -1.0);
  pixel = vec4(base.rgb + arriving(in_map(base.a * d)) * term.rgb, 1.0);
}
)";

constexpr const char* kMapVertex = R"(
layout(location = 0) in vec3 place;
uniform mat4x3 motion;
void main() { gl_Position = vec4(2.0 * in_map(motion * vec4(place, 1.0)) - 1.0, 1.0); }
)";

constexpr const char* kMapFragment = "void main() {}\n";

// Where an eye's point is in the map.
constexpr const char* kInMap = R"(
vec3 in_map(vec3 p) { return vec3(dot(MAP_X.xyz, p) + MAP_X.w, dot(MAP_Y.xyz, p) + MAP_Y.w, dot(MAP_Z.xyz, p) + MAP_Z.w); }
)";

// Percentage closer filtering, 3 x 3 comparisons.
constexpr const char* kArriving = R"(
uniform sampler2DShadow map;
float arriving(vec3 s) {
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) sum += texture(map, vec3(s.xy + vec2(x, y) * TEXEL, s.z));
  return sum / 9.0;
}
)";

// LENS: scale over half the picture's width and height, depth z * w = c * z + d; REACH: of a pixel in the eye's plane
// at 1, and the upper left corner.
std::string numbers_of(const MeshHead& head) {
  const float far = 1000, near = head.near;
  const auto w = static_cast<float>(head.width), h = static_cast<float>(head.height);
  return defined("LENS", "vec4", 2 * head.scale / w, 2 * head.scale / h, (far + near) / (far - near),
                 -2 * far * near / (far - near)) +
         defined("REACH", "vec3", 1 / head.scale, -head.center[0] / head.scale, head.center[1] / head.scale) +
         defined("TO_LIGHT", "vec3", head.to_light[0], head.to_light[1], head.to_light[2]) +
         defined("LIGHT", "vec3", head.light[0], head.light[1], head.light[2]) +
         defined("AMBIENT", "float", head.ambient) + defined("DIFFUSE", "float", head.diffuse) +
         defined("SPECULAR", "float", head.specular) + defined("SQUARINGS", "int", head.squarings);
}

constexpr const char* kVersion = "#version 330 core\n";

Shaders surface_shaders(const std::string& numbers, const std::string& map) {
  if (map.empty()) return {numbers + kSurfaceVertex, numbers + kSurfaceFragment};
  const std::string shadows = numbers + "#define SHADOWS\n" + map;
  return {shadows + kInMap + kSurfaceVertex, shadows + kArriving + kSurfaceFragment};
}

}  // namespace

Shaders surface_shaders(const MeshHead& head, const std::string& map) {
  return surface_shaders(kVersion + numbers_of(head), map);
}

Shaders skin_shaders(const MeshHead& head, int bones) {
  const std::string numbers = kVersion + numbers_of(head) + "#define BONES " + std::to_string(bones) + "\n";
  return {numbers + kSkinVertex, numbers + kSurfaceFragment};
}

Shaders kept_surface_shaders(const MeshHead& head, const std::string& map) {
  return surface_shaders(kVersion + numbers_of(head) + "#define KEEPS\n", map);
}

Shaders shadow_shaders(const MeshHead& head, const std::string& map, int samples) {
  const std::string picture = samples == 0 ? "#define PICTURE sampler2D\n#define SAMPLE 0\n"
                                           : "#extension GL_ARB_sample_shading : require\n#define PICTURE sampler2DMS\n"
                                             "#define SAMPLE gl_SampleID\n";
  return {std::string(kVersion) + kShadowVertex,
          kVersion + picture + numbers_of(head) + map + kInMap + kArriving + kShadowFragment};
}

Shaders map_shaders(const std::string& map) {
  return {kVersion + map + kInMap + kMapVertex, std::string(kVersion) + kMapFragment};
}

}  // namespace mars::bench
