// Embree as a competitor: peer-embree MESH THREADS whole|inbetween. How it was made fast: README.md.
//
// Rays start in packets of 16 from one eye. What moves is a scene of its own in its place at frame 0: rays are turned
// instead of its tree. Every view's z is its rays' parameter, so views can be compared.
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "tests/bench/peers/cover.h"
#include "tests/bench/peers/crew.h"
#include "tests/bench/peers/mesh.h"
#include "tests/bench/peers/peer.h"

namespace mars::bench {
namespace {

constexpr int kPacket = 16;
constexpr int kPacketWidth = 4, kPacketHeight = 4;
using Floats [[gnu::vector_size(4 * kPacket)]] = float;
using Ints [[gnu::vector_size(4 * kPacket)]] = int;
constexpr Ints kColumn{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
constexpr Ints kLine{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
constexpr int kTile = 16;  // pixels; a multiple of a packet's sides

// A triangle's normals: the first corner's, and the differences of the others to it.
struct alignas(16) Normals {
  float first[3], to_second[3], to_third[3];
  std::uint32_t look;
};

// A scene of Embree's with its triangles' normals, and the eye and light as that scene has them.
struct View {
  RTCScene scene;
  std::vector<Normals> normals;
  std::vector<Outline> outlines;    // of its patches
  std::vector<std::uint8_t> tiles;  // 1: a ray there may meet it
  float origin[3];
  float ahead[3], right[3], up[3];  // a ray's direction: ahead + x * right + y * up, of length 1 along the eye's axis
  float to_light[3];
};

template <typename Vector, typename Number>
Vector got(const Number (&from)[kPacket]) {
  return *reinterpret_cast<const Vector*>(from);  // Embree aligns them
}

template <typename Vector, typename Number>
void put(Number (&to)[kPacket], Vector value) {
  *reinterpret_cast<Vector*>(to) = value;
}

unsigned mask_of(Ints truths) {
  unsigned mask = 0;
  for (int k = 0; k < kPacket; ++k) mask |= truths[k] < 0 ? 1u << k : 0u;
  return mask;
}

bool any(Ints truths) { return mask_of(truths) != 0; }

Floats inverse_root(Floats square) {
  for (int k = 0; k < kPacket; ++k) square[k] = 1 / std::sqrt(square[k]);
  return square;
}

RTCScene build(RTCDevice device, const Mesh& mesh, std::uint32_t first, std::uint32_t last) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  void* places = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                         mesh.vertices.size());
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
    std::copy_n(mesh.vertices[k].place.data(), 3, static_cast<float*>(places) + 3 * k);
  void* corners =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Corners), last - first);
  std::copy_n(&mesh.triangles[first], last - first, static_cast<Corners*>(corners));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

std::vector<Normals> normals_of(const Mesh& mesh, std::uint32_t first, std::uint32_t last) {
  std::vector<Normals> normals(last - first);
  for (const MeshPatch& patch : mesh.patches) {
    if (patch.first_triangle < first || patch.first_triangle >= last) continue;
    for (std::uint32_t t = patch.first_triangle; t < patch.first_triangle + patch.triangles; ++t) {
      Normals& out = normals[t - first];
      out.look = patch.look;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = [&](std::size_t corner) { return mesh.vertices[mesh.triangles[t][corner]].normal[axis]; };
        out.first[axis] = at(0);
        out.to_second[axis] = at(1) - at(0);
        out.to_third[axis] = at(2) - at(0);
      }
    }
  }
  return normals;
}

// Turns the eye and the light against `motion`, so that the scene need not be.
void set_motion(View& view, const MeshHead& head, const Motion& motion) {
  const float eye[4][3] = {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {head.to_light[0], head.to_light[1], head.to_light[2]}};
  float* turned[4] = {view.ahead, view.right, view.up, view.to_light};
  for (std::size_t c = 0; c < 3; ++c) {
    for (int k = 0; k < 4; ++k)
      turned[k][c] = motion[0][c] * eye[k][0] + motion[1][c] * eye[k][1] + motion[2][c] * eye[k][2];
    view.origin[c] = -(motion[0][c] * motion[0][3] + motion[1][c] * motion[1][3] + motion[2][c] * motion[2][3]);
  }
}

