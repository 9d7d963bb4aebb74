#include "host/content/film/unpacked.h"

#include <algorithm>
#include <vector>

namespace mars::film {
namespace {

template <typename T>
std::vector<T> copy_of(std::span<const T> items) {
  return {items.begin(), items.end()};
}

}  // namespace

wire::FilmData unpacked(const wire::PackedFilm& film) {
  wire::FilmData data;
  data.settings = film.settings();
  data.patches = copy_of(film.patches());
  data.mesh_places = copy_of(film.mesh_places());
  data.mesh_normals = copy_of(film.mesh_normals());
  data.mesh_triangles = copy_of(film.mesh_triangles());
  data.net_points = copy_of(film.net_points());
  data.stencil_terms = copy_of(film.stencil_terms());
  data.stencils = copy_of(film.stencils());
  data.net_patches = copy_of(film.net_patches());
  data.skin_bones = copy_of(film.skin_bones());
  data.skin_weights = copy_of(film.skin_weights());
  data.meshlets = copy_of(film.meshlets());
  data.shapes = copy_of(film.shapes());
  data.segments = copy_of(film.segments());
  data.bones = copy_of(film.bones());
  data.materials = copy_of(film.materials());
  data.cameras = copy_of(film.cameras());
  data.lights = copy_of(film.lights());
  data.light_tracks = copy_of(film.light_tracks());
  data.names = copy_of(film.names());
  return data;
}

CompiledFilm packed(const wire::FilmData& data, std::span<const wire::Matrix> matrices, const CompiledFilm& like) {
  CompiledFilm film;
  wire::pack_around(data, matrices.size(), [&](std::size_t bytes) {
    film.lines.resize(bytes / sizeof(CompiledFilm::Line));
    return reinterpret_cast<std::byte*>(film.lines.data());
  });
  std::ranges::copy(std::as_bytes(matrices), reinterpret_cast<std::byte*>(film.lines.data()) + wire::kMatricesOffset);
  film.source = like.source;
  film.actors = like.actors;
  film.joints = like.joints;
  return film;
}

}  // namespace mars::film
