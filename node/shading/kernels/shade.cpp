// Samples become blocks: their values are interpolated, and shade_block does the rest.
#include "node/shading/kernels/block.h"
#include "node/shading/kernels/fragments.h"
#include "node/shading/kernels/functions.h"

namespace mars::shading::MARS_SET {

namespace {

// First of columns [column, last) that shows something, or nothing, or else `last`.
std::uint32_t find(bool something, const std::uint32_t* ids, std::uint32_t column, std::uint32_t last) {
  const auto* shown = reinterpret_cast<const std::int32_t*>(ids);
  const Ints none = hn::Set(kInts, static_cast<std::int32_t>(kNoTriangle));
  for (; column < last; column += kLanes) {
    const Ints here = hn::LoadU(kInts, shown + column);
    const auto at = hn::FindFirstTrue(kInts, something ? hn::Ne(here, none) : hn::Eq(here, none));
    if (at < 0) continue;
    column += static_cast<std::uint32_t>(at);
    break;
  }
  return column < last ? column : last;
}

// One line of pixels with one sample each.
class Line {
 public:
  Line(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, Block& block)
      : triangles_(shading.triangles),
        materials_(shading.materials),
        ids_(ids),
        y_(static_cast<std::int32_t>(line) * shape::kSubpixels + shape::kSampleOffset),
        left_(shading.projection.origin[0]),
        center_(shading.projection.center[0] - 0.5f),
        per_pixel_(1.0f / (shading.projection.scale * shading.projection.squeeze)) {
    const auto of_whole = static_cast<float>(static_cast<std::int32_t>(line) + shading.projection.origin[1]);
    const Floats up = constant((of_whole + 0.5f - shading.projection.center[1]) * (1.0f / shading.projection.scale));
    for (std::uint32_t k = 0; k < kBlock && extent.first + k < extent.last; k += kLanes) {
      hn::Store(up, kFloats, block.from[1] + k);
      hn::Store(constant(1.0f), kFloats, block.from[2] + k);
    }
  }

  // Adds `count` samples from `column` on, none of them a gap, and as many as fit; fewer, perhaps none, where one
  // has another model. Says how many. Whether neighbours show the same triangle is not asked: the answer costs more
  // than the planes of a sample.
  std::uint32_t add(std::uint32_t column, std::uint32_t count, Block& block) const {
    Places sample = {static_cast<std::int32_t>(column) * shape::kSubpixels + shape::kSampleOffset, y_, 0, 0};
    const Places step = {shape::kSubpixels, 0, 0, 0};
    const std::uint32_t* id = ids_ + column;
    float(*values)[shape::kValues] = block.values + block.count;
    std::uint32_t material = block.last_material(~triangles_[*id].material);
    for (const std::uint32_t* end = id + count; id != end; ++id, ++values, sample += step) {
      const geometry::Triangle& t = triangles_[*id];
      if (t.material != material) {
        if (!block.takes(materials_, t.material)) break;
        material = t.material;
        block.begin_stretch(static_cast<std::uint32_t>(values - block.values), material);
      }
      evaluate(t, sample, *values);
    }
    count = static_cast<std::uint32_t>(id - (ids_ + column));
    const Floats center = constant(center_), per_pixel = constant(per_pixel_);
    for (std::uint32_t k = 0; k < count; k += kLanes) {
      const Floats columns = hn::Iota(kFloats, static_cast<float>(left_ + static_cast<std::int32_t>(column + k)));
      hn::StoreU(hn::Mul(hn::Sub(center, columns), per_pixel), kFloats, block.from[0] + block.count + k);
    }
    block.count += count;
    return count;
  }