class Renderer {
 public:
  Renderer(const Mesh& mesh, int threads, bool inbetweens);

  void render();
  Picture picture() const { return {mesh_.head.width, mesh_.head.height, frame_}; }
  std::string note() const { return note_; }

 private:
  void draw_tiles();
  void work();
  void draw(std::size_t number);
  void draw_packet(const View& view, int left, int top, bool over);
  template <typename Vector, typename Number>
  void store(int left, int top, Ints where, Vector values, std::vector<Number>& picture);
  void interpolate(const View& view, const RTCRayHit16& rays, Ints met, Floats* normal, Floats* color) const;
  Ints shade(const View& view, const RTCRayHit16& rays, Ints met, const Floats* direction) const;
  std::size_t place(int left, int top, int row) const;
  void mark_tiles(View& view, const Motion& motion) const;

  const Mesh& mesh_;
  bool inbetweens_ = false;
  bool keeping_depth_;    // where something moves
  std::uint32_t number_;  // of the last frame rendered; inbetweens are all but 0
  View standing_{}, mover_{};
  std::string note_;
  std::vector<std::uint32_t> frame_;
  std::vector<float> depth_;         // of the standing part
  std::vector<std::uint32_t> kept_;  // the standing part's colours
  std::uint32_t background_ = 0;
  int columns_;                       // of tiles
  std::vector<Area> tiles_;           // row by row
  std::vector<std::uint8_t> before_;  // the mover's tiles in the frame before
  std::atomic<std::size_t> next_tile_{0};
  std::unique_ptr<Crew> crew_;
};

constexpr float kFar = std::numeric_limits<float>::infinity();

std::uint32_t pixel_of(const std::array<float, 3>& color) {
  std::uint32_t pixel = 0;
  for (std::size_t c = 0; c < 3; ++c)
    pixel |= static_cast<std::uint32_t>(std::clamp(color[c], 0.0f, 1.0f) * 255 + 0.5f) << (8 * c);
  return pixel;
}

constexpr Motion kStill{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

Renderer::Renderer(const Mesh& mesh, int threads, bool inbetweens)
    : mesh_(mesh), keeping_depth_(mesh.first_moving_triangle() < mesh.head.triangles), number_(mesh.head.frames - 1) {
  const std::size_t pixels = std::size_t{mesh.head.width} * mesh.head.height;
  background_ = pixel_of(mesh.head.background);
  frame_.assign(pixels, background_);
  depth_.assign(pixels, kFar);
  const std::string config = "threads=" + std::to_string(threads);
  RTCDevice device = rtcNewDevice(config.c_str());
  const std::uint32_t moving = mesh.first_moving_triangle();
  const auto start = std::chrono::steady_clock::now();
  standing_.scene = build(device, mesh, 0, moving);
  if (moving < mesh.head.triangles) mover_.scene = build(device, mesh, moving, mesh.head.triangles);
  std::ostringstream note;
  note << "Embree " << rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION) << ", tree built in "
       << milliseconds_since(start) << " ms";
  note_ = note.str();
  standing_.normals = normals_of(mesh, 0, moving);
  mover_.normals = normals_of(mesh, moving, mesh.head.triangles);
  set_motion(standing_, mesh.head, kStill);
  standing_.outlines = outlines_of(mesh, false);
  mover_.outlines = outlines_of(mesh, true);
  const int width = static_cast<int>(mesh.head.width), height = static_cast<int>(mesh.head.height);
  for (int top = 0; top < height; top += kTile)
    for (int left = 0; left < width; left += kTile)
      tiles_.push_back({left, top, std::min(left + kTile, width), std::min(top + kTile, height)});
  columns_ = (width + kTile - 1) / kTile;
  before_.resize(tiles_.size());
  mover_.tiles.resize(tiles_.size());
  crew_ = std::make_unique<Crew>(threads, [this] { work(); });
  if (!inbetweens) return;
  mark_tiles(standing_, kStill);
  draw_tiles();  // and nothing that moves yet
  kept_ = frame_;
  inbetweens_ = true;
}

void Renderer::draw_tiles() {
  next_tile_ = 0;
  crew_->run();
}

