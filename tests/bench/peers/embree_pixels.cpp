// One ray a pixel, in packets of 4 x 4 pixels.
#include <algorithm>
#include <limits>

#include "tests/bench/peers/embree_painter.h"
#include "tests/bench/peers/embree_sun.h"

namespace mars::bench {
namespace {

constexpr int kPacketWidth = 4, kPacketHeight = 4;
constexpr Ints kColumn{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
constexpr Ints kLine{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kBeyond = 1e30f;  // what is farther is empty; infinity is no number to compare with under fast-math

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
  PixelPainter(Canvas& canvas, bool keeps);

  void draw(const Area& tile, Here here) override;
  void keep(const Area& tile, bool standing_here) override;
  void draw_changes(const Area& tile, Changes here) override;
  void set_tracing(bool traces) override { sun_->traces = traces; }

 private:
  // A packet of pixels, and where their rays go.
  struct Packet {
    int left, top;
    Ints inside;
    Floats x, y;
  };
  // What stands, as shadows of what moves need it.
  struct Kept {
    Lit lit;
    Ints open;
  };

  void for_packets(const Area& tile, auto draw_packet) const;
  void clear(const Area& tile);
  Ints trace_view(const View& view, const Packet& packet, Ints inside, Floats limit, RTCRayHit16& rays) const;
  Lit shade_view(const View& view, const Packet& packet, const RTCRayHit16& rays, Ints met) const;
  Ints open_rays(const View& view, const Packet& packet, const RTCRayHit16& rays, Ints met, const Lit& lit,
                 bool both) const;
  void draw_view(const View& view, const Packet& packet, const RTCRayHit16& rays, Ints met, Ints& pixels) const;
  void draw_shadow(const Packet& packet, Floats depth, Ints standing);
  Floats share(Ints open) const { return sun_ ? sun_->share(open) : Floats{} + 1; }
  template <typename Vector, typename Number>
  void store(const Packet& packet, Ints where, Vector values, std::vector<Number>& picture) const;
  std::size_t place(const Packet& packet, int k) const;
  Kept& kept(const Packet& packet);

  Canvas& canvas_;
  std::optional<Sun> sun_;
  std::uint32_t background_;
  std::vector<float> depth_;  // of what stands
  std::vector<Kept> kept_;    // by packets, row by row; none without a sun
};

PixelPainter::PixelPainter(Canvas& canvas, bool keeps)
    : canvas_(canvas),
      background_(pixel_of(canvas.mesh.head.background)),
      depth_(keeps ? canvas.frame.size() : 0, kFar) {
  if (!canvas.sun) return;
  sun_.emplace(*canvas.sun, Lanes{kPacketWidth, kPacketHeight, 1, kColumn, kLine, Ints{}});
  const MeshHead& head = canvas.mesh.head;
  if (keeps) kept_.resize((head.width / kPacketWidth + 1) * (head.height / kPacketHeight + 1));
}

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

PixelPainter::Kept& PixelPainter::kept(const Packet& packet) {
  const unsigned packets = canvas_.mesh.head.width / kPacketWidth + 1;
  return kept_[static_cast<unsigned>(packet.top / kPacketHeight) * packets +
               static_cast<unsigned>(packet.left / kPacketWidth)];
}

template <typename Vector, typename Number>
void PixelPainter::store(const Packet& packet, Ints where, Vector values, std::vector<Number>& picture) const {
  for (int k = 0; k < kPacket; ++k)
    if (where[k]) picture[place(packet, k)] = static_cast<Number>(values[k]);
}

// What the view has nearer than `limit`; returns where.
Ints PixelPainter::trace_view(const View& view, const Packet& packet, Ints inside, Floats limit,
                              RTCRayHit16& rays) const {
  return trace(view, directions_of(view, packet.x, packet.y), inside, limit, rays);
}

Lit PixelPainter::shade_view(const View& view, const Packet& packet, const RTCRayHit16& rays, Ints met) const {
  return shade(view, canvas_.mesh, points_of(rays, directions_of(view, packet.x, packet.y)), met);
}

// To the sun, from points that its light could change. `both`: past what moves, too.
Ints PixelPainter::open_rays(const View& view, const Packet& packet, const RTCRayHit16& rays, Ints met, const Lit& lit,
                             bool both) const {
  if (!sun_) return Ints{};
  const Floats light = lit.term.level[0] + lit.term.level[1] + lit.term.level[2];
  const Ints lit_points = met & (light > 0) & facing_light(view, rays);
  const Spots spots{packet.left, packet.top, packet.x, packet.y, got<Floats>(rays.ray.tfar)};
  if (!both) return sun_->open(spots, lit_points & sun_->all(), {&canvas_.standing});
  return sun_->open(spots, lit_points & sun_->all(), {&canvas_.standing, &canvas_.mover});
}

// Into `pixels`, where `met`.
void PixelPainter::draw_view(const View& view, const Packet& packet, const RTCRayHit16& rays, Ints met,
                             Ints& pixels) const {
  if (!any(met)) return;
  const Lit lit = shade_view(view, packet, rays, met);
  pixels = met ? pixels_of(levels_of(lit, share(open_rays(view, packet, rays, met, lit, true)))) : pixels;
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
    RTCRayHit16 behind, before;
    Ints shown{}, covered{};
    Floats limit = Floats{} + kFar;
    if (here.standing) {
      shown = trace_view(canvas_.standing, packet, packet.inside, limit, behind);
      limit = shown ? got<Floats>(behind.ray.tfar) : limit;
    }
    if (here.mover) covered = trace_view(canvas_.mover, packet, packet.inside, limit, before);
    Ints pixels = Ints{} + static_cast<int>(background_);
    draw_view(canvas_.standing, packet, behind, shown & ~covered, pixels);
    draw_view(canvas_.mover, packet, before, covered, pixels);
    store(packet, packet.inside, pixels, canvas_.frame);
  });
}

void PixelPainter::keep(const Area& tile, bool standing_here) {
  if (!standing_here) return clear(tile);
  for_packets(tile, [&](const Packet& packet) {
    RTCRayHit16 rays;
    const View& view = canvas_.standing;
    const Ints met = trace_view(view, packet, packet.inside, Floats{} + kFar, rays);
    Ints pixels = Ints{} + static_cast<int>(background_);
    if (any(met)) {
      const Lit lit = shade_view(view, packet, rays, met);
      const Ints open = open_rays(view, packet, rays, met, lit, false);
      pixels = met ? pixels_of(levels_of(lit, share(open))) : pixels;
      if (sun_) kept(packet) = {lit, open};
    }
    store(packet, packet.inside, pixels, canvas_.frame);
    store(packet, met, got<Floats>(rays.ray.tfar), depth_);
  });
}

// Of what moves, on what stands; only past what moves are rays traced, for the other has stopped those of `open`.
void PixelPainter::draw_shadow(const Packet& packet, Floats depth, Ints standing) {
  const Kept& own = kept(packet);
  const Ints before = standing & own.open;
  const Ints open = sun_->open({packet.left, packet.top, packet.x, packet.y, depth}, before, {&canvas_.mover});
  const Ints changed = open != before;
  if (any(changed)) store(packet, changed, pixels_of(levels_of(own.lit, share(open))), canvas_.frame);
}

void PixelPainter::draw_changes(const Area& tile, Changes here) {
  for_packets(tile, [&](const Packet& packet) {
    RTCRayHit16 rays;
    Ints pixels{}, covered{};
    Floats depth = Floats{} + kFar;
    for (int k = 0; k < kPacket; ++k)
      if (packet.inside[k]) depth[k] = depth_[place(packet, k)];
    if (here.mover) covered = trace_view(canvas_.mover, packet, packet.inside, depth, rays);
    if (here.shadow) draw_shadow(packet, depth, packet.inside & ~covered & (depth < kBeyond));
    if (!any(covered)) return;
    draw_view(canvas_.mover, packet, rays, covered, pixels);
    store(packet, covered, pixels, canvas_.frame);
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