 private:
  const geometry::Triangle* triangles_;
  const wire::Material* materials_;
  const std::uint32_t* ids_;
  std::int32_t y_;
  std::int32_t left_;
  float center_;
  float per_pixel_;
};

// Puts vertices from `first` on into the block, up to `last`, as many as fit. Some lie behind the eye or at it: 1 / w
// is replaced by what takes the place to a distance of about 1, and there is a direction to the eye even from the eye.
// These are right in parallel projection too.
void add_vertices(const shape::Vertices& v, std::uint32_t first, std::uint32_t last, float side, Block& block) {
  constexpr float kLeast = 1e-9f;
  block.count = last - first < kBlock ? last - first : kBlock;
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    Floats place[3], normal[3], size = zero();
    for (int axis = 0; axis < 3; ++axis) {
      place[axis] = hn::LoadU(kFloats, v.place[axis] + first + k);
      normal[axis] = hn::Mul(constant(side), hn::LoadU(kFloats, v.normal[axis] + first + k));
      size = hn::Max(size, hn::Abs(place[axis]));
    }
    const auto apart = hn::Gt(size, constant(kLeast));
    const Floats nearer = hn::Div(constant(1.0f), hn::Max(size, constant(kLeast)));
    for (int axis = 0; axis < 3; ++axis) {
      const Floats there = constant(axis == 2 ? 1.0f : 0.0f);
      hn::Store(hn::IfThenElse(apart, hn::Neg(hn::Mul(place[axis], nearer)), there), kFloats, block.from[axis] + k);
    }
    hn::StoreInterleaved4(nearer, normal[0], normal[1], normal[2], kFloats, block.values[k]);
  }
}

}  // namespace

Shaded shade(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, wire::Run* runs,
             void* pixels) {
  Shaded done{0, 0};
  Block block(shading);
  const Line samples(shading, ids, line, extent, block);
  const std::size_t pixel_bytes = wire::pixel_bytes(shading.encoding.format);
  const auto flush = [&] {
    if (block.count == 0) return;
    if (block.parallel) block.place_parallel();
    shade_to_pixels(shading, block, static_cast<std::byte*>(pixels) + done.pixels * pixel_bytes);
    done.pixels += block.count;
    done.counts += counts_of(shading, block);
    block.clear();
  };
  const std::uint32_t last = extent.last;
  for (std::uint32_t first = find(true, ids, extent.first, last); first < last;) {
    const std::uint32_t end = find(false, ids, first, last);
    runs[done.runs++] = {line, static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(end - first)};
    for (std::uint32_t column = first; column < end;) {
      const std::uint32_t capacity = kBlock - block.count;
      const std::uint32_t count = end - column < capacity ? end - column : capacity;
      const std::uint32_t added = count > 0 ? samples.add(column, count, block) : 0;
      if (added < count || count == 0) flush();
      column += added;
    }
    first = find(true, ids, end, last);
  }
  flush();
  return done;
}

ShadedCounts shade_fragments(const Shading& shading, const Fragment* fragments, std::uint32_t count, std::uint32_t line,
                             float* const* light) {
  ShadedCounts counts;
  Block block(shading);
  for (std::uint32_t done = 0; done < count; done += block.count) {
    block.clear();
    add_fragments(shading, fragments + done, count - done, line, block);
    shade_to_light(shading, block);
    counts += counts_of(shading, block);
    for (int c = 0; c < 3; ++c)
      for (std::uint32_t k = 0; k < block.count; k += kLanes)
        hn::StoreU(hn::Load(kFloats, block.color[c] + k), kFloats, light[c] + done + k);
  }
  return counts;
}

void shade_vertices(const Shading& shading, std::uint32_t material, float side, const shape::Vertices& vertices,
                    std::uint32_t count, const shape::VertexColors& out) {
  Block block(shading);
  for (std::uint32_t done = 0; done < count; done += block.count) {
    block.clear();
    block.begin_stretch(0, material);
    add_vertices(vertices, done, count, side, block);
    light_vertices(shading, block);
    for (std::uint32_t k = 0; k < block.count; k += kLanes) {
      Floats values[shape::kValues], color[3];
      hn::LoadInterleaved4(kFloats, vertices.values[done + k], values[0], values[1], values[2], values[3]);
      const Floats inverse_w = block.parallel ? constant(1.0f) : values[0];
      for (int c = 0; c < 3; ++c) {
        color[c] = hn::Load(kFloats, block.color[c] + k);
        hn::StoreU(color[c], kFloats, out.color[c] + done + k);
      }
      hn::StoreInterleaved4(values[0], hn::Mul(color[0], inverse_w), hn::Mul(color[1], inverse_w),
                            hn::Mul(color[2], inverse_w), kFloats, out.values[done + k]);
    }
  }
}

}  // namespace mars::shading::MARS_SET