void Renderer::mark_tiles(View& view, const Motion& motion) const {
  view.tiles.assign(tiles_.size(), 0);
  for (const Outline& outline : view.outlines) {
    const Area pixels = cover(outline, mesh_.head, motion);
    for (int row = pixels.top / kTile; row * kTile < pixels.bottom; ++row)
      for (int column = pixels.left / kTile; column * kTile < pixels.right; ++column)
        view.tiles[static_cast<std::size_t>(row * columns_ + column)] = 1;
  }
}

void Renderer::render() {
  number_ = (number_ + 1) % mesh_.head.frames;
  if (inbetweens_ && number_ == 0) number_ = 1;
  if (!mover_.normals.empty()) {
    const Motion& motion = mesh_.motion[number_];
    set_motion(mover_, mesh_.head, motion);
    before_ = mover_.tiles;
    mark_tiles(mover_, motion);
  }
  if (!inbetweens_) mark_tiles(standing_, kStill);
  draw_tiles();
}

void Renderer::work() {
  for (std::size_t k; (k = next_tile_.fetch_add(1, std::memory_order_relaxed)) < tiles_.size();) draw(k);
}

void Renderer::draw(std::size_t number) {
  const Area& tile = tiles_[number];
  const bool mover_here = mover_.tiles[number] == 1;
  if (inbetweens_ && !mover_here && before_[number] == 0) return;
  const bool standing_here = !inbetweens_ && standing_.tiles[number] == 1;
  if (!standing_here)
    for (int line = tile.top; line < tile.bottom; ++line) {
      const std::size_t row = std::size_t(line) * mesh_.head.width;
      if (inbetweens_)
        std::copy(&kept_[row + tile.left], &kept_[row] + tile.right, &frame_[row + tile.left]);
      else
        std::fill(&frame_[row + tile.left], &frame_[row] + tile.right, background_);
    }
  for (int top = tile.top; top < tile.bottom; top += kPacketHeight)
    for (int left = tile.left; left < tile.right; left += kPacketWidth) {
      if (standing_here) draw_packet(standing_, left, top, false);
      if (mover_here) draw_packet(mover_, left, top, true);
    }
}

// Where packet row r begins in pictures.
std::size_t Renderer::place(int left, int top, int row) const {
  return static_cast<std::size_t>(top + row) * mesh_.head.width + static_cast<std::size_t>(left);
}

// Draws what `view` has nearer than depth_, over what the frame shows; or, where it is the first, over nothing.
void Renderer::draw_packet(const View& view, int left, int top, bool over) {
  RTCRayHit16 rays;
  const Ints inside =
      (left + kColumn < static_cast<int>(mesh_.head.width)) & (top + kLine < static_cast<int>(mesh_.head.height));
  Floats limit = Floats{} + kFar;
  if (over)
    for (int k = 0; k < kPacket; ++k)
      if (inside[k]) limit[k] = depth_[place(left, top, k / kPacketWidth) + static_cast<std::size_t>(k % kPacketWidth)];
  const Floats x = (__builtin_convertvector(left + kColumn, Floats) + (0.5f - mesh_.head.center[0])) / mesh_.head.scale;
  const Floats y = (mesh_.head.center[1] - 0.5f - __builtin_convertvector(top + kLine, Floats)) / mesh_.head.scale;
  Floats direction[3];
  for (int axis = 0; axis < 3; ++axis) direction[axis] = view.ahead[axis] + x * view.right[axis] + y * view.up[axis];
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  put(rays.ray.org_x, Floats{} + view.origin[0]);
  put(rays.ray.org_y, Floats{} + view.origin[1]);
  put(rays.ray.org_z, Floats{} + view.origin[2]);
  put(rays.ray.dir_x, direction[0]);
  put(rays.ray.dir_y, direction[1]);
  put(rays.ray.dir_z, direction[2]);
  put(rays.ray.tnear, Floats{});
  put(rays.ray.tfar, limit);
  put(rays.ray.time, Floats{});
  put(rays.ray.mask, Ints{} - 1);
  put(rays.hit.geomID, Ints{} - 1);
  // Back faces are seldom seen: their few rays go on behind them, which costs less than a filter for all.
  Ints met = inside;
  for (Ints tracing = inside; any(tracing);) {
    rtcIntersect16(reinterpret_cast<const int*>(&tracing), view.scene, &context, &rays);
    met = inside & (got<Ints>(rays.hit.geomID) == 0);
    const Floats facing = got<Floats>(rays.hit.Ng_x) * direction[0] + got<Floats>(rays.hit.Ng_y) * direction[1] +
                          got<Floats>(rays.hit.Ng_z) * direction[2];
    tracing = met & (facing > 0);
    if (!any(tracing)) break;
    const Floats far = got<Floats>(rays.ray.tfar);
    put(rays.ray.tnear, tracing ? far * 1.000001f : got<Floats>(rays.ray.tnear));
    put(rays.ray.tfar, tracing ? limit : far);
    put(rays.hit.geomID, tracing ? Ints{} - 1 : got<Ints>(rays.hit.geomID));
  }
  Ints pixels = Ints{} + static_cast<int>(background_);
  if (any(met))
    pixels = met ? shade(view, rays, met, direction) : pixels;
  else if (over)
    return;
  store(left, top, over ? met : inside, pixels, frame_);
  if (keeping_depth_ && !over) store(left, top, inside, met ? got<Floats>(rays.ray.tfar) : Floats{} + kFar, depth_);
}

