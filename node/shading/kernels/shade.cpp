// Phong's model at the samples that are seen: a block of samples is interpolated, and then for each light come its
// directions and its colours, a whole vector at a time.
//
// Directions are not normalised before they are used. With n the normal / w, e the direction to the eye and t that to
// the light, R.V = (2 (n.t)(n.e) - (t.e)(n.n)) / ((n.n) |t| |e|). Its square is what is raised to half the exponent,
// so |e| is never taken, and one root and one division do for n and e.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "node/shading/kernels/functions.h"

namespace mars::shading::MARS_SET {

using namespace simd::MARS_SET;

namespace {

Floats constant(float number) { return hn::Set(kFloats, number); }
Floats zero() { return hn::Zero(kFloats); }

Floats dot(const Floats* a, const Floats* b) {
  return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
}

// All values of one sample and what they are computed from: four lanes in one register, with any instruction set;
// arithmetic is lane by lane.
typedef float Sample __attribute__((vector_size(sizeof(float) * shape::kValues)));
typedef std::int32_t Places __attribute__((vector_size(sizeof(std::int32_t) * shape::kValues)));

Sample load(const float* values) {
  Sample out;
  std::memcpy(&out, values, sizeof out);
  return out;
}

// From sample `first` of a block on, until the next.
struct Stretch {
  std::uint32_t first;
  std::uint32_t material;
};

// The samples of one line that show something, without gaps, and their shading.
constexpr std::uint32_t kBlock = 256;
constexpr std::uint32_t kCapacity = kBlock + simd::kVectorSlack;
struct Block {
  alignas(64) float values[kCapacity][shape::kValues];
  alignas(64) float column[kCapacity];
  alignas(64) float facing[kCapacity];  // of one light: N.L
  alignas(64) float square[kCapacity];  // and (R.V)^2; 0 where it is not to be seen
  alignas(64) float color[3][kCapacity];
  Stretch stretches[kBlock];
  std::uint32_t stretch_count = 0;
  std::uint32_t count = 0;
};

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

// Adds `count` samples from `column` on, none of them a gap, and as many as fit. Whether neighbours show
// the same triangle is not asked: the answer costs more than the planes of a sample.
void interpolate(const geometry::Triangle* triangles, const std::uint32_t* ids, std::uint32_t line,
                 std::uint32_t column, std::uint32_t count, Block& block) {
  Places sample = {static_cast<std::int32_t>(column) * shape::kSubpixels + shape::kSampleOffset,
                   static_cast<std::int32_t>(line) * shape::kSubpixels + shape::kSampleOffset, 0, 0};
  const Places step = {shape::kSubpixels, 0, 0, 0};
  const std::uint32_t* id = ids + column;
  float(*values)[shape::kValues] = block.values + block.count;
  std::uint32_t material =
      block.stretch_count > 0 ? block.stretches[block.stretch_count - 1].material : ~triangles[*id].material;
  for (const std::uint32_t* end = id + count; id != end; ++id, ++values, sample += step) {
    const geometry::Triangle& t = triangles[*id];
    if (t.material != material) {
      material = t.material;
      block.stretches[block.stretch_count++] = {static_cast<std::uint32_t>(values - block.values), material};
    }
    Places first;
    std::memcpy(&first, &t.first_x, sizeof first);
    const Sample from_first = __builtin_convertvector(sample - first, Sample);
    const Sample here = (load(t.at_first) + from_first[1] * load(t.per_y)) + from_first[0] * load(t.per_x);
    std::memcpy(*values, &here, sizeof here);
  }
  for (std::uint32_t k = 0; k < count; k += kLanes)
    hn::StoreU(hn::Iota(kFloats, static_cast<float>(column + k)), kFloats, block.column + block.count + k);
  block.count += count;
}

// Fills facing and square for one light.
void face(const shape::Projection& p, std::uint32_t line, const geometry::EyeLight& light, Block& block) {
  const Floats per_pixel = constant(1.0f / p.scale), center = constant(p.center[0] - 0.5f), one = constant(1.0f);
  const Floats up = constant((static_cast<float>(line) + 0.5f - p.center[1]) * (1.0f / p.scale));
  const Floats vector[3] = {constant(light.vector[0]), constant(light.vector[1]), constant(light.vector[2])};
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    Floats n[3], inverse_w;
    hn::LoadInterleaved4(kFloats, block.values[k], inverse_w, n[0], n[1], n[2]);
    const Floats eye[3] = {hn::Mul(hn::Sub(center, hn::Load(kFloats, block.column + k)), per_pixel), up, one};
    const Floats nn = dot(n, n), ee = dot(eye, eye), ne = dot(n, eye);
    const Floats length = hn::Sqrt(nn);
    const Floats inverse = hn::Div(one, hn::Mul(length, ee));
    const Floats unit = hn::IfThenElseZero(hn::Gt(nn, zero()), hn::Mul(inverse, ee));  // 1 / |n|
    const Floats inverse_ee = hn::Mul(inverse, length);

    Floats to[3] = {vector[0], vector[1], vector[2]};
    Floats both = unit;  // 1 / (|n| |to|)
    if (light.kind != wire::LightKind::directional) {
      // The place is -eye * w; the length of `to` does not matter.
      for (int axis = 0; axis < 3; ++axis) to[axis] = hn::Add(hn::Mul(vector[axis], inverse_w), eye[axis]);
      const Floats square = dot(to, to);
      both = hn::IfThenElseZero(hn::Gt(square, zero()), hn::Div(unit, hn::Sqrt(square)));
    }
    const Floats nt = dot(n, to), te = dot(to, eye);
    const Floats reflected = hn::Sub(hn::Mul(hn::Add(nt, nt), ne), hn::Mul(te, nn));
    const Floats mirrored = hn::Mul(hn::Mul(reflected, both), unit);
    const Floats square = hn::Min(hn::Mul(hn::Mul(mirrored, mirrored), inverse_ee), one);
    const auto front = hn::Gt(nt, zero());
    hn::Store(hn::IfThenElseZero(front, hn::Mul(nt, both)), kFloats, block.facing + k);
    hn::Store(hn::IfThenElseZero(hn::And(front, hn::Gt(mirrored, zero())), square), kFloats, block.square + k);
  }
}

// square ^ (exponent / 2), square in 0..1, by squarings and square roots; the exponent counts to 1/256.
Floats raise(Floats square, float exponent) {
  const auto fixed = static_cast<std::uint32_t>(exponent * 256.0f + 0.5f);
  Floats power = hn::IfThenElseZero(hn::Gt(square, zero()), constant(1.0f));  // no light is none at exponent 0 too
  Floats root = square;
  std::uint32_t rest = fixed & 511;
  for (std::uint32_t bit = 256; rest != 0; bit >>= 1) {
    root = hn::Sqrt(root);
    if (rest & bit) power = hn::Mul(power, root);
    rest &= ~bit;
  }
  for (std::uint32_t whole = fixed >> 9; whole != 0; whole >>= 1) {
    if (whole & 1) power = hn::Mul(power, square);
    square = hn::Mul(square, square);
  }
  return power;
}

// Materials of a vector's samples, one a lane, colours in levels.
struct MaterialLanes {
  Floats ambient[3], diffuse[3], specular;

