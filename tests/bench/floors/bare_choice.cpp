#include "tests/bench/floors/bare.h"

namespace mars::bench {

extern const Bare bare_sse2;
extern const Bare bare_sse4;
extern const Bare bare_avx2;
extern const Bare bare_avx512;

const Bare& bare_for(simd::InstructionSet set) {
  switch (set) {
    case simd::InstructionSet::avx512: return bare_avx512;
    case simd::InstructionSet::avx2: return bare_avx2;
    case simd::InstructionSet::sse4: return bare_sse4;
    default: return bare_sse2;
  }
}

}  // namespace mars::bench