template <typename Vector, typename Number>
void Renderer::store(int left, int top, Ints where, Vector values, std::vector<Number>& picture) {
  for (int row = 0; row < kPacketHeight; ++row)
    for (int column = 0; column < kPacketWidth; ++column) {
      const int k = row * kPacketWidth + column;
      if (where[k]) picture[place(left, top, row) + static_cast<std::size_t>(column)] = static_cast<Number>(values[k]);
    }
}

// Phong's interpolation, a triangle after the other: most packets meet few, and gathering is slow.
void Renderer::interpolate(const View& view, const RTCRayHit16& rays, Ints met, Floats* normal, Floats* color) const {
  const Ints triangles = got<Ints>(rays.hit.primID);
  const Floats u = got<Floats>(rays.hit.u), v = got<Floats>(rays.hit.v);
  for (unsigned left = mask_of(met); left != 0;) {
    const int triangle = triangles[std::countr_zero(left)];
    const Ints own = met & (triangles == triangle);
    left &= ~mask_of(own);
    const Normals& at = view.normals[static_cast<std::size_t>(triangle)];
    for (int axis = 0; axis < 3; ++axis)
      normal[axis] = own ? at.first[axis] + u * at.to_second[axis] + v * at.to_third[axis] : normal[axis];
    for (std::size_t c = 0; c < 3; ++c) color[c] = own ? Floats{} + mesh_.looks[at.look][c] : color[c];
  }
}

Ints Renderer::shade(const View& view, const RTCRayHit16& rays, Ints met, const Floats* direction) const {
  Floats normal[3] = {}, color[3] = {};
  interpolate(view, rays, met, normal, color);
  const MeshHead& head = mesh_.head;
  const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const Floats shrink = inverse_root(dot(normal, normal)), toward = -inverse_root(dot(direction, direction));
  const Floats nl = dot(normal, view.to_light) * shrink;
  const Floats nv = dot(normal, direction) * shrink * toward;
  const Floats facing = nl > 0 ? nl : Floats{};
  const Floats rv = 2 * nl * nv - dot(direction, view.to_light) * toward;
  Floats shine = (nl > 0) & (rv > 0) ? rv : Floats{};
  for (std::uint32_t s = 0; s < head.squarings; ++s) shine *= shine;
  Ints pixels{};
  for (int c = 0; c < 3; ++c) {
    const Floats level = color[c] * (head.ambient + head.diffuse * head.light[static_cast<std::size_t>(c)] * facing) +
                         head.specular * head.light[static_cast<std::size_t>(c)] * shine;
    pixels |= __builtin_convertvector((level < 1 ? level : Floats{} + 1) * 255 + 0.5f, Ints) << (8 * c);
  }
  return pixels;
}

void run(int argc, char** argv) {
  if (argc != 4) throw std::runtime_error("usage: peer-embree MESH THREADS whole|inbetween");
  const Mesh mesh = read_mesh(argv[1]);
  Renderer renderer(mesh, std::stoi(argv[2]), std::string_view(argv[3]) == "inbetween");
  obey({renderer.note(), [&] { renderer.render(); }, [&] { return renderer.picture(); }});
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  return mars::bench::main_of("peer-embree", [&] { mars::bench::run(argc, argv); });
}