  explicit MaterialLanes(const wire::Material& m) : specular(constant(255.0f * m.specular)) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float own = 255.0f * m.color[c];
      ambient[c] = constant(m.ambient * own);
      diffuse[c] = constant(m.diffuse * own);
    }
  }
  // Where `mask` says, those of `other`.
  void change(hn::Mask<FloatTag> mask, const MaterialLanes& other) {
    for (int c = 0; c < 3; ++c) {
      ambient[c] = hn::IfThenElse(mask, other.ambient[c], ambient[c]);
      diffuse[c] = hn::IfThenElse(mask, other.diffuse[c], diffuse[c]);
    }
    specular = hn::IfThenElse(mask, other.specular, specular);
  }
};

// The materials of a vector of samples, for vectors in the order of a block.
class Materials {
 public:
  Materials(const wire::Material* materials, const Block& block)
      : materials_(materials), block_(block), lanes_(material(0)) {}

  const MaterialLanes& lanes() const { return lanes_; }

  // Goes on to the vector at sample k.
  void move_to(std::uint32_t k) {
    if (first_ == last_ && next_first() >= k + kLanes) return;
    at_ = k;
    if (next_first() == k) ++last_;
    first_ = last_;
    lanes_ = MaterialLanes(material(first_));
    for (; next_first() < k + kLanes; ++last_) lanes_.change(since(last_ + 1), MaterialLanes(material(last_ + 1)));
  }

  // The light mirrored to the eye, from (R.V)^2.
  Floats highlight(Floats square) const {
    const float exponent = material(first_).exponent;
    Floats out = raise(square, exponent);
    for (std::uint32_t s = first_ + 1; s <= last_; ++s)
      if (material(s).exponent != material(s - 1).exponent)
        out = hn::IfThenElse(since(s), raise(square, material(s).exponent), out);
    return out;
  }

