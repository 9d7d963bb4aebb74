#include "node/tessellator.h"

#include <algorithm>
#include <cstddef>

#include "node/geometry/picture_box.h"
#include "node/shading/shading_of.h"

namespace mars::node {
namespace {

geometry::PictureSize size_of(const geometry::Scene& scene) {
  return {static_cast<std::uint32_t>(scene.width()), static_cast<std::uint32_t>(scene.height())};
}

bool meet(const geometry::PictureBounds& bounds, const geometry::LineRange& lines) {
  return geometry::overlap(bounds.lines, lines).count() > 0;
}

}  // namespace

// Sets up a surface's triangles, stores them and counts the work.
struct Tessellator::Output {
  raster::SetUp set_up;
  raster::SetUps& out;
  wire::WorkCounts& work;
  shading::Shading shading;
  shading::ColoredSurface& colored;
  const SurfaceWatch& watch;
  const OwnLines* all_own;        // as in LineTable
  const OwnLines* own = nullptr;  // of the current segment, where only some of it may touch them
  SurfaceCounts counts{};

  void add_patch(const shape::Surface& surface, const raster::PatchIdentity& identity,
                 const geometry::Bending& bending) {
    ++counts.patches;
    counts.vertices += static_cast<std::uint64_t>(surface.vertex_count());
    counts.net_terms += bending.units;
    add_marked(surface, identity, bending);
  }

  void add_meshlet(const shape::Surface& surface, const raster::PatchIdentity& identity,
                   const geometry::Bending& bending) {
    ++counts.meshlets;
    counts.mesh_vertices += static_cast<std::uint64_t>(surface.vertex_count());
    (bending.kind == wire::SurfaceKind::dual_meshlet ? counts.dual_weights : counts.skin_weights) += bending.units;
    add_marked(surface, identity, bending);
  }

  void add_marked(const shape::Surface& surface, const raster::PatchIdentity& identity,
                  const geometry::Bending& bending) {
    const std::uint64_t triangles = out.touching, edge_boxes = out.edge_boxes, colored = counts.colored;
    add(surface, identity);
    if (watch.marks != nullptr)
      watch.marks->push_back({identity.patch, bending, static_cast<std::uint64_t>(surface.vertex_count()),
                              surface.triangles().count, counts.colored - colored, out.touching - triangles,
                              out.edge_boxes - edge_boxes});
  }

