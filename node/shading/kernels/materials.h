// The materials of a vector of samples, one a lane.
#pragma once

#include "node/shading/kernels/block.h"

namespace mars::shading::MARS_SET {

// What a material's constants are multiplied by: `unit`, what 1 is in Block::color, and light from all around where
// that is the same from everywhere, else 1.
struct Scale {
  float unit;
  float ambient[3];
};

// For vectors in the order of a block. Lanes: a model's constants; made from a material and a Scale, and change(mask,
// other) takes over another's where the mask says.
template <typename Lanes>
class Materials {
 public:
  Materials(const wire::Material* materials, const Scale& scale, const Block& block)
      : materials_(materials), scale_(scale), block_(block), lanes_(material(0), scale) {}

  const Lanes& lanes() const { return lanes_; }

  // Goes on to the vector at sample k.
  void move_to(std::uint32_t k) {
    if (first_ == last_ && next_first() >= k + kLanes) return;
    at_ = k;
    if (next_first() == k) ++last_;
    first_ = last_;
    lanes_ = Lanes(material(first_), scale_);
    for (; next_first() < k + kLanes; ++last_) lanes_.change(since(last_ + 1), Lanes(material(last_ + 1), scale_));
  }

  // Of each stretch of the vector, its `function(material)`, which depends on nothing but `key(material)`.
  template <typename Key, typename Function>
  Floats each(const Key& key, const Function& function) const {
    Floats out = function(key(material(first_)));
    for (std::uint32_t s = first_ + 1; s <= last_; ++s)
      if (key(material(s)) != key(material(s - 1))) out = hn::IfThenElse(since(s), function(key(material(s))), out);
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
  Scale scale_;
  const Block& block_;
  Lanes lanes_;
  std::uint32_t at_ = 0;
  std::uint32_t first_ = 0;  // stretches of the vector
  std::uint32_t last_ = 0;
};

// Takes over three channels of `others` where `mask` says.
inline void change(hn::Mask<FloatTag> mask, const Floats* others, Floats* channels) {
  for (int c = 0; c < 3; ++c) channels[c] = hn::IfThenElse(mask, others[c], channels[c]);
}

}  // namespace mars::shading::MARS_SET
