// Phong's model at the samples of a block: for each light come its directions and its colours, a whole vector at a
// time.
//
// Directions are not normalised before they are used. With n the normal / w, e the direction to the eye and t that to
// the light, R.V = (2 (n.t)(n.e) - (t.e)(n.n)) / ((n.n) |t| |e|). Its square is what is raised to half the exponent,
// so |e| is never taken, and one root and one division do for n and e.
#include <cstddef>
#include <cstdint>

#include "node/shading/kernels/block.h"

namespace mars::shading::MARS_SET {

namespace {

// Fills facing and square for one light.
void face(const geometry::EyeLight& light, Block& block) {
  const Floats one = constant(1.0f);
  const Floats vector[3] = {constant(light.vector[0]), constant(light.vector[1]), constant(light.vector[2])};
  for (std::uint32_t k = 0; k < block.count; k += kLanes) {
    Floats n[3], inverse_w;
    hn::LoadInterleaved4(kFloats, block.values[k], inverse_w, n[0], n[1], n[2]);
    const Floats eye[3] = {hn::Load(kFloats, block.eye[0] + k), hn::Load(kFloats, block.eye[1] + k),
                           hn::Load(kFloats, block.eye[2] + k)};
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

// Materials of a vector's samples, one a lane; 1 is `scale`.
struct MaterialLanes {
  Floats ambient[3], diffuse[3], specular;

  MaterialLanes(const wire::Material& m, float scale) : specular(constant(scale * m.specular)) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float own = scale * m.color[c];
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
  Materials(const wire::Material* materials, float scale, const Block& block)
      : materials_(materials), scale_(scale), block_(block), lanes_(material(0), scale) {}

  const MaterialLanes& lanes() const { return lanes_; }

  // Goes on to the vector at sample k.
  void move_to(std::uint32_t k) {
    if (first_ == last_ && next_first() >= k + kLanes) return;
    at_ = k;
    if (next_first() == k) ++last_;
    first_ = last_;
    lanes_ = MaterialLanes(material(first_), scale_);
    for (; next_first() < k + kLanes; ++last_)
      lanes_.change(since(last_ + 1), MaterialLanes(material(last_ + 1), scale_));
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
  float scale_;
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

// Adds one light to the block's colours, in which 1 is `scale`; the first begins with the ambient ones. If there are
// `pixels`, colours are levels that are packed instead.
void add_light(const wire::Material* all, float scale, const geometry::EyeLight& light, bool first, Block& block,
               std::uint32_t* pixels) {
  const Floats shines[3] = {constant(light.color[0]), constant(light.color[1]), constant(light.color[2])};
  Materials materials(all, scale, block);
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
    if (pixels)
      hn::StoreU(pack(color), kInts, reinterpret_cast<std::int32_t*>(pixels + k));
    else
      for (int c = 0; c < 3; ++c) hn::Store(color[c], kFloats, block.color[c] + k);
  }
}

void shade_block(const Shading& shading, float scale, Block& block, std::uint32_t* pixels) {
  const geometry::EyeLight dark{};
  const geometry::EyeLight* lights = shading.light_count > 0 ? shading.lights : &dark;
  const std::uint32_t count = shading.light_count > 0 ? shading.light_count : 1;
  for (std::uint32_t l = 0; l < count; ++l) {
    face(lights[l], block);
    add_light(shading.materials, scale, lights[l], l == 0, block, l + 1 == count ? pixels : nullptr);
  }
}

// Coded colours are shown as they are: none is brighter than white.
void clamp(Block& block) {
  for (auto& color : block.color)
    for (std::uint32_t k = 0; k < block.count; k += kLanes)
      hn::Store(hn::Min(hn::Max(hn::Load(kFloats, color + k), zero()), constant(1.0f)), kFloats, color + k);
}

void encode(const color::Encoding& encoding, const Block& block, std::byte* pixels) {
  const std::size_t bytes = wire::pixel_bytes(encoding.format);
  for (std::uint32_t k = 0; k < block.count; ++k) {
    const float light[3] = {block.color[0][k], block.color[1][k], block.color[2][k]};
    const std::uint64_t pixel = color::pixel_of(encoding, light);
    std::memcpy(pixels + k * bytes, &pixel, bytes);
  }
}

}  // namespace

void shade_to_light(const Shading& shading, Block& block) {
  shade_block(shading, 1, block, nullptr);
  if (shading.encoding.space == wire::ColorSpace::coded) clamp(block);
}

// Levels are shaded at once where nothing comes between them and light.
void shade_to_pixels(const Shading& shading, Block& block, std::byte* pixels) {
  const color::Encoding& encoding = shading.encoding;
  if (encoding.space == wire::ColorSpace::coded && encoding.format == wire::PixelFormat::rgb8) {
    shade_block(shading, 255, block, reinterpret_cast<std::uint32_t*>(pixels));
  } else {
    shade_to_light(shading, block);
    encode(encoding, block, pixels);
  }
}

}  // namespace mars::shading::MARS_SET