  void add(const shape::Surface& surface, const raster::PatchIdentity& identity) {
    if (watch.diced != nullptr)
      watch.diced->keep(identity.moving ? shadow::Casting::moving : shadow::Casting::still, identity.patch, surface);
    ++work.patches;
    work.vertices += static_cast<std::uint64_t>(surface.vertex_count());
    work.triangles_tested += surface.triangles().count;
    const shading::Coloring coloring{shading, identity.material, !(identity.one_sided && identity.mirrored),
                                     !identity.one_sided || identity.mirrored};
    switch (shading.materials[identity.material].interpolation) {
      case wire::Interpolation::phong: return set_up.add(surface, identity, out);
      case wire::Interpolation::gouraud:
        counts.colored += static_cast<std::uint64_t>(surface.vertex_count()) * (coloring.outside + coloring.inside);
        return set_up.add(colored.by_vertices(surface, coloring), identity, out);
      case wire::Interpolation::flat:
        counts.colored += surface.triangles().count;
        for (std::uint32_t first = 0; first < surface.triangles().count; first += colored.kFlatTriangles)
          set_up.add(colored.by_triangles(surface, first, coloring), identity, out);
    }
  }
};

bool Scatter::any() const {
  return remainders.empty() ? index < count : std::ranges::count(remainders, std::uint8_t{1}) > 0;
}

std::uint64_t Scatter::from(std::uint64_t number) const {
  if (remainders.empty()) return number + (index + count - number % count) % count;
  while (remainders[number % count] == 0) ++number;
  return number;
}

Tessellator::Tessellator(simd::InstructionSet set, Heartbeat* heartbeat)
    : instruction_set_(set), heartbeat_(heartbeat), dicer_(set), placer_(set), colored_(set) {}

Tessellation Tessellator::tessellate(const geometry::Scene& scene, const Scatter& scatter, const LineTable& lines,
                                     const TriangleSpace& space, wire::WorkCounts& work, const SurfaceWatch& watch) {
  std::ranges::fill(lines.loads, raster::LineLoad());
  work.patches = work.vertices = work.triangles_tested = 0;
  raster::SetUps out(space.arena.rest(), space.first, scene.pattern(), lines.loads);
  Output output{
      {instruction_set_, scene.projection(), scene.width(), scene.height(), scene.pattern(), scene.casting_count() > 0},
      out,
      work,
      shading::shading_of(scene),
      colored_,
      watch,
      lines.own};
  out.want(lines.wanted_still);
  const bool takes_part = scatter.any();
  if (takes_part && !lines.wanted_still.empty()) add(scene, false, scatter, output);
  const std::size_t stationary = out.boxes().size();
  out.want(lines.wanted);
  if (takes_part) add(scene, true, scatter, output);
  const auto boxes = out.boxes();
  space.arena.take_ends(out.triangles().size_bytes(), boxes.size_bytes());
  return {{out.first, boxes.last(stationary), boxes.first(boxes.size() - stationary)},
          output.counts,
          {out.touching, out.edge_boxes},
          out.all_stored()};
}

void Tessellator::add(const geometry::Scene& scene, bool moving, const Scatter& scatter, Output& output) {
  for (std::size_t s = 0; s < scene.film().segments().size(); ++s)
    if (moving ? scene.moves(s) : scene.stands(s)) add_segment(scene, s, moving, scatter, output);
}

void Tessellator::add_segment(const geometry::Scene& scene, std::size_t segment, bool moving, const Scatter& scatter,
                              Output& output) {
  const wire::PackedFilm& film = scene.film();
  const std::uint32_t number = film.segments()[segment].shape;
  const wire::Shape& shape = film.shape(number);
  const std::uint32_t first = scene.first_patch(segment);
  const auto from = [&](std::uint64_t place) {
    for (;; ++place) {
      place = scatter.from(first + place) - first;
      if (place >= shape.size() || scene.moves(segment, place) == moving) return place;
    }
  };
  std::uint64_t i = from(0);
  if (i >= shape.size()) return;
  place_.find(scene, segment);
  const Touches touches = Tessellator::touches(scene, output.all_own);
  if (touches == Touches::nothing) return;
  output.own = touches == Touches::perhaps ? output.all_own : nullptr;
  const std::uint32_t material = scene.material(segment);
  raster::PatchIdentity identity{0, material, false, film.materials()[material].sides == 1, moving};
  for (; i < shape.patch_count; i = from(i + 1)) {
    look_now_and_then();
    identity.patch = first + static_cast<std::uint32_t>(i);
    identity.mirrored = place_.mirrors(film, i);
    add_patch(scene, i, identity, output);
  }
  for (const auto meshlets = film.meshlets_of(number); i < shape.size(); i = from(i + 1)) {
    look_now_and_then();
    identity.patch = first + static_cast<std::uint32_t>(i);
    identity.mirrored = place_.mirrors(film, i);
    add_meshlet(scene, meshlets[i - shape.patch_count], identity, output);
  }
}

Tessellator::Touches Tessellator::touches(const geometry::Scene& scene, const OwnLines* own) const {
  if (own == nullptr) return Touches::only;
  const geometry::PictureBounds bounds =
      geometry::picture_box(place_.corners(own->boxes), scene.projection(), size_of(scene));
  if (!meet(bounds, own->lines)) return Touches::nothing;
  const bool inside = own->lines.first <= bounds.lines.first && bounds.lines.last <= own->lines.last;
  return inside ? Touches::only : Touches::perhaps;
}

void Tessellator::add_patch(const geometry::Scene& scene, std::size_t number, const raster::PatchIdentity& identity,
                            Output& output) {
  const shape::EyePatch eye_patch = place_.patch(scene.film(), number);
  const auto width = static_cast<float>(scene.width()), height = static_cast<float>(scene.height());
  if (shape::unseen(eye_patch, scene.projection(), width, height)) return;
  if (output.own != nullptr &&
      !meet(geometry::picture_box(eye_patch.point, 16, scene.projection(), size_of(scene)), output.own->lines))
    return;
  dicer_.dice(eye_patch, scene.projection(), scene.dicing());
  output.add_patch(dicer_, identity, place_.bending(scene.film(), number));
}

void Tessellator::add_meshlet(const geometry::Scene& scene, const wire::Meshlet& meshlet,
                              const raster::PatchIdentity& identity, Output& output) {
  const auto width = static_cast<float>(scene.width()), height = static_cast<float>(scene.height());
  const geometry::BoxCorners corners = place_.corners(scene.film(), meshlet);
  if (shape::unseen(corners.point, geometry::BoxCorners::kCount, scene.projection(), width, height)) return;
  if (output.own != nullptr &&
      !meet(geometry::picture_box(corners, scene.projection(), size_of(scene)), output.own->lines))
    return;
  placer_.place(place_, scene.film(), meshlet, scene.projection());
  output.add_meshlet(placer_, identity, place_.bending(meshlet));
}

}  // namespace mars::node
