// AgX, Troy Sobotka's curve (github.com/sobotka/AgX), in the form of Benjamin Wrensch's "Minimal AgX Implementation"
// (iolite-engine.com/blog_posts/minimal_agx_implementation), which Blender's and many programs' AgX looks like: colours
// go towards white as light grows, as on film. Red, green and blue are mixed by kAgxInset; each one's logarithm, from
// 10 stops below mid-grey to 6.5 above, goes through a curve; kAgxOutset unmixes what comes out, which is then shown
// by a power of 2.2. Both functions are tables, between whose entries values are interpolated, because logarithms and
// powers of libraries differ in their last bits. Plain: kernels of several instruction sets share them.
#pragma once

#include <cstdint>

namespace mars::color {

// Rows: what goes into red, green and blue.
inline constexpr float kAgxInset[3][3] = {{0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f},
                                          {0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f},
                                          {0.0423756549057051f, 0.0784336f, 0.879142973793104f}};
inline constexpr float kAgxOutset[3][3] = {{1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f},
                                           {-0.0528968517574562f, 1.15190312990417f, -0.0989611768448433f},
                                           {-0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f}};

// Light beyond is as dark, or as bright, as these: mid-grey, 0.18, ten stops darker, with bits that end in zeros, so
// that no entry of the curve's table lies across a power of two; and 6.5 stops brighter.
inline constexpr float kAgxDarkest = 0x1.7p-13f, kAgxBrightest = 16.2917402385381f;

// Of the curve: 2^7 entries a stop, by the bits of light.
inline constexpr int kAgxEntryBits = 16;
// Of the power.
inline constexpr std::uint32_t kAgxSteps = 4096;

struct AgxTables {
  const float* curve = nullptr;  // light to about 0..1, before it is unmixed
  const float* power = nullptr;  // 0..1 in kAgxSteps steps, and one; to what is shown
};

AgxTables agx_tables();

}  // namespace mars::color
