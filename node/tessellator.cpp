#include "node/tessellator.h"

#include <algorithm>
#include <cstddef>

namespace mars::node {

Tessellator::Tessellator(simd::InstructionSet set) : instruction_set_(set), dicer_(set), placer_(set) {}

Tessellation Tessellator::tessellate(const geometry::Scene& scene, wire::FrameKind kind, const Scatter& scatter,
                                     const LineTable& lines, raster::Arena& arena, wire::WorkCounts& work) {
  std::ranges::fill(lines.counts, 0u);
  work.patches = work.vertices = 0;
  raster::SetUps out(arena.rest(), lines.counts, lines.wanted);
  if (kind == wire::FrameKind::keyframe) add(scene, false, scatter, out, work);
  const std::size_t stationary = out.boxes().size();
  add(scene, true, scatter, out, work);
  const auto boxes = out.boxes();
  arena.take_ends(out.triangles().size_bytes(), boxes.size_bytes());
  return {{out.first, boxes.last(stationary), boxes.first(boxes.size() - stationary)},
          {out.touching, out.edge_boxes},
          out.all_stored()};
}

void Tessellator::add(const geometry::Scene& scene, bool moving, const Scatter& scatter, raster::SetUps& out,
                      wire::WorkCounts& work) {
  const wire::FilmView& film = scene.film();
  raster::SetUp set_up(instruction_set_, scene.projection(), scene.width(), scene.height());
  const auto width = static_cast<float>(scene.width()), height = static_cast<float>(scene.height());
  const int fixed_rate = static_cast<int>(film.settings().dice);
  const auto set_up_surface = [&](const shape::Surface& surface, raster::PatchIdentity& identity,
                                  std::uint32_t number) {
    identity.patch = number;
    set_up.add(surface, identity, out);
    ++work.patches;
    work.vertices += static_cast<std::uint64_t>(surface.vertex_count());
  };
  for (std::size_t s = 0; s < film.segments().size(); ++s) {
    if (scene.moves(s) != moving) continue;
    const wire::Shape& shape = film.shapes()[film.segments()[s].shape];
    const std::uint32_t first = scene.first_patch(s);
    std::uint64_t i = (scatter.index + scatter.count - first % scatter.count) % scatter.count;
    if (i >= shape.size()) continue;
    const shape::EyeMatrix matrix = scene.matrix(s);
    const std::uint32_t material = scene.material(s);
    raster::PatchIdentity identity{0, material, shape::mirrors(matrix), film.materials()[material].sides == 1, moving};
    for (; i < shape.patch_count; i += scatter.count) {
      const shape::EyePatch patch = shape::to_eye(matrix, film.patches()[shape.first_patch + i]);
      if (shape::unseen(patch, scene.projection(), width, height)) continue;
      dicer_.dice(patch, scene.projection(), fixed_rate);
      set_up_surface(dicer_, identity, first + static_cast<std::uint32_t>(i));
    }
    if (i >= shape.size()) continue;
    const shape::EyeMap map = geometry::eye_map(matrix);
    for (; i < shape.size(); i += scatter.count) {
      const wire::Meshlet& meshlet = film.meshlets()[shape.first_meshlet + i - shape.patch_count];
      if (geometry::unseen(matrix, meshlet, scene.projection(), width, height)) continue;
      placer_.place(map, film, meshlet, scene.projection());
      set_up_surface(placer_, identity, first + static_cast<std::uint32_t>(i));
    }
  }
}

}  // namespace mars::node
