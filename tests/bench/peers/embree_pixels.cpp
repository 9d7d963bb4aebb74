// One ray a pixel, in packets of 4 x 4 pixels.
#include <algorithm>
#include <limits>

#include "tests/bench/peers/embree_painter.h"

namespace mars::bench {
namespace {

constexpr int kPacketWidth = 4, kPacketHeight = 4;
constexpr Ints kColumn{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
constexpr Ints kLine{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
constexpr float kFar = std::numeric_limits<float>::infinity();

Points points_of(const RTCRayHit16& rays, const Directions& directions) {
  return {got<Ints>(rays.hit.primID), got<Floats>(rays.hit.u), got<Floats>(rays.hit.v), directions};
}

Ints pixels_of(const Levels& levels) {
  Ints pixels{};
  for (int c = 0; c < 3; ++c) pixels |= __builtin_convertvector(levels.level[c] * 255 + 0.5f, Ints) << (8 * c);
  return pixels;
}

class PixelPainter : public Painter {
 public:
  PixelPainter(Canvas& canvas, bool keeps)
      : canvas_(canvas),
        background_(pixel_of(canvas.mesh.head.background)),
        depth_(keeps ? canvas.frame.size() : 0, kFar) {}

  void draw(const Area& tile, Here here) override;
  void keep(const Area& tile, bool standing_here) override;
  void draw_mover(const Area& tile) override;

 private:
  // A packet of pixels, and where their rays go.
  struct Packet {
    int left, top;
    Ints inside;
    Floats x, y;
  };

  void for_packets(const Area& tile, auto draw_packet) const;
  void clear(const Area& tile);
  Ints draw_view(const View& view, const Packet& packet, Floats limit, RTCRayHit16& rays, Ints& pixels) const;
  template <typename Vector, typename Number>
  void store(const Packet& packet, Ints where, Vector values, std::vector<Number>& picture) const;
  std::size_t place(const Packet& packet, int k) const;

  Canvas& canvas_;
  std::uint32_t background_;
  std::vector<float> depth_;  // of what stands
};

void PixelPainter::for_packets(const Area& tile, auto draw_packet) const {
  const MeshHead& head = canvas_.mesh.head;
  for (int top = tile.top; top < tile.bottom; top += kPacketHeight)
    for (int left = tile.left; left < tile.right; left += kPacketWidth) {
      const Ints column = left + kColumn, line = top + kLine;
      draw_packet(Packet{left, top, (column < static_cast<int>(head.width)) & (line < static_cast<int>(head.height)),
                         (__builtin_convertvector(column, Floats) + (0.5f - head.center[0])) / head.scale,
                         (head.center[1] - 0.5f - __builtin_convertvector(line, Floats)) / head.scale});
    }
}

std::size_t PixelPainter::place(const Packet& packet, int k) const {
  return static_cast<std::size_t>(packet.top + k / kPacketWidth) * canvas_.mesh.head.width +
         static_cast<std::size_t>(packet.left + k % kPacketWidth);
}

template <typename Vector, typename Number>
void PixelPainter::store(const Packet& packet, Ints where, Vector values, std::vector<Number>& picture) const {
  for (int k = 0; k < kPacket; ++k)
    if (where[k]) picture[place(packet, k)] = static_cast<Number>(values[k]);
}

// Into `pixels` what the view has nearer than `limit`; returns where.
Ints PixelPainter::draw_view(const View& view, const Packet& packet, Floats limit, RTCRayHit16& rays,
                             Ints& pixels) const {
  const Directions directions = directions_of(view, packet.x, packet.y);
  const Ints met = trace(view, directions, packet.inside, limit, rays);
  if (any(met)) pixels = met ? pixels_of(shade(view, canvas_.mesh, points_of(rays, directions), met)) : pixels;
  return met;
}

void PixelPainter::clear(const Area& tile) {
  for (int line = tile.top; line < tile.bottom; ++line) {
    const auto row = canvas_.frame.begin() + static_cast<std::ptrdiff_t>(line) * canvas_.mesh.head.width;
    std::fill(row + tile.left, row + tile.right, background_);
  }
}

void PixelPainter::draw(const Area& tile, Here here) {
  if (!here.standing && !here.mover) return clear(tile);
  for_packets(tile, [&](const Packet& packet) {
    RTCRayHit16 rays;
    Ints pixels = Ints{} + static_cast<int>(background_);
    Floats limit = Floats{} + kFar;
    if (here.standing) {
      const Ints met = draw_view(canvas_.standing, packet, limit, rays, pixels);
      limit = met ? got<Floats>(rays.ray.tfar) : limit;
    }
    if (here.mover) draw_view(canvas_.mover, packet, limit, rays, pixels);
    store(packet, packet.inside, pixels, canvas_.frame);
  });
}

void PixelPainter::keep(const Area& tile, bool standing_here) {
  if (!standing_here) return clear(tile);
  for_packets(tile, [&](const Packet& packet) {
    RTCRayHit16 rays;
    Ints pixels = Ints{} + static_cast<int>(background_);
    const Ints met = draw_view(canvas_.standing, packet, Floats{} + kFar, rays, pixels);
    store(packet, packet.inside, pixels, canvas_.frame);
    store(packet, met, got<Floats>(rays.ray.tfar), depth_);
  });
}

void PixelPainter::draw_mover(const Area& tile) {
  for_packets(tile, [&](const Packet& packet) {
    RTCRayHit16 rays;
    Ints pixels{};
    Floats limit = Floats{} + kFar;
    for (int k = 0; k < kPacket; ++k)
      if (packet.inside[k]) limit[k] = depth_[place(packet, k)];
    const Ints met = draw_view(canvas_.mover, packet, limit, rays, pixels);
    if (any(met)) store(packet, met, pixels, canvas_.frame);
  });
}

}  // namespace

std::unique_ptr<Painter> make_pixel_painter(Canvas& canvas, bool keeps) {
  return std::make_unique<PixelPainter>(canvas, keeps);
}

std::uint32_t pixel_of(const std::array<float, 3>& levels) {
  std::uint32_t pixel = 0;
  for (std::size_t c = 0; c < 3; ++c)
    pixel |= static_cast<std::uint32_t>(std::clamp(levels[c], 0.0f, 1.0f) * 255 + 0.5f) << (8 * c);
  return pixel;
}

}  // namespace mars::bench
