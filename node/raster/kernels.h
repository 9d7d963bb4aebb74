// The inner loops of the raster step, each written once and compiled for several instruction sets (kernels/); the bits
// are the same for all of them. Plain structs and pointers only, as in shape/kernels.h.
#pragma once

#include <cstdint>

#include "node/raster/classified.h"
#include "node/raster/edge_box.h"
#include "node/shading/shading.h"

namespace mars::simd {
enum class InstructionSet;
}

namespace mars::raster {

// The samples of one line of pixels: the sub-scanlines of its pattern, `stride` samples apart.
struct LineSamples {
  float* depth;
  std::uint32_t* ids;
  std::uint32_t stride;
};

// Groups of samples that share one shading (pixel_groups.h): first that of each pixel with the sample nearest to
// its centre, by column, then the others, of each pixel by their nearest samples.
struct Groups {
  shading::Fragment* fragments;  // to be shaded
  std::uint32_t* masks;          // samples of a group, one bit each
  std::uint32_t* pixels;         // of the others: their pixels, as numbered by the first groups
};

struct GroupCounts {
  std::uint32_t pixels;
  std::uint32_t others;
};

// One array a channel: red, green, blue.
struct Light {
  float* channel[3];
};

struct RasterKernels {
  void (*classify)(const ClassifyTask& task, const shape::Vertices& vertices, const shape::Triangles& triangles,
                   const shape::Batch& batch, Classified& out);

  // The triangle's identity and planes.
  void (*set_up_planes)(const shape::Vertices& vertices, const shape::Corner3& corners, const ScreenShape& shape,
                        const PatchIdentity& identity, geometry::Triangle& out);

  // Stores set-ups of those of the batch's decided triangles that `lanes` has bits for, and that have a box on a
  // wanted line. They must all fit.
  void (*emit)(const shape::Vertices& vertices, const shape::Triangles& triangles, const shape::Batch& batch,
               const Classified& classified, std::uint32_t lanes, const PatchIdentity& identity, SetUpSpace& out);

  // Draws `count` edge boxes of line `line`, in any order: a sample nearer than its depth takes over depth and id; of
  // two triangles as near the lower patch's is seen, within a patch the first. Says which columns the boxes span.
  shading::Extent (*draw)(const geometry::Triangle* triangles, const EdgeBox* boxes, std::uint32_t count,
                          std::uint32_t line, const shape::SamplePattern& pattern, const LineSamples& samples);

  // Groups the samples seen on columns `extent`; beside these columns nothing is seen. Arrays have twice kVectorSlack
  // to spare behind a line's samples.
  GroupCounts (*group)(const shape::SamplePattern& pattern, const LineSamples& seen, shading::Extent extent,
                       const Groups& out);
  // Each pixel's light becomes the sum of its groups' by their share of `samples`; masks become the pixels'.
  void (*add_groups)(const Groups& groups, const GroupCounts& counts, std::uint32_t samples, const Light& light);
  // Adds the background to `pixels` pixels by the samples that their masks leave.
  void (*add_background)(const std::uint32_t* masks, std::uint32_t pixels, std::uint32_t samples,
                         const float* background, const Light& light);
};

const RasterKernels& raster_kernels(simd::InstructionSet set);

}  // namespace mars::raster
