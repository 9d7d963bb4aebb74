// Several rays a pixel, in packets of all samples of a few pixels. Samples of a pixel that show the same triangle are
// shaded once, at the first of them; such points wait until there is a packet of them.
#include <algorithm>
#include <bit>
#include <limits>

#include "tests/bench/peers/embree_painter.h"

namespace mars::bench {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr int kTilePixels = kTile * kTile;

// Sums over the samples of a tile's pixels.
struct Sums {
  float level[3][kTilePixels] = {};
  int samples[kTilePixels] = {};  // that showed something
};

// Points of one view that wait to be shaded into the sums.
class Waiting {
 public:
  Waiting(const View& view, const Mesh& mesh, Sums& sums) : view_(view), mesh_(mesh), sums_(sums) {}

  // A point that a ray of a packet met, for `samples` samples of a pixel.
  void add(const RTCRayHit16& rays, int ray, int pixel, int samples) {
    triangles_[count_] = static_cast<int>(rays.hit.primID[ray]);
    u_[count_] = rays.hit.u[ray], v_[count_] = rays.hit.v[ray];
    direction_[0][count_] = rays.ray.dir_x[ray];
    direction_[1][count_] = rays.ray.dir_y[ray];
    direction_[2][count_] = rays.ray.dir_z[ray];
    pixels_[count_] = pixel, samples_[count_] = samples;
    if (++count_ == kPacket) shade_all();
  }

  void shade_all() {
    if (count_ == 0) return;
    const Directions directions{{got<Floats>(direction_[0]), got<Floats>(direction_[1]), got<Floats>(direction_[2])}};
    const Points points{got<Ints>(triangles_), got<Floats>(u_), got<Floats>(v_), directions};
    const Levels levels = shade(view_, mesh_, points, kNumbers < count_);
    for (int k = 0; k < count_; ++k) {
      for (int c = 0; c < 3; ++c) sums_.level[c][pixels_[k]] += static_cast<float>(samples_[k]) * levels.level[c][k];
      sums_.samples[pixels_[k]] += samples_[k];
    }
    count_ = 0;
  }

 private:
  static constexpr Ints kNumbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

  const View& view_;
  const Mesh& mesh_;
  Sums& sums_;
  int count_ = 0;
  alignas(64) int triangles_[kPacket] = {};
  alignas(64) float u_[kPacket] = {}, v_[kPacket] = {}, direction_[3][kPacket] = {};
  int pixels_[kPacket], samples_[kPacket];
};

class SamplePainter : public Painter {
 public:
  SamplePainter(Canvas& canvas, bool keeps, const shape::SamplePattern& pattern);

  void draw(const Area& tile, Here here) override;
  void keep(const Area& tile, bool standing_here) override;
  void draw_mover(const Area& tile) override;

 private:
  // The samples of a block of pixels, a pixel after the other, and where their rays go.
  struct Packet {
    int left, top;
    Ints inside;
    Floats x, y;
  };
  // What stands, as inbetweens need it.
  struct Kept {
    Floats depth;
    Levels levels;
  };

  void for_packets(const Area& tile, auto draw_packet) const;
  void add(Waiting& waiting, const Area& tile, const Packet& packet, const RTCRayHit16& rays, Ints shown) const;
  void resolve(const Area& tile, const Sums& sums);
  int pixel_in(const Area& tile, const Packet& packet, int ray) const;
  unsigned samples_of(int ray) const { return pixel_bits_ << (ray / samples_ * samples_); }
  Kept& kept(const Packet& packet);

  Canvas& canvas_;
  int samples_;
  int block_width_, block_height_;  // pixels of a packet
  unsigned pixel_bits_;             // of a packet's first pixel
  Ints column_, line_;              // of each ray's pixel in its block
  Floats x_, y_;                    // of each ray, pixels in its block
  std::vector<float> background_;
  std::vector<Kept> kept_;  // by blocks, row by row
};

SamplePainter::SamplePainter(Canvas& canvas, bool keeps, const shape::SamplePattern& pattern)
    : canvas_(canvas), samples_(pattern.count), pixel_bits_((1u << pattern.count) - 1) {
  const int pixels = kPacket / samples_;
  block_width_ = pixels >= 8 ? 4 : pixels >= 2 ? 2 : 1;
  block_height_ = pixels / block_width_;
  for (int k = 0; k < kPacket; ++k) {
    const int pixel = k / samples_, sample = pattern.by_distance[k % samples_];
    column_[k] = pixel % block_width_, line_[k] = pixel / block_width_;
    x_[k] = static_cast<float>(column_[k]) + static_cast<float>(pattern.x[sample]) / 256;
    y_[k] = static_cast<float>(line_[k]) + static_cast<float>(pattern.y[sample]) / 256;
  }
  const MeshHead& head = canvas.mesh.head;
  for (const float level : head.background) background_.push_back(std::clamp(level, 0.0f, 1.0f));
  if (keeps)
    kept_.resize((head.width / static_cast<unsigned>(block_width_) + 1) *
                 (head.height / static_cast<unsigned>(block_height_) + 1));
}

void SamplePainter::for_packets(const Area& tile, auto draw_packet) const {
  const MeshHead& head = canvas_.mesh.head;
  const auto width = static_cast<int>(head.width), height = static_cast<int>(head.height);
  for (int top = tile.top; top < tile.bottom; top += block_height_)
    for (int left = tile.left; left < tile.right; left += block_width_)
      draw_packet(Packet{left, top, (left + column_ < width) & (top + line_ < height),
                         (x_ + (static_cast<float>(left) - head.center[0])) / head.scale,
                         ((head.center[1] - static_cast<float>(top)) - y_) / head.scale});
}

int SamplePainter::pixel_in(const Area& tile, const Packet& packet, int ray) const {
  return (packet.top - tile.top + line_[ray]) * kTile + packet.left - tile.left + column_[ray];
}

void SamplePainter::add(Waiting& waiting, const Area& tile, const Packet& packet, const RTCRayHit16& rays,
                        Ints shown) const {
  for (unsigned left = mask_of(shown); left != 0;) {
    const int ray = std::countr_zero(left);
    const Ints alike = got<Ints>(rays.hit.primID) == static_cast<int>(rays.hit.primID[ray]);
    const unsigned own = mask_of(alike) & left & samples_of(ray);
    left &= ~own;
    waiting.add(rays, ray, pixel_in(tile, packet, ray), std::popcount(own));
  }
}

void SamplePainter::resolve(const Area& tile, const Sums& sums) {
  const float share = 1 / static_cast<float>(samples_);
  for (int line = tile.top; line < tile.bottom; ++line)
    for (int column = tile.left; column < tile.right; ++column) {
      const int k = (line - tile.top) * kTile + column - tile.left;
      const auto empty = static_cast<float>(samples_ - sums.samples[k]);
      std::uint32_t pixel = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const float level = (sums.level[c][k] + empty * background_[c]) * share;
        pixel |= static_cast<std::uint32_t>(level * 255 + 0.5f) << (8 * c);
      }
      canvas_.frame[static_cast<std::size_t>(line) * canvas_.mesh.head.width + static_cast<std::size_t>(column)] =
          pixel;
    }
}

