// Makes a film's crowd for the peers: bench-crowd FILM CROWD. All segments of the film have one mesh with a skin.
#include <cmath>
#include <iostream>

#include "hal/failure/explain.h"
#include "hal/failure/failure.h"
#include "host/content/film/compile.h"
#include "tests/bench/peers/film_head.h"
#include "tests/bench/peers/crowd.h"

namespace mars::bench {
namespace {

using Scale = std::array<double, 3>;

void check_crowd(const wire::PackedFilm& film, const std::string& where) {
  check_look(film, where);
  if (film.materials().size() != 1) refuse("several materials", where);
  if (film.settings().camera.count != 1) refuse("a camera that moves", where);
  if (film.shapes().size() != 1 || film.shapes()[0].patch_count > 0 || film.shapes()[0].bone_count == 0)
    refuse("other shapes than one mesh with a skin", where);
}

// What a bone does to the unit cube's sides; it must be the same of all.
Scale scale_of(const wire::Matrix& bone) {
  Scale scale{};
  for (std::size_t c = 0; c < 3; ++c)
    scale[c] = std::sqrt(bone.m[0][c] * bone.m[0][c] + bone.m[1][c] * bone.m[1][c] + bone.m[2][c] * bone.m[2][c]);
  return scale;
}

Motion to_eye(const wire::Matrix& eye, const wire::Matrix& bone, const Scale& scale, const std::string& where) {
  Motion out{};
  const Scale own = scale_of(bone);
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(own[c] - scale[c]) > 1e-9 * scale[c]) refuse("bones that scale", where);
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c) {
      double sum = c == 3 ? eye.m[r][3] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += eye.m[r][k] * bone.m[k][c];
      out[r][c] = static_cast<float>(c < 3 ? sum / scale[c] : sum);
    }
  return out;
}

void add_meshlet(const wire::PackedFilm& film, const wire::Meshlet& meshlet, const Scale& scale, Crowd& crowd) {
  const auto first = static_cast<std::uint32_t>(crowd.vertices.size());
  const auto bones = film.bones_of(meshlet.skin);
  const auto weights = film.weights_of(meshlet.skin, meshlet.vertex_count);
  for (std::uint32_t v = 0; v < meshlet.vertex_count; ++v) {
    SkinVertex vertex{};
    double length = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double normal = film.mesh_normals()[meshlet.first_vertex + v][a] / scale[a];
      vertex.place[a] = static_cast<float>(film.mesh_places()[meshlet.first_vertex + v][a] * scale[a]);
      vertex.normal[a] = static_cast<float>(normal);
      length += normal * normal;
    }
    for (float& part : vertex.normal) part = static_cast<float>(part / std::sqrt(length));
    std::size_t count = 0;
    for (std::size_t bone = 0; bone < bones.size(); ++bone)
      if (const float weight = weights[bone * meshlet.vertex_count + v]; weight > 0) {
        vertex.bone[count] = bones[bone];
        vertex.weight[count++] = weight;
      }
    crowd.vertices.push_back(vertex);
  }
  for (const wire::MeshTriangle& t : film.mesh_triangles().subspan(meshlet.first_triangle, meshlet.triangle_count))
    crowd.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

Crowd crowd_of(const wire::PackedFilm& film, const std::string& where) {
  check_crowd(film, where);
  geometry::Scene scene(film);
  scene.set_interval(0);
  scene.set_frame(0);
  Crowd crowd{};
  crowd.look = film.materials()[0].color;
  const Scale scale = scale_of(film.matrix_at(film.bones()[0], 0));
  for (const wire::Meshlet& meshlet : film.meshlets()) add_meshlet(film, meshlet, scale, crowd);
  const wire::Matrix& eye = film.camera_at(0).world_to_eye;
  for (std::uint32_t frame = 0; frame < film.settings().frames; ++frame)
    for (const wire::Segment& segment : film.segments())
      for (const wire::Track& bone : film.bones_of(segment))
        crowd.bones.push_back(to_eye(eye, film.matrix_at(bone, frame), scale, where));
  crowd.head = {head_of(scene), film.segments()[0].bone_count};
  crowd.head.mesh.patches = static_cast<std::uint32_t>(film.segments().size());
  crowd.head.mesh.vertices = static_cast<std::uint32_t>(crowd.vertices.size());
  crowd.head.mesh.triangles = static_cast<std::uint32_t>(crowd.triangles.size());
  return crowd;
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: bench-crowd FILM CROWD\n";
    return 2;
  }
  try {
    const mars::film::CompiledFilm film = mars::film::load_film(argv[1]);
    mars::bench::write_crowd(mars::bench::crowd_of(film.view(), argv[1]), argv[2]);
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "bench-crowd: " << mars::reason_of(failure) << '\n';
    return 1;
  }
}
