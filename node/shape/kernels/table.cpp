#include "node/simd/simd.h"

#define MARS_JOIN2(a, b) a##b
#define MARS_JOIN(a, b) MARS_JOIN2(a, b)
#define MARS_TEXT2(a) #a
#define MARS_TEXT(a) MARS_TEXT2(a)

namespace mars::node {

extern const Kernels MARS_JOIN(kernels_, MARS_SET);
const Kernels MARS_JOIN(kernels_, MARS_SET) = {
    MARS_TEXT(MARS_SET), MARS_SET::survey, MARS_SET::evaluate, MARS_SET::move,  MARS_SET::project,
    MARS_SET::examine,   MARS_SET::set,    MARS_SET::keep,     MARS_SET::draw,  MARS_SET::shade};

}  // namespace mars::node
