#include "tests/render/films.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "host/content/film/shape_writer.h"
#include "host/content/modeler/bspline.h"
#include "host/content/modeler/primitives.h"
#include "host/content/modeler/teapot.h"

namespace mars::test {
namespace {

Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot_product(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3 cross_product(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec3 unit_vector(const Vec3& a) {
  const double length = std::sqrt(dot_product(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

// A flat ball, which one meshlet does not hold, and a smooth one that moves, is squeezed, and is seen from outside
// only.
void add_meshes(FilmMaker& maker, std::uint32_t still_material, std::uint32_t moving_material, std::uint32_t frames) {
  maker.add_segment(maker.add_shape(modeler::cut_meshlets(mesh_ball(9, 0))), still_material,
                    {placed({0.4, -4, 0.2}, 1.7, 0.2)});
  std::vector<wire::Matrix> motion;
  for (std::uint32_t f = 0; f < frames; ++f) {
    motion.push_back(placed({-3.4 + 0.19 * f, -3.6, 0.4 + 0.05 * f}, 2, 0.21 * f));
    for (auto& row : motion.back().m) row[1] *= 0.6;
  }
  maker.add_segment(maker.add_shape(modeler::cut_meshlets(mesh_ball(14, 180))), moving_material, motion);
}

void add_crowd(FilmMaker& maker, bool moving) {
  const std::uint32_t frames = moving ? maker.film.settings.frames : 1;
  const std::uint32_t shapes[] = {
      maker.add_shape(modeler::make_teapot(1.077)), maker.add_shape(modeler::make_sphere()),
      maker.add_shape(modeler::make_torus(0.15)),   maker.add_shape(modeler::make_box()),
      maker.add_shape(modeler::make_cone(0)),       maker.add_shape(modeler::make_cylinder())};
  const std::uint32_t materials[] = {maker.add_material(kClay),
                                     maker.add_material({{0.2f, 0.6f, 0.3f}, 0.2f, 0.7f, 0.1f, 2.5f, 2}),
                                     maker.add_material({{0.3f, 0.4f, 0.9f}, 0.1f, 0.6f, 0.9f, 200, 1})};
  maker.add_segment(shapes[3], materials[1], {placed({-6, -6, -12}, 12)});  // ground: the upper side of a box
  for (std::uint32_t i = 0; i < 9; ++i) {
    const Vec3 place{(i % 3) * 2.2 - 3, (i / 3) * 2.2 - 3, 0.1 * i};
    std::vector<wire::Matrix> motion;
    for (std::uint32_t f = 0; f < (i % 4 == 1 ? frames : 1); ++f)
      motion.push_back(placed({place[0] + 0.21 * f, place[1] + 0.07 * f, place[2]}, 2.4, 0.3 * i + 0.17 * f));
    maker.add_segment(shapes[i % 6], materials[i % 3], motion);
  }
  add_meshes(maker, materials[0], materials[2], frames);
}

void add_lights(FilmMaker& maker) {
  const double l = std::sqrt(0.4 * 0.4 + 0.7 * 0.7 + 0.8 * 0.8);
  maker.add_light({wire::LightKind::directional,
                   {static_cast<float>(-0.4 / l), static_cast<float>(-0.7 / l), static_cast<float>(0.8 / l)},
                   {1, 1, 1}});
  maker.add_light({wire::LightKind::point, {3, -2, 5}, {0.3f, 0.3f, 0.5f}});
}

}  // namespace

wire::Matrix placed(const Vec3& place, double size, double angle) {
  const double c = std::cos(angle) * size, s = std::sin(angle) * size;
  return {{{{c, -s, 0, place[0]}, {s, c, 0, place[1]}, {0, 0, size, place[2]}}}};
}

wire::Camera looking(const Vec3& eye, const Vec3& at, double fov, double near, double far) {
  const Vec3 z = unit_vector(minus(eye, at)), x = unit_vector(cross_product({0, 0, 1}, z)), y = cross_product(z, x);
  wire::Camera camera{{}, 1 / std::tan(fov * std::numbers::pi / 360), near, far};
  const Vec3 axes[] = {x, y, z};
  for (std::size_t r = 0; r < 3; ++r)
    camera.world_to_eye.m[r] = {axes[r][0], axes[r][1], axes[r][2], -dot_product(axes[r], eye)};
  return camera;
}

modeler::Mesh mesh_ball(std::uint32_t rows, double crease) {
  modeler::Mesh mesh;
  mesh.crease = crease;
  const std::uint32_t around = 2 * rows;
  const auto add = [&](double polar, double turn) {
    const double out = 0.5 * std::sin(polar);
    mesh.vertices.push_back({static_cast<float>(0.5 + out * std::cos(turn)),
                             static_cast<float>(0.5 + out * std::sin(turn)),
                             static_cast<float>(0.5 - 0.5 * std::cos(polar))});
  };
  for (std::uint32_t row = 0; row <= rows; ++row)
    for (std::uint32_t k = 0; k < around; ++k)
      add(std::numbers::pi * (row + 1) / (rows + 2), 2 * std::numbers::pi * k / around);
  add(0, 0);
  add(std::numbers::pi, 0);
  const auto face = [&](std::initializer_list<std::uint32_t> corners) {
    mesh.corners.insert(mesh.corners.end(), corners);
    mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  };
  const std::uint32_t bottom = (rows + 1) * around, last = rows * around;
  for (std::uint32_t k = 0; k < around; ++k) {
    const std::uint32_t next = (k + 1) % around;
    for (std::uint32_t row = 0; row < last; row += around)
      face({row + k, row + next, row + around + next, row + around + k});
    face({bottom, next, k});
    face({bottom + 1, last + k, last + next});
  }
  return mesh;
}

modeler::Mesh tube(std::uint32_t rows, std::uint32_t bones) {
  constexpr std::uint32_t kAround = 12;
  modeler::Mesh mesh;
  mesh.crease = 60;
  for (std::uint32_t row = 0; row <= rows; ++row) {
    const double z = double(row) / rows;
    std::vector<modeler::BoneWeight> follows;
    for (std::uint32_t bone = 0; bone < bones; ++bone) {
      const double away = std::abs(z * bones - (bone + 0.5));
      if (away < 2) follows.push_back({bone, (2 - away) * (2 - away)});
    }
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAround;
      mesh.vertices.push_back({float(0.5 + 0.45 * std::cos(angle)), float(0.5 + 0.45 * std::sin(angle)), float(z)});
      mesh.bones.push_back(*modeler::bones_of_vertex(follows));
    }
  }
  const auto face = [&](const std::vector<std::uint32_t>& corners) {
    mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
    mesh.ends.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  };
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t k = 0; k < kAround; ++k) {
    bottom.insert(bottom.begin(), k);
    top.push_back(rows * kAround + k);
    const std::uint32_t next = (k + 1) % kAround;
    for (std::uint32_t row = 0; row < rows * kAround; row += kAround)
      face({row + k, row + next, row + kAround + next, row + kAround + k});
  }
  face(bottom);
  face(top);
  return mesh;
}

FilmMaker::FilmMaker(std::uint32_t width, std::uint32_t height, std::uint32_t frames) {
  film.settings = {width, height, frames, 0, kMagenta, 24, {}};
  film.names = {'b', 'o', 'd', 'y', '\0'};
}

std::uint32_t FilmMaker::add_shape(const std::vector<wire::Patch>& patches) {
  film.shapes.push_back({static_cast<std::uint32_t>(film.patches.size()), static_cast<std::uint32_t>(patches.size())});
  film.patches.insert(film.patches.end(), patches.begin(), patches.end());
  return static_cast<std::uint32_t>(film.shapes.size() - 1);
}

std::uint32_t FilmMaker::add_shape(const modeler::Meshlets& mesh) {
  const auto append = [](auto& items, const auto& more) { items.insert(items.end(), more.begin(), more.end()); };
  const auto first = static_cast<std::uint32_t>(film.meshlets.size());
  for (wire::Meshlet meshlet : mesh.meshlets) {
    meshlet.first_vertex += static_cast<std::uint32_t>(film.mesh_places.size());
    meshlet.first_triangle += static_cast<std::uint32_t>(film.mesh_triangles.size());
    meshlet.skin.first_bone += static_cast<std::uint32_t>(film.skin_bones.size());
    meshlet.skin.first_weight += static_cast<std::uint32_t>(film.skin_weights.size());
    film.meshlets.push_back(meshlet);
  }
  append(film.mesh_places, mesh.places);
  append(film.mesh_normals, mesh.normals);
  append(film.mesh_triangles, mesh.triangles);
  append(film.skin_bones, mesh.skins.bones);
  append(film.skin_weights, mesh.skins.weights);
  film.shapes.push_back({0, 0, first, static_cast<std::uint32_t>(mesh.meshlets.size()),
                         mesh.skins.bones.empty() ? 0 : *std::ranges::max_element(mesh.skins.bones) + 1});
  return static_cast<std::uint32_t>(film.shapes.size() - 1);
}

std::uint32_t FilmMaker::add_shape(const modeler::Shape& skin) { return film::ShapeWriter(film).add(skin); }

std::uint32_t FilmMaker::add_material(const wire::Material& material) {
  film.materials.push_back(material);
  return static_cast<std::uint32_t>(film.materials.size() - 1);
}

wire::Track FilmMaker::still(std::uint32_t value) {
  film.changes.push_back({0, value});
  return {static_cast<std::uint32_t>(film.changes.size() - 1), 1};
}

void FilmMaker::add_segment(std::uint32_t shape, std::uint32_t material, const std::vector<wire::Matrix>& motion) {
  const wire::Track track = track_of(motion);
  film.segments.push_back({shape, 0, track, still(material)});
}

void FilmMaker::add_skin(std::uint32_t shape, std::uint32_t material,
                         const std::vector<std::vector<wire::Matrix>>& bones) {
  add_segment(shape, material, {bones[0][0]});
  film.segments.back().first_bone = static_cast<std::uint32_t>(film.bones.size());
  film.segments.back().bone_count = static_cast<std::uint32_t>(bones.size());
  for (const auto& motion : bones) film.bones.push_back(track_of(motion));
}

wire::Track FilmMaker::track_of(const std::vector<wire::Matrix>& motion) {
  wire::Track track{static_cast<std::uint32_t>(film.changes.size()), 0};
  for (std::uint32_t f = 0; f < motion.size(); ++f) {
    if (f > 0 && motion[f] == motion[f - 1]) continue;
    film.changes.push_back({f, static_cast<std::uint32_t>(film.matrices.size())});
    film.matrices.push_back(motion[f]);
    ++track.count;
  }
  return track;
}

void FilmMaker::add_light(const wire::Light& light) {
  film.lights.push_back(light);
  film.light_tracks.push_back(still(static_cast<std::uint32_t>(film.lights.size() - 1)));
}

void FilmMaker::set_cameras(const std::vector<wire::Camera>& cameras) {
  camera_moves_ = cameras.size() > 1;
  film.settings.camera = {static_cast<std::uint32_t>(film.changes.size()), static_cast<std::uint32_t>(cameras.size())};
  for (std::uint32_t f = 0; f < cameras.size(); ++f) film.changes.push_back({f, f});
  film.cameras = cameras;
}

bool FilmMaker::changes(const wire::Track& track, std::uint32_t first, std::uint32_t end) const {
  return std::any_of(film.changes.begin() + track.first, film.changes.begin() + track.first + track.count,
                     [&](const wire::Change& c) { return c.frame > first && c.frame < end; });
}

bool FilmMaker::moves(std::uint32_t segment, std::uint32_t first, std::uint32_t end) const {
  const wire::Segment& of = film.segments[segment];
  const auto bones = film.bones.begin() + of.first_bone;
  return of.bone_count == 0 ? changes(of.motion, first, end)
                            : std::any_of(bones, bones + of.bone_count,
                                          [&](const wire::Track& bone) { return changes(bone, first, end); });
}

wire::FilmData FilmMaker::make(std::uint32_t length) {
  if (camera_moves_) length = 1;
  for (std::uint32_t first = 0; first < film.settings.frames; first += length) {
    const std::uint32_t end = std::min(first + length, film.settings.frames);
    wire::Interval interval{first, end - first, static_cast<std::uint32_t>(film.moving.size()), 0};
    for (std::uint32_t s = 0; s < film.segments.size(); ++s)
      if (camera_moves_ || moves(s, first, end)) film.moving.push_back(s);
    for (std::uint32_t bone = 0; bone < film.bones.size(); ++bone)
      if (camera_moves_ || changes(film.bones[bone], first, end))
        film.moving.push_back(static_cast<std::uint32_t>(film.segments.size()) + bone);
    interval.moving_count = static_cast<std::uint32_t>(film.moving.size()) - interval.first_moving;
    film.intervals.push_back(interval);
  }
  return film;
}

wire::FilmData crowd(std::uint32_t width, std::uint32_t height, std::uint32_t frames, std::uint32_t interval) {
  FilmMaker maker(width, height, frames);
  add_crowd(maker, true);
  add_lights(maker);
  maker.set_cameras({looking({1, -11, 7}, {0, 0, 0}, 40)});
  return maker.make(interval);
}

wire::FilmData flight(std::uint32_t width, std::uint32_t height, std::uint32_t frames) {
  FilmMaker maker(width, height, frames);
  add_crowd(maker, false);
  add_lights(maker);
  std::vector<wire::Camera> cameras;
  for (std::uint32_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / frames;
    cameras.push_back(looking({1 - t, 6 * t - 6, 3 - 2 * t}, {0.1, 6 * t, 0.5}, 70));
  }
  maker.set_cameras(cameras);
  return maker.make();
}

wire::FilmData ties(std::uint32_t width, std::uint32_t height) {
  FilmMaker maker(width, height, 3);
  const std::uint32_t box = maker.add_shape(modeler::make_box());
  const std::uint32_t materials[] = {maker.add_material(kClay), maker.add_material({{0, 0.7f, 0}, 0.3f, 0.6f, 0, 1, 2}),
                                     maker.add_material({{0, 0, 0.9f}, 0.3f, 0.6f, 0, 1, 2})};
  const wire::Matrix here = placed({-0.5, -0.5, -0.5}, 1, 0.4), apart = placed({0.2, -0.5, -0.5}, 1, 0.4);
  maker.add_segment(box, materials[0], {apart, here, here});
  maker.add_segment(box, materials[1], {here});
  maker.add_segment(box, materials[2], {apart, apart, here});
  maker.add_segment(box, materials[0], {here});
  add_lights(maker);
  maker.set_cameras({looking({1, -3, 1.6}, {0, 0, 0}, 40)});
  return maker.make();
}

wire::FilmData overhead(std::uint32_t width, std::uint32_t height, std::uint32_t frames, std::uint32_t interval) {
  FilmMaker maker(width, height, frames);
  const std::uint32_t box = maker.add_shape(modeler::make_box()), ball = maker.add_shape(modeler::make_sphere());
  const std::uint32_t clay = maker.add_material(kClay),
                      green = maker.add_material({{0.2f, 0.6f, 0.3f}, 0.2f, 0.7f, 0, 1, 2});
  maker.add_segment(box, clay, {placed({-8, -8, -16}, 16)});
  maker.add_segment(box, green, {placed({0.5, -1, 0}, 1.5, 0.4)});
  maker.add_segment(ball, clay, {placed({-3, 0.5, 0}, 1.7)});
  for (const double y : {-0.6, 1.5}) {
    std::vector<wire::Matrix> motion;
    for (std::uint32_t f = 0; f < frames; ++f) motion.push_back(placed({4.0 * f / frames - 2.5 + y, y, 9}, 1.2));
    maker.add_segment(ball, green, motion);
  }
  maker.add_light({wire::LightKind::directional, {-0.28f, 0, 0.96f}, {0.8f, 0.8f, 0.8f}});
  maker.add_light({wire::LightKind::point, {0, -1, 20}, {0.7f, 0.7f, 0.9f}});
  maker.set_cameras({looking({0, -14, 6}, {0, 0, 0}, 30)});
  return maker.make(interval);
}

namespace {

// A tube of a length at a place, of bones of which the lowest ones stand upright.
struct Tube {
  Vec3 place;
  double length;
  std::uint32_t bones, standing = 1;
};

// The bones, of which each above the standing ones is turned against the one below by an angle about y.
std::vector<wire::Matrix> bent(const Tube& tube, double angle) {
  const auto& [place, length, bones, standing] = tube;
  std::vector<wire::Matrix> matrices;
  const double part = length / bones, width = length / 4;
  double x = place[0], z = place[2];
  for (std::uint32_t bone = 0; bone < bones; ++bone) {
    const double turn = (bone + 1 - std::min(bone + 1, standing)) * angle, c = std::cos(turn), s = std::sin(turn);
    // The unit cube's part of the bone begins at (x, z), upright in its own axes.
    const double dx = -0.5 * width, dz = -part * bone;
    matrices.push_back({{{{c * width, 0, s * length, x + c * dx + s * dz},
                          {0, width, 0, place[1] - 0.5 * width},
                          {-s * width, 0, c * length, z - s * dx + c * dz}}}});
    x += s * part, z += c * part;
  }
  return matrices;
}

// The bones' motions, by an angle at each frame.
std::vector<std::vector<wire::Matrix>> bends(const Tube& tube, const std::vector<double>& angles) {
  std::vector<std::vector<wire::Matrix>> motions(tube.bones);
  for (const double angle : angles) {
    const std::vector<wire::Matrix> now = bent(tube, angle);
    for (std::uint32_t bone = 0; bone < tube.bones; ++bone) motions[bone].push_back(now[bone]);
  }
  return motions;
}

}  // namespace

namespace {

// A tube of patches, open at its ends, along z.
modeler::Shape patch_tube(std::uint32_t rows, std::uint32_t bones) {
  constexpr std::uint32_t kAround = 6;
  std::vector<glm::dvec3> points;
  std::vector<modeler::VertexBones> follows;
  for (std::uint32_t row = 0; row < rows; ++row) {
    const double z = double(row) / (rows - 1);
    std::vector<modeler::BoneWeight> weights;
    for (std::uint32_t bone = 0; bone < bones; ++bone)
      if (const double away = std::abs(z * bones - (bone + 0.5)); away < 1.2) weights.push_back({bone, 1.2 - away});
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAround;
      points.emplace_back(0.5 + 0.45 * std::cos(angle), 0.5 + 0.45 * std::sin(angle), z);
    }
    follows.insert(follows.end(), kAround, *modeler::bones_of_vertex(weights));
  }
  const auto u = modeler::uniform_direction(modeler::Ends::periodic, 3, kAround);
  const auto v = modeler::uniform_direction(modeler::Ends::clamped, 3, rows);
  const modeler::MeanPatches means = modeler::bezier_means(kAround, rows, u, v);
  return {"tube", modeler::patches_of(means, points), {}, modeler::control_net(means, points, follows, kAround)};
}

// Tubes repeat their motion in long films, also for each of three nodes that take turns at intervals of three frames.
constexpr std::uint32_t kFramesOfABend = 36;

}  // namespace

wire::FilmData bending(std::uint32_t width, std::uint32_t height, std::uint32_t frames, std::uint32_t interval,
                       wire::Blend blend) {
  FilmMaker maker(width, height, frames);
  const std::uint32_t clay = maker.add_material(kClay),
                      blue = maker.add_material({{0.3f, 0.4f, 0.9f}, 0.1f, 0.6f, 0.9f, 200, 1});
  const std::uint32_t box = maker.add_shape(modeler::make_box()), ball = maker.add_shape(modeler::make_sphere());
  maker.add_segment(box, clay, {placed({-8, -8, -16}, 16)});
  maker.add_segment(ball, blue, {placed({-0.6, -0.6, 0}, 1.2)});
  std::vector<double> angles;
  for (std::uint32_t f = 0; f < frames; ++f) angles.push_back(0.1 + 0.11 * (f % kFramesOfABend));
  const std::uint32_t shapes[] = {maker.add_shape(modeler::cut_meshlets(tube(24, 6))),
                                  maker.add_shape(modeler::cut_meshlets(tube(60, 24)))};
  maker.add_skin(shapes[0], clay, bends({{-2.5, -1.5, 0}, 4, 6}, angles));
  maker.add_skin(shapes[0], blue, bends({{1.2, 1.5, 0}, 3, 6}, {-0.2}));
  for (double& angle : angles) angle = 0.02 - 0.2 * angle;
  maker.add_skin(shapes[1], blue, bends({{2, -2, 0}, 4.5, 24, 18}, angles));
  for (double& angle : angles) angle *= 3;
  maker.add_skin(maker.add_shape(patch_tube(9, 5)), clay, bends({{-0.3, -2.8, 0}, 3, 5, 3}, angles));
  for (wire::Segment& segment : maker.film.segments)
    if (segment.bone_count > 0) segment.blend = blend;
  maker.add_light({wire::LightKind::directional, {-0.28f, 0, 0.96f}, {0.8f, 0.8f, 0.8f}});
  maker.add_light({wire::LightKind::point, {0, -4, 6}, {0.5f, 0.5f, 0.6f}});
  maker.film.lights[0].casts = 1;
  maker.set_cameras({looking({0, -12, 5}, {0, 0, 1.2}, 32)});
  return maker.make(interval);
}

wire::FilmData corner(std::uint32_t width, std::uint32_t height, std::uint32_t frames) {
  FilmMaker maker(width, height, frames);
  const std::uint32_t box = maker.add_shape(modeler::make_box()), ball = maker.add_shape(modeler::make_sphere());
  const std::uint32_t clay = maker.add_material(kClay);
  maker.add_segment(box, clay, {{{{{24, 0, 0, -12}, {0, 24, 0, -12}, {0, 0, 0.2, -0.2}}}}});
  std::vector<wire::Matrix> motion;
  for (std::uint32_t f = 0; f < frames; ++f) motion.push_back(placed({0.1 * f - 2.5, 1, 0}, 0.4));
  maker.add_segment(ball, clay, motion);
  maker.add_light({wire::LightKind::directional, {-0.6f, 0, 0.8f}, {1, 1, 1}});
  maker.set_cameras({looking({0, -10, 10}, {0, 0, 0}, 25)});
  return maker.make();
}

wire::FilmData nothing(std::uint32_t width, std::uint32_t height, std::uint32_t frames) {
  FilmMaker maker(width, height, frames);
  maker.set_cameras({looking({1, -3, 1.6}, {0, 0, 0}, 40)});
  return maker.make();
}

}  // namespace mars::test
