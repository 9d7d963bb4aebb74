#include "node/color/kernels/encode.h"

namespace mars::color::MARS_SET {

void encode(const Encoding& encoding, const float* const* light, std::uint32_t count, void* pixels) {
  encode_planes(encoding, light, count, pixels);
}

}  // namespace mars::color::MARS_SET
