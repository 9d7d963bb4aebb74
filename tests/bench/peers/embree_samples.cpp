// Several rays a pixel, in packets of all samples of a few pixels. Samples of a pixel that show the same triangle are
// shaded once, at the first of them; such points wait until there is a packet of them.
#include <algorithm>
#include <bit>
#include <limits>

#include "tests/bench/peers/embree_painter.h"
#include "tests/bench/peers/embree_sun.h"

namespace mars::bench {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kBeyond = 1e30f;  // what is farther is empty; infinity is no number to compare with under fast-math
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

  // A point that a ray of a packet met, for `samples` samples of a pixel, at which `share` of the light arrives.
  void add(const RTCRayHit16& rays, int ray, int pixel, int samples, float share) {
    triangles_[count_] = static_cast<int>(rays.hit.primID[ray]);
    u_[count_] = rays.hit.u[ray], v_[count_] = rays.hit.v[ray];
    direction_[0][count_] = rays.ray.dir_x[ray];
    direction_[1][count_] = rays.ray.dir_y[ray];
    direction_[2][count_] = rays.ray.dir_z[ray];
    pixels_[count_] = pixel, samples_[count_] = samples, share_[count_] = share;
    if (++count_ == kPacket) shade_all();
  }

  void shade_all() {
    if (count_ == 0) return;
    const Directions directions{{got<Floats>(direction_[0]), got<Floats>(direction_[1]), got<Floats>(direction_[2])}};
    const Points points{got<Ints>(triangles_), got<Floats>(u_), got<Floats>(v_), directions};
    const Levels levels = levels_of(shade(view_, mesh_, points, kNumbers < count_), got<Floats>(share_));
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
  alignas(64) float u_[kPacket] = {}, v_[kPacket] = {}, direction_[3][kPacket] = {}, share_[kPacket] = {};
  int pixels_[kPacket], samples_[kPacket];
};

// Over the rays of `which`.
float sum_of(Floats values, unsigned which) {
  float sum = 0;
  for (; which != 0; which &= which - 1) sum += values[std::countr_zero(which)];
  return sum;
}

class SamplePainter : public Painter {
 public:
  SamplePainter(Canvas& canvas, bool keeps, const shape::SamplePattern& pattern);

  void draw(const Area& tile, Here here) override;
  void keep(const Area& tile, bool standing_here) override;
  void draw_changes(const Area& tile, Changes here) override;
  void set_tracing(bool traces) override { sun_->traces = traces; }

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
  // The same, as shadows of what moves need it.
  struct KeptLight {
    Lit lit;
    Ints open;
  };

  void for_packets(const Area& tile, auto draw_packet) const;
  void add(Waiting& waiting, const Area& tile, const Packet& packet, const RTCRayHit16& rays, Ints shown,
           Ints open) const;
  void add_view(Waiting& waiting, const View& view, const Area& tile, const Packet& packet, const RTCRayHit16& rays,
                Ints shown) const;
  Ints open_rays(const View& view, const Packet& packet, const RTCRayHit16& rays, Ints shown, bool both) const;
  Lit of_first_alike(const Lit& lit, Ints triangles, Ints met) const;
  Levels levels_under_shadow(const Packet& packet, const Kept& own, Ints standing) const;
  void resolve(const Area& tile, const Sums& sums);
  int pixel_in(const Area& tile, const Packet& packet, int ray) const;
  unsigned samples_of(int ray) const { return pixel_bits_ << (ray / samples_ * samples_); }
  std::size_t place(const Packet& packet) const;

  Canvas& canvas_;
  std::optional<Sun> sun_;
  int samples_;
  int block_width_, block_height_;  // pixels of a packet
  unsigned pixel_bits_;             // of a packet's first pixel
  Ints column_, line_;              // of each ray's pixel in its block
  Floats x_, y_;                    // of each ray, pixels in its block
  std::vector<float> background_;
  std::vector<Kept> kept_;             // by blocks, row by row
  std::vector<KeptLight> kept_light_;  // the same; none without a sun
};

SamplePainter::SamplePainter(Canvas& canvas, bool keeps, const shape::SamplePattern& pattern)
    : canvas_(canvas), samples_(pattern.count), pixel_bits_((1u << pattern.count) - 1) {
  const int pixels = kPacket / samples_;
  block_width_ = pixels >= 8 ? 4 : pixels >= 2 ? 2 : 1;
  block_height_ = pixels / block_width_;
  Ints number{};
  for (int k = 0; k < kPacket; ++k) {
    const int pixel = k / samples_, sample = pattern.by_distance[k % samples_];
    column_[k] = pixel % block_width_, line_[k] = pixel / block_width_, number[k] = k % samples_;
    x_[k] = static_cast<float>(column_[k]) + static_cast<float>(pattern.x[sample]) / 256;
    y_[k] = static_cast<float>(line_[k]) + static_cast<float>(pattern.y[sample]) / 256;
  }
  const MeshHead& head = canvas.mesh.head;
  for (const float level : head.background) background_.push_back(std::clamp(level, 0.0f, 1.0f));
  if (canvas.sun) sun_.emplace(*canvas.sun, Lanes{block_width_, block_height_, samples_, column_, line_, number});
  if (!keeps) return;
  kept_.resize((head.width / static_cast<unsigned>(block_width_) + 1) *
               (head.height / static_cast<unsigned>(block_height_) + 1));
  if (sun_) kept_light_.resize(kept_.size());
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

void SamplePainter::add(Waiting& waiting, const Area& tile, const Packet& packet, const RTCRayHit16& rays, Ints shown,
                        Ints open) const {
  const Floats share = sun_ ? sun_->share(open) : Floats{} + 1;
  for (unsigned left = mask_of(shown); left != 0;) {
    const int ray = std::countr_zero(left);
    const Ints alike = got<Ints>(rays.hit.primID) == static_cast<int>(rays.hit.primID[ray]);
    const unsigned own = mask_of(alike) & left & samples_of(ray);
    left &= ~own;
    const int samples = std::popcount(own);
    waiting.add(rays, ray, pixel_in(tile, packet, ray), samples, sum_of(share, own) / static_cast<float>(samples));
  }
}

// With the light that arrives at each of its samples.
void SamplePainter::add_view(Waiting& waiting, const View& view, const Area& tile, const Packet& packet,
                             const RTCRayHit16& rays, Ints shown) const {
  if (any(shown)) add(waiting, tile, packet, rays, shown, open_rays(view, packet, rays, shown, true));
}

// To the sun. `both`: past what moves, too.
Ints SamplePainter::open_rays(const View& view, const Packet& packet, const RTCRayHit16& rays, Ints shown,
                              bool both) const {
  if (!sun_) return Ints{};
  const Ints tried = shown & facing_light(view, rays) & sun_->all();
  const Spots spots{packet.left, packet.top, packet.x, packet.y, got<Floats>(rays.ray.tfar)};
  if (!both) return sun_->open(spots, tried, {&canvas_.standing});
  return sun_->open(spots, tried, {&canvas_.standing, &canvas_.mover});
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
      add_view(mover, canvas_.mover, tile, packet, before, covered);
    }
    add_view(standing, canvas_.standing, tile, packet, behind, shown & ~covered);
  });
  standing.shade_all();
  mover.shade_all();
  resolve(tile, sums);
}