 private:
  const wire::Material& material(std::uint32_t stretch) const { return materials_[block_.stretches[stretch].material]; }
  std::uint32_t next_first() const {
    return last_ + 1 < block_.stretch_count ? block_.stretches[last_ + 1].first : ~0u;
  }
  // The vector's samples from a stretch's first on.
  hn::Mask<FloatTag> since(std::uint32_t stretch) const {
    return hn::Not(hn::FirstN(kFloats, block_.stretches[stretch].first - at_));
  }

  const wire::Material* materials_;
  const Block& block_;
  MaterialLanes lanes_;
  std::uint32_t at_ = 0;
  std::uint32_t first_ = 0;  // stretches of the vector
  std::uint32_t last_ = 0;
};

// The nearest whole number of 0..255 in the lowest bits, others above them: sums of 2^23 and less have no fraction.
Ints level(Floats color) {
  const Floats clamped = hn::Min(hn::Max(color, zero()), constant(255.0f));
  return hn::BitCast(kInts, hn::Add(clamped, constant(8388608.0f)));
}

Ints pack(const Floats* color) {
  const Ints red = hn::And(level(color[0]), hn::Set(kInts, 255));
  const Ints green = hn::And(hn::ShiftLeft<8>(level(color[1])), hn::Set(kInts, 255 << 8));
  return hn::Or(hn::Or(red, green), hn::ShiftLeft<16>(level(color[2])));
}

// Adds one light to the block's colours; the first begins with the ambient ones, the last makes pixels of them.
void add_light(const wire::Material* all, const geometry::EyeLight& light, bool first, bool last, Block& block,
               std::uint32_t* pixels) {
  const Floats shines[3] = {constant(light.color[0]), constant(light.color[1]), constant(light.color[2])};
  Materials materials(all, block);
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    materials.move_to(k);
    const MaterialLanes& lanes = materials.lanes();
    const Floats facing = hn::Load(kFloats, block.facing + k);
    const Floats mirrored = hn::Mul(lanes.specular, materials.highlight(hn::Load(kFloats, block.square + k)));
    Floats color[3];
    for (int c = 0; c < 3; ++c) {
      const Floats before = first ? lanes.ambient[c] : hn::Load(kFloats, block.color[c] + k);
      color[c] = hn::Add(before, hn::Mul(hn::Add(hn::Mul(lanes.diffuse[c], facing), mirrored), shines[c]));
    }
    if (last)
      hn::StoreU(pack(color), kInts, reinterpret_cast<std::int32_t*>(pixels + k));
    else
      for (int c = 0; c < 3; ++c) hn::Store(color[c], kFloats, block.color[c] + k);
  }
}

void shade_block(const Shading& shading, std::uint32_t line, Block& block, std::uint32_t* pixels) {
  const geometry::EyeLight dark{};
  const geometry::EyeLight* lights = shading.light_count > 0 ? shading.lights : &dark;
  const std::uint32_t count = shading.light_count > 0 ? shading.light_count : 1;
  for (std::uint32_t l = 0; l < count; ++l) {
    face(shading.projection, line, lights[l], block);
    add_light(shading.materials, lights[l], l == 0, l + 1 == count, block, pixels);
  }
}

}  // namespace

Shaded shade(const Shading& shading, const std::uint32_t* ids, std::uint32_t line, Extent extent, wire::Run* runs,
             std::uint32_t* pixels) {
  Shaded done{0, 0};
  Block block;
  const auto flush = [&] {
    if (block.count == 0) return;
    shade_block(shading, line, block, pixels + done.pixels);
    done.pixels += block.count;
    block.count = block.stretch_count = 0;
  };
  const std::uint32_t last = extent.last;
  for (std::uint32_t first = find(true, ids, extent.first, last); first < last;) {
    const std::uint32_t end = find(false, ids, first, last);
    runs[done.runs++] = {line, static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(end - first)};
    for (std::uint32_t column = first; column < end;) {
      if (block.count == kBlock) flush();
      const std::uint32_t capacity = kBlock - block.count;
      const std::uint32_t count = end - column < capacity ? end - column : capacity;
      interpolate(shading.triangles, ids, line, column, count, block);
      column += count;
    }
    first = find(true, ids, end, last);
  }
  flush();
  return done;
}

}  // namespace mars::shading::MARS_SET
