#include "node/canvas.h"

#include <cstddef>

namespace mars::node {

Canvas::Canvas(const wire::PackedFilm& film, const raster::Neighbours& neighbours, const Memory& memory,
               simd::InstructionSet set, bool has_layers)
    : scene(film),
      z_buffer(set, film.settings().width, scene.pattern(), scene.projection().nothing),
      still(neighbours, film.settings().width, film.settings().height, scene.pattern(), memory.still,
            film.casting_count(), scene.projection().nothing, has_layers),
      sums(film.settings().height),
      triangle_exchange(static_cast<std::size_t>(neighbours.group().count), film.settings().height),
      still_exchange(neighbours, still),
      team_lines(film.settings().height, static_cast<std::size_t>(neighbours.group().count)),
      contributes(static_cast<std::size_t>(neighbours.group().count)),
      line_loads(film.settings().height),
      other_loads(film.settings().height),
      line_totals(film.settings().height + 1),
      awaited(film.settings().height),
      still_bytes(film.settings().height),
      wanted_lines(film.settings().height),
      wanted_still_lines(film.settings().height) {
  if (has_layers) surfaces.emplace(scene);
  if (scene.casting_count() > 0)
    shadows.emplace(set, scene, shadow::plan_shadows(shadow::shadow_needs(film, has_layers), memory.shadows),
                    has_layers);
}

}  // namespace mars::node
