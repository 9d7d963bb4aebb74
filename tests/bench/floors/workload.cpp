#include "node/simd/instruction_set.h"
#include "tests/bench/floors/workload.h"

#include <algorithm>

#include "node/shading/shading_of.h"
#include "node/tessellator.h"

namespace mars::bench {
namespace {

constexpr std::size_t kMemory = std::size_t{1} << 30;  // address space; pages come as they are touched

}  // namespace

Workload::Workload(const std::filesystem::path& film, const film::CompileOptions& options)
    : film_(film::load_film(film, options)),
      view_(film_.view()),
      scene_(view_),
      made_memory_(kMemory),
      filled_memory_(kMemory),
      made_(made_memory_.bytes()),
      filled_(filled_memory_.bytes()),
      line_loads_(view_.settings().height),
      ebc_(line_loads_.size() + 1),
      wanted_(line_loads_.size(), 1) {
  scene_.set_interval(0);
  scene_.set_frame(0);
  const simd::InstructionSet set = simd::best_instruction_set("");
  make(set);
  for (std::size_t line = 0; line < line_loads_.size(); ++line) ebc_[line + 1] = ebc_[line] + line_loads_[line].boxes();
  fill();
  shape::Dicer dicer(set);
  dice(dicer);
  find_pieces();
}

void Workload::dice(shape::Dicer& dicer, const std::function<void(const shape::Surface&)>& visit) {
  classified_ = 0;
  const int rate = static_cast<int>(view_.settings().dice);
  for (std::size_t s = 0; s < view_.segments().size(); ++s) {
    const wire::Shape& shape = view_.shapes()[view_.segments()[s].shape];
    const shape::EyeMatrix matrix = scene_.matrix(s);
    for (std::uint32_t i = 0; i < shape.patch_count; ++i) {
      const shape::EyePatch patch = shape::to_eye(matrix, view_.patches()[shape.first_patch + i]);
      if (shape::unseen(patch, scene_.projection(), static_cast<float>(width()), static_cast<float>(height())))
        continue;
      dicer.dice(patch, scene_.projection(), {.fixed_rate = rate, .tolerances = {}});
      classified_ += dicer.triangles().count;
      if (visit) visit(dicer);
    }
  }
}

// All as if they stood still.
void Workload::make(simd::InstructionSet set) {
  made_.clear();
  counts_ = {};
  auto* const first = reinterpret_cast<geometry::Triangle*>(made_memory_.bytes().data());
  const node::Tessellation own =
      node::Tessellator(set).tessellate(scene_, {}, {wanted_, wanted_, line_loads_}, {made_, first}, counts_);
  const auto [triangles, stationary, moving] = own.polygons;
  counts_.triangles = own.made.triangles;
  polygons_ = {triangles, {moving.data(), moving.size() + stationary.size()}, {}};
  shading_ = shading::shading_of(scene_);
  shading_.triangles = triangles;
}

void Workload::fill() {
  filled_.clear();
  raster::LineFiller filler({0, height()}, ebc_, polygons_.triangles, filled_);
  filler.add(polygons_);
  boxes_ = filler.finish();
}

void Workload::find_pieces() {
  const raster::RasterKernels& kernels = raster::raster_kernels(simd::best_instruction_set(""));
  std::vector<float> depth(width() + simd::kVectorSlack);
  std::vector<std::uint32_t> ids(depth.size());
  for (std::uint32_t line = 0; line < height(); ++line) {
    std::fill(depth.begin(), depth.end(), 0.0f);
    std::fill(ids.begin(), ids.end(), shading::kNoTriangle);
    const auto boxes = boxes_.stationary(line);
    kernels.draw(shading_.triangles, boxes.data(), static_cast<std::uint32_t>(boxes.size()), line, scene_.pattern(),
                 {depth.data(), ids.data(), 0});
    for (std::uint32_t first = 0, last; first < width(); first = last) {
      for (last = first + 1; last < width() && ids[last] == ids[first];) ++last;
      if (ids[first] == shading::kNoTriangle) continue;
      pieces_.push_back({ids[first], line, first, last});
      pixels_ += last - first;
    }
  }
}

}  // namespace mars::bench
