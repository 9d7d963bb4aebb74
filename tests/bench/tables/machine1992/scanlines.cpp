#include "tests/bench/tables/machine1992/scanlines.h"

#include <algorithm>

#include "node/simd/instruction_set.h"
#include "node/simd/vector_slack.h"

namespace mars::machine1992 {
namespace {

constexpr auto kSlack = static_cast<std::size_t>(2 * simd::kVectorSlack);

// Of two triangles as near the lower patch's is seen, within a patch the first.
bool precedes(const geometry::Triangle* triangles, std::uint32_t a, std::uint32_t b) {
  if (b == shading::kNoTriangle) return false;
  const std::uint32_t patch_a = triangles[a].patch, patch_b = triangles[b].patch;
  return patch_a != patch_b ? patch_a < patch_b : a < b;
}

}  // namespace

Scanlines::Scanlines(std::uint32_t width)
    : kernels_(shading::shading_kernels(simd::best_instruction_set(""))),
      width_(width),
      ids_(width + kSlack, shading::kNoTriangle),
      runs_(width + kSlack),
      shaded_(width + kSlack) {}

void Scanlines::draw_stationary(const EdgeLists& lists, const geometry::LineRange& lines, shading::Shading shading,
                                FrameBuffers& buffers, WorkCounts& work) {
  shading.triangles = lists.triangles();
  for (std::uint32_t line = lines.first; line < lines.last; ++line)
    draw_line(lists, lists.first_of(line, false), line, shading, nullptr, buffers.constant, work);
}

void Scanlines::draw_moving(const EdgeLists& lists, const geometry::LineRange& lines, shading::Shading shading,
                            FrameBuffers& buffers, WorkCounts& work) {
  shading.triangles = lists.triangles();
  for (std::uint32_t line = lines.first; line < lines.last; ++line)
    draw_line(lists, lists.first_of(line, true), line, shading, buffers.constant.depths_of(line).data(), buffers.moving,
              work);
}

void Scanlines::draw_line(const EdgeLists& lists, std::uint32_t first, std::uint32_t line,
                          const shading::Shading& shading, const float* behind, Layer& layer, WorkCounts& work) {
  if (first == EdgeLists::kEnd) return;
  for (std::uint32_t number = first; number != EdgeLists::kEnd; number = lists.box(number).next)
    draw_box(shading.triangles, number, lists.box(number), line, behind, layer.depths_of(line).data(), work);
  shade(shading, line, layer.pixels_of(line));
}

void Scanlines::draw_box(const geometry::Triangle* triangles, std::uint32_t number, const EdgeLists::EdgeBox& box,
                         std::uint32_t line, const float* behind, float* depths, WorkCounts& work) {
  const geometry::Triangle& t = triangles[number];
  constexpr auto place = [](std::uint32_t index) {
    return static_cast<std::int32_t>(index) * shape::kSubpixels + shape::kSampleOffset;
  };
  const float on_line =
      t.at_first[shape::kDepth] + static_cast<float>(place(line) - t.first_y) * t.per_y[shape::kDepth];
  ++work[Work::span];
  work[Work::pixel] += box.last - box.first;
  for (std::uint32_t column = box.first; column < box.last; ++column) {
    const float depth = on_line + static_cast<float>(place(column) - t.first_x) * t.per_x[shape::kDepth];
    if (behind != nullptr && depth <= behind[column]) continue;
    if (depth < depths[column] || (depth == depths[column] && !precedes(triangles, number, ids_[column]))) continue;
    depths[column] = depth;
    ids_[column] = number;
    ++work[Work::shading];
  }
}

void Scanlines::shade(const shading::Shading& shading, std::uint32_t line, std::span<std::uint32_t> pixels) {
  const shading::Shaded done = kernels_.shade(shading, ids_.data(), line, {0, width_}, runs_.data(), shaded_.data());
  const std::uint32_t* next = shaded_.data();
  for (const wire::Run& run : std::span(runs_).first(done.runs))
    for (std::uint32_t column = run.first; column < run.first + std::uint32_t{run.count}; ++column)
      pixels[column] = *next++ | kDrawn;
  std::ranges::fill(ids_, shading::kNoTriangle);
}

}  // namespace mars::machine1992