std::size_t SamplePainter::place(const Packet& packet) const {
  const unsigned blocks = canvas_.mesh.head.width / static_cast<unsigned>(block_width_) + 1;
  return static_cast<unsigned>(packet.top / block_height_) * blocks + static_cast<unsigned>(packet.left / block_width_);
}

// Once, before what is measured: every sample is shaded, as the first of its pixel that shows the same triangle, but
// with the light that arrives at the sample itself.
void SamplePainter::keep(const Area& tile, bool standing_here) {
  draw(tile, {standing_here, false});
  const Levels empty{{Floats{} + background_[0], Floats{} + background_[1], Floats{} + background_[2]}};
  for_packets(tile, [&](const Packet& packet) {
    Kept& own = kept_[place(packet)] = {Floats{} + kFar, empty};
    if (!standing_here) return;
    RTCRayHit16 rays;
    const View& view = canvas_.standing;
    const Directions directions = directions_of(view, packet.x, packet.y);
    const Ints met = trace(view, directions, packet.inside, own.depth, rays);
    if (!any(met)) return;
    const Points points{got<Ints>(rays.hit.primID), got<Floats>(rays.hit.u), got<Floats>(rays.hit.v), directions};
    const Lit lit = of_first_alike(shade(view, canvas_.mesh, points, met), points.triangles, met);
    const Ints open = open_rays(view, packet, rays, met, false);
    const Levels levels = levels_of(lit, sun_ ? sun_->share(open) : Floats{} + 1);
    own.depth = met ? got<Floats>(rays.ray.tfar) : own.depth;
    for (int c = 0; c < 3; ++c) own.levels.level[c] = met ? levels.level[c] : own.levels.level[c];
    if (sun_) kept_light_[place(packet)] = {lit, open};
  });
}

// Each ray's as that of the first of its pixel that met the same triangle.
Lit SamplePainter::of_first_alike(const Lit& lit, Ints triangles, Ints met) const {
  Lit out = lit;
  for (unsigned left = mask_of(met); left != 0; left &= left - 1) {
    const int ray = std::countr_zero(left);
    const int first = std::countr_zero(mask_of(met & (triangles == triangles[ray])) & samples_of(ray));
    for (int c = 0; c < 3; ++c) {
      out.base.level[c][ray] = lit.base.level[c][first];
      out.term.level[c][ray] = lit.term.level[c][first];
    }
  }
  return out;
}

// Of what stands, where what moves stops more of its light.
Levels SamplePainter::levels_under_shadow(const Packet& packet, const Kept& own, Ints standing) const {
  const KeptLight& light = kept_light_[place(packet)];
  const Ints before = standing & light.open;
  const Ints open = sun_->open({packet.left, packet.top, packet.x, packet.y, own.depth}, before, {&canvas_.mover});
  const Ints changed = open != before;
  const Levels levels = levels_of(light.lit, sun_->share(open));
  Levels out;
  for (int c = 0; c < 3; ++c) out.level[c] = changed ? levels.level[c] : own.levels.level[c];
  return out;
}

void SamplePainter::draw_changes(const Area& tile, Changes here) {
  Sums sums;
  Waiting mover(canvas_.mover, canvas_.mesh, sums);
  for_packets(tile, [&](const Packet& packet) {
    RTCRayHit16 rays;
    const Kept& own = kept_[place(packet)];
    Ints covered{};
    if (here.mover)
      covered = trace(canvas_.mover, directions_of(canvas_.mover, packet.x, packet.y), packet.inside, own.depth, rays);
    add_view(mover, canvas_.mover, tile, packet, rays, covered);
    const Ints standing = packet.inside & ~covered & (own.depth < kBeyond);
    const Levels levels = here.shadow && any(standing) ? levels_under_shadow(packet, own, standing) : own.levels;
    for (unsigned left = mask_of(packet.inside & ~covered); left != 0; left &= left - 1) {
      const int ray = std::countr_zero(left), pixel = pixel_in(tile, packet, ray);
      for (int c = 0; c < 3; ++c) sums.level[c][pixel] += levels.level[c][ray];
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
