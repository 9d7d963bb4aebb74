// Makes a film's mesh for the peers: bench-mesh FILM MESH. The triangles are those that MARS itself draws.
#include <cmath>
#include <iostream>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/content/film/compile.h"
#include "node/shape/dice.h"
#include "node/geometry/scene.h"
#include "node/simd/instruction_set.h"
#include "tests/bench/peers/film_head.h"

namespace mars::bench {
namespace {

void check_plain(const wire::PackedFilm& film, const std::string& where) {
  check_look(film, where);
  if (!film.bones().empty()) refuse("skins", where);
  if (film.settings().dice == 0) refuse("adaptive dicing", where);
  if (film.settings().camera.count != 1) refuse("a camera that moves", where);
  if (film.intervals().size() > 1) refuse("several render intervals", where);
  if (film.moving_segments(film.intervals()[0]).size() > 1) refuse("several moving segments", where);
}

void add_patch(const shape::Dicer& diced, MeshPatch part, Mesh& mesh) {
  part.first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
  part.first_triangle = static_cast<std::uint32_t>(mesh.triangles.size());
  part.vertices = static_cast<std::uint32_t>(diced.vertex_count());
  part.triangles = diced.triangles().count;
  const shape::Vertices& v = diced.vertices();
  for (std::uint32_t k = 0; k < part.vertices; ++k)
    mesh.vertices.push_back(
        {{v.place[0][k], v.place[1][k], v.place[2][k]}, {v.normal[0][k], v.normal[1][k], v.normal[2][k]}});
  const std::uint32_t first = part.first_vertex;
  for (std::uint32_t k = 0; k < part.triangles; ++k) {
    const shape::Corner3 t = diced.triangles()[k];
    mesh.triangles.push_back({first + t.a, first + t.b, first + t.c});
  }
  mesh.patches.push_back(part);
}

void add_segments(const geometry::Scene& scene, bool moving, Mesh& mesh) {
  const wire::PackedFilm& film = scene.film();
  shape::Dicer dicer(simd::best_instruction_set(""));
  for (std::uint32_t s = 0; s < film.segments().size(); ++s) {
    if (scene.moves(s) != moving) continue;
    const shape::EyeMatrix matrix = scene.matrix(s);
    if (shape::mirrors(matrix)) refuse("a mirrored segment", std::string(film.name(film.segments()[s])));
    const wire::Shape& shape = film.shapes()[film.segments()[s].shape];
    for (const wire::Patch& patch : film.patches().subspan(shape.first_patch, shape.patch_count)) {
      dicer.dice(shape::to_eye(matrix, patch), scene.projection(), scene.dicing());
      add_patch(dicer, {s, scene.material(s), moving ? 1u : 0u, 0, 0, 0, 0}, mesh);
    }
  }
}

using Square = std::array<std::array<double, 4>, 3>;

Square times(const Square& a, const Square& b) {
  Square out{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c) {
      out[r][c] = c == 3 ? a[r][3] : 0;
      for (std::size_t k = 0; k < 3; ++k) out[r][c] += a[r][k] * b[k][c];
    }
  return out;
}

Square inverse(const Square& a) {
  Square out{};
  const auto at = [&](std::size_t r, std::size_t c) { return a[r % 3][c % 3]; };
  double determinant = 0;
  for (std::size_t c = 0; c < 3; ++c)
    determinant += a[0][c] * (at(1, c + 1) * at(2, c + 2) - at(1, c + 2) * at(2, c + 1));
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      out[r][c] = (at(c + 1, r + 1) * at(c + 2, r + 2) - at(c + 1, r + 2) * at(c + 2, r + 1)) / determinant;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) out[r][3] -= out[r][c] * a[c][3];
  return out;
}

bool is_rigid(const Square& m) {
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) {
      double dot = 0;
      for (std::size_t r = 0; r < 3; ++r) dot += m[r][a] * m[r][b];
      if (std::abs(dot - (a == b ? 1 : 0)) > 1e-9) return false;
    }
  return true;
}

std::vector<Motion> motion_of(const wire::PackedFilm& film) {
  std::vector<Motion> motion(film.settings().frames, kStill);
  const auto movers = film.moving(film.intervals()[0]);
  if (movers.empty()) return motion;
  const wire::Segment& mover = film.segments()[movers[0]];
  const Square eye = film.camera_at(0).world_to_eye.m;
  const Square back = inverse(times(eye, film.matrix_at(mover, 0).m));
  for (std::uint32_t frame = 0; frame < motion.size(); ++frame) {
    const Square m = times(times(eye, film.matrix_at(mover, frame).m), back);
    if (!is_rigid(m)) refuse("a segment that changes its shape", std::string(film.name(mover)));
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c) motion[frame][r][c] = static_cast<float>(m[r][c]);
  }
  return motion;
}

Mesh mesh_of(const wire::PackedFilm& film, const std::string& where) {
  check_plain(film, where);
  geometry::Scene scene(film);
  scene.set_interval(0);
  scene.set_frame(0);
  Mesh mesh{};
  mesh.head = head_of(scene);
  for (const wire::Material& m : film.materials()) mesh.looks.push_back(m.color);
  for (const bool moving : {false, true}) add_segments(scene, moving, mesh);
  mesh.motion = motion_of(film);
  mesh.head.looks = static_cast<std::uint32_t>(mesh.looks.size());
  mesh.head.patches = static_cast<std::uint32_t>(mesh.patches.size());
  mesh.head.vertices = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.head.triangles = static_cast<std::uint32_t>(mesh.triangles.size());
  return mesh;
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: bench-mesh FILM MESH\n";
    return 2;
  }
  try {
    const mars::film::CompiledFilm film = mars::film::load_film(argv[1]);
    mars::bench::write_mesh(mars::bench::mesh_of(film.view(), argv[1]), argv[2]);
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "bench-mesh: " << mars::reason_of(failure) << '\n';
    return 1;
  }
}
