#include "tests/bench/floors/bare.h"

namespace mars::bench {

extern const Bare bare_sse2;
extern const Bare bare_sse4;
extern const Bare bare_avx2;
extern const Bare bare_avx512;

const Bare& bare_for(std::string_view name) {
  return name == "avx512" ? bare_avx512 : name == "avx2" ? bare_avx2 : name == "sse4" ? bare_sse4 : bare_sse2;
}

}  // namespace mars::bench
