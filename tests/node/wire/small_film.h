// A film for tests of the compiled form, with at least one of everything.
#pragma once

#include <string>

#include "node/wire/film.h"

namespace mars::wire {

inline Patch flat_patch() {
  Patch patch;
  for (std::size_t k = 0; k < 16; ++k)
    patch.points[k] = {static_cast<float>(k % 4) / 3, static_cast<float>(k / 4) / 3, 0.5f};
  return patch;
}

inline Matrix moved(double x) { return {{{{1, 0, 0, x}, {0, 1, 0, 0}, {0, 0, 1, 0}}}}; }

// Three frames, three segments of which the second, partly a mesh, and the third, a mesh with a skin of two bones,
// move, one light that changes. The third also has a patch that follows both bones.
inline FilmData small_film() {
  FilmData film;
  film.settings = {64, 48, 3, 0, {0.1f, 0.2f, 0.3f}, 24, {0, 1}};
  film.patches.assign(3, flat_patch());
  film.mesh_places = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  film.mesh_normals.assign(7, {0, 0, 1});
  film.mesh_triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}};
  film.skin_bones = {0, 1, 0, 1};  // of points, of a net's patch
  film.skin_weights = {1, 0.5f, 0, 0, 0.5f, 1};
  film.meshlets = {{0, 4, 0, 2, {0, 0, 0}, {1, 1, 0.5f}},
                   {4, 3, 2, 1, {0, 0, 0}, {1, 0, 1}},
                   {4, 3, 2, 1, {0, 0, 0}, {1, 0, 1}, {0, 2, 0}}};
  film.net_points = {{{0, 0, 0}, {0, 1, 0}}, {{1, 1, 1}, {0, 2, 6}}};
  film.skin_weights.insert(film.skin_weights.end(), 2, 0.5f);
  film.stencil_terms = {{0, 0.25f}, {1, 0.75f}, {1, 1}};
  film.stencils = {{0, 2}, {2, 1}};
  film.net_patches = {{{}, 2, 2}};
  film.net_patches[0].stencils[5] = 1;
  film.shapes = {{0, 2, 0, 0}, {2, 1, 0, 2}, {1, 1, 2, 1, 2, 0}};
  film.segments = {{0, 0, {0, 1}, {0, 1}}, {1, 5, {1, 3}, {0, 1}}, {2, 5, {0, 1}, {0, 1}, 0, 0, 2}};
  film.bones = {{0, 1}, {1, 3}};
  film.materials = {{{1, 0, 0}, 0.1f, 0.6f, 0.3f, 20, 2}, {{0, 1, 0}, 0.1f, 0.6f, 0.3f, 2.5f, 1}};
  film.matrices = {moved(0), moved(1), moved(2)};
  film.cameras = {{moved(0), 2, 0.1, 100}};
  film.lights = {{wire::LightKind::directional, {0, 0, 1}, {1, 1, 1}}, {wire::LightKind::point, {1, 2, 3}, {1, 1, 1}}};
  film.light_tracks = {{0, 1}, {4, 2}};
  film.changes = {{0, 0}, {0, 0}, {1, 1}, {2, 2}, {0, 0}, {2, 1}};
  film.intervals = {{0, 2, 0, 2}, {2, 1, 2, 3}};
  film.moving = {1, 2, 0, 1, 2};
  const std::string names("base\0arm\0", 9);
  film.names.assign(names.begin(), names.end());
  return film;
}

// A moment of it: the second segment, which moves, has a shape of its own of two patches; a third stands still.
inline FilmData small_scene() {
  FilmData scene = small_film();
  scene.settings.frames = 1;
  scene.patches.assign(4, flat_patch());
  scene.mesh_places.clear(), scene.mesh_normals.clear(), scene.mesh_triangles.clear(), scene.meshlets.clear();
  scene.net_points.clear(), scene.stencil_terms.clear(), scene.stencils.clear(), scene.net_patches.clear();
  scene.skin_bones.clear(), scene.skin_weights.clear();
  scene.shapes = {{0, 2}, {2, 2}};
  scene.segments = {{0, 0, {0, 1}, {0, 1}}, {3, 5, {6, 1}, {0, 1}}, {4, 0, {0, 1}, {0, 1}}};
  scene.changes.push_back({0, 1});
  scene.intervals = {{0, 1, 0, 1}};
  scene.moving = {1};
  return scene;
}

}  // namespace mars::wire
