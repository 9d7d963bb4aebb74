// How far kernels, which work on whole vectors, reach beyond what they are asked for.
#pragma once

namespace mars::simd {

// Every array of vertices, of triangles' corners and of pixels is longer by this many items than is asked for,
// which may be written (with anything) or read; corners there must be numbers of vertices. So has a line's depth and
// ids; there what lies behind the line is read, and written back as it was.
inline constexpr int kVectorSlack = 16;

}  // namespace mars::simd