void SamplePainter::draw(const Area& tile, Here here) {
  Sums sums;
  Waiting standing(canvas_.standing, canvas_.mesh, sums), mover(canvas_.mover, canvas_.mesh, sums);
  for_packets(tile, [&](const Packet& packet) {
    RTCRayHit16 behind, before;
    Ints shown{}, covered{};
    Floats limit = Floats{} + kFar;
    if (here.standing) {
      shown =
          trace(canvas_.standing, directions_of(canvas_.standing, packet.x, packet.y), packet.inside, limit, behind);
      limit = shown ? got<Floats>(behind.ray.tfar) : limit;
    }
    if (here.mover) {
      covered = trace(canvas_.mover, directions_of(canvas_.mover, packet.x, packet.y), packet.inside, limit, before);
      add(mover, tile, packet, before, covered);
    }
    add(standing, tile, packet, behind, shown & ~covered);
  });
  standing.shade_all();
  mover.shade_all();
  resolve(tile, sums);
}

SamplePainter::Kept& SamplePainter::kept(const Packet& packet) {
  const unsigned blocks = canvas_.mesh.head.width / static_cast<unsigned>(block_width_) + 1;
  return kept_[static_cast<unsigned>(packet.top / block_height_) * blocks +
               static_cast<unsigned>(packet.left / block_width_)];
}

// Once, before what is measured: every sample is shaded, as the first of its pixel that shows the same triangle.
void SamplePainter::keep(const Area& tile, bool standing_here) {
  draw(tile, {standing_here, false});
  const Levels empty{{Floats{} + background_[0], Floats{} + background_[1], Floats{} + background_[2]}};
  for_packets(tile, [&](const Packet& packet) {
    Kept& own = kept(packet) = {Floats{} + kFar, empty};
    if (!standing_here) return;
    RTCRayHit16 rays;
    const View& view = canvas_.standing;
    const Directions directions = directions_of(view, packet.x, packet.y);
    const Ints met = trace(view, directions, packet.inside, own.depth, rays);
    if (!any(met)) return;
    const Points points{got<Ints>(rays.hit.primID), got<Floats>(rays.hit.u), got<Floats>(rays.hit.v), directions};
    const Levels levels = shade(view, canvas_.mesh, points, met);
    own.depth = met ? got<Floats>(rays.ray.tfar) : own.depth;
    for (unsigned left = mask_of(met); left != 0; left &= left - 1) {
      const int ray = std::countr_zero(left);
      const unsigned alike = mask_of(met & (points.triangles == points.triangles[ray])) & samples_of(ray);
      for (int c = 0; c < 3; ++c) own.levels.level[c][ray] = levels.level[c][std::countr_zero(alike | 1u << ray)];
    }
  });
}

void SamplePainter::draw_mover(const Area& tile) {
  Sums sums;
  Waiting mover(canvas_.mover, canvas_.mesh, sums);
  for_packets(tile, [&](const Packet& packet) {
    RTCRayHit16 rays;
    const Kept& own = kept(packet);
    const Ints covered =
        trace(canvas_.mover, directions_of(canvas_.mover, packet.x, packet.y), packet.inside, own.depth, rays);
    if (any(covered)) add(mover, tile, packet, rays, covered);
    for (unsigned left = mask_of(packet.inside & ~covered); left != 0; left &= left - 1) {
      const int ray = std::countr_zero(left), pixel = pixel_in(tile, packet, ray);
      for (int c = 0; c < 3; ++c) sums.level[c][pixel] += own.levels.level[c][ray];
      ++sums.samples[pixel];
    }
  });
  mover.shade_all();
  resolve(tile, sums);
}

}  // namespace

std::unique_ptr<Painter> make_sample_painter(Canvas& canvas, bool keeps, const shape::SamplePattern& pattern) {
  return std::make_unique<SamplePainter>(canvas, keeps, pattern);
}

}  // namespace mars::bench
