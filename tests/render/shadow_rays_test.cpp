// Each pair of random scenes against a ray tracer that shares with the nodes the triangles, the points of lights, and
// nothing of their grids.
#include "tests/render/shadow_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>

#include "host/content/modeler/primitives.h"
#include "host/content/modeler/teapot.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

using shape::operator-;
using shape::Random;

Vec3 random_place(Random& random, double across, double low, double high) {
  return {random.real(-across, across), random.real(-across, across), random.real(low, high)};
}

std::array<float, 3> unit(const Vec3& a) {
  const double l = shape::length(a);
  return {static_cast<float>(a[0] / l), static_cast<float>(a[1] / l), static_cast<float>(a[2] / l)};
}

wire::Light random_light(Random& random, wire::LightKind kind, bool has_size) {
  wire::Light light{kind, {}, {1, 1, 1}};
  light.casts = 1;
  if (kind == wire::LightKind::directional) {
    light.vector = unit(random_place(random, 1, 0.1, 1));
    light.size = has_size ? static_cast<float>(random.real(0.005, 0.2)) : 0;
    return light;
  }
  const Vec3 place = random_place(random, 4, 0.5, 6);
  for (std::size_t k = 0; k < 3; ++k) light.vector[k] = static_cast<float>(place[k]);
  light.axis = unit(random_place(random, 2, 0, 2) - place);
  light.cos_outer = static_cast<float>(random.real(0.5, 0.9));
  light.cos_inner = light.cos_outer + 0.05f;
  light.size = has_size ? static_cast<float>(random.real(0.05, 0.5)) : 0;
  return light;
}

// Bodies of patches and meshes over a ground, of which some move.
wire::FilmData random_film(Random& random, std::uint32_t samples, const wire::Light& light) {
  FilmMaker maker(40, 27, 2);
  const std::uint32_t shapes[] = {maker.add_shape(modeler::make_teapot(1.077)),
                                  maker.add_shape(modeler::make_sphere()),
                                  maker.add_shape(modeler::make_torus(0.15)),
                                  maker.add_shape(modeler::make_box()),
                                  maker.add_shape(modeler::make_cone(0)),
                                  maker.add_shape(modeler::cut_meshlets(mesh_ball(9, 0))),
                                  maker.add_shape(modeler::cut_meshlets(mesh_ball(5, 180)))};
  const std::uint32_t clay = maker.add_material(kClay);
  maker.add_segment(shapes[3], clay, {placed({-8, -8, -16}, 16)});
  for (int k = 0; k < 9; ++k) {
    const double size = random.real(0.3, 2.5), angle = random.real(0, 6);
    const Vec3 place = random_place(random, 3.5, -0.3, 2);
    std::vector<wire::Matrix> motion{placed(place, size, angle)};
    for (auto& row : motion[0].m) row[1] *= 0.7, row[2] += 0.2 * row[0];
    if (k % 3 == 0) motion.push_back(placed({place[0], place[1], place[2] + 1}, size, angle));
    maker.add_segment(shapes[random.whole(0, 6)], clay, motion);
  }
  maker.add_light(light);
  maker.set_cameras({looking({random.real(-3, 3), -11, random.real(1, 8)}, {0, 0, 0.5}, random.real(25, 60), 0.01)});
  wire::FilmData film = maker.make(2);
  film.settings.samples = samples;
  return film;
}

struct Counts {
  std::size_t open = 0, blocked = 0, unsure = 0, wrong = 0;
  std::size_t all() const { return open + blocked + unsure; }
};

bool shines_at(const geometry::EyeLight& light, const Vec3& place) {
  if (light.kind != wire::LightKind::spot) return true;
  const Vec3 way = place - Vec3{light.vector[0], light.vector[1], light.vector[2]};
  return shape::dot(way, {light.axis[0], light.axis[1], light.axis[2]}) > double{light.cos_outer} * shape::length(way);
}

// Of wrong ones, the first is reported.
Counts compare(const ShadowRig& rig) {
  Counts counts;
  const auto surfaces = rig.surfaces();
  const ShadowRays rays(surfaces);
  const shadow::LightViews views = rig.views(0);
  for (const Pair& pair : rig.pairs()) {
    if (!shines_at(rig.scene().casting_lights()[0], pair.place)) continue;
    Sight sight = Sight::open;
    for (std::uint32_t face = 0; face < views.faces; ++face) {
      const shadow::LightView& view = views.views[pair.light_point * views.faces + face];
      if (view.is_face) {  // the one whose axis is nearest
        const Vec3 from{pair.place[0] - view.place[0], pair.place[1] - view.place[1], pair.place[2] - view.place[2]};
        const double along = view.axis[0] * from[0] + view.axis[1] * from[1] + view.axis[2] * from[2];
        const double most = std::max({std::abs(from[0]), std::abs(from[1]), std::abs(from[2])});
        if (along < most) continue;
      }
      sight = std::max(sight, rays.trace(view, views.frame, pair.place, pair.w));
    }
    ++(sight == Sight::unsure ? counts.unsure : sight == Sight::blocked ? counts.blocked : counts.open);
    if (sight == Sight::unsure || (sight == Sight::blocked) == pair.blocked) continue;
    if (counts.wrong++ == 0)
      ADD_FAILURE() << "pixel " << pair.column << ' ' << pair.row << ", pair " << pair.number << " at " << pair.place[0]
                    << ' ' << pair.place[1] << ' ' << pair.place[2] << " is " << (pair.blocked ? "blocked" : "open");
  }
  return counts;
}

using Parameters = std::tuple<wire::LightKind, bool, std::uint32_t>;

class ShadowRaysTest : public testing::TestWithParam<Parameters> {};

TEST_P(ShadowRaysTest, AgreeWithEachPair) {
  const auto [kind, has_size, samples] = GetParam();
  Random random(700 + samples + 40 * static_cast<std::uint32_t>(kind) + (has_size ? 20 : 0));
  Counts sum;
  const int trials = has_size ? 3 : 4;
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE(trial);
    const wire::FilmData film = random_film(random, samples, random_light(random, kind, has_size));
    const ShadowRig rig(trial + 1 < trials ? film : shifted(orthographic(film), 0.1, -0.2));
    const Counts counts = compare(rig);
    sum.open += counts.open, sum.blocked += counts.blocked, sum.unsure += counts.unsure, sum.wrong += counts.wrong;
  }
  std::printf("%zu open, %zu blocked, %zu too near to say, %zu wrong\n", sum.open, sum.blocked, sum.unsure, sum.wrong);
  EXPECT_EQ(sum.wrong, 0u);
  EXPECT_LT(sum.unsure, sum.all() / 50);
  EXPECT_GT(sum.open, sum.all() / 10);
  EXPECT_GT(sum.blocked, sum.all() / 20);
}

std::string name_of(const Parameters& parameters) {
  constexpr const char* kKinds[] = {"directional", "point", "spot"};
  const auto [kind, has_size, samples] = parameters;
  return std::string(kKinds[static_cast<int>(kind)]) + (has_size ? "_large_" : "_hard_") + std::to_string(samples);
}

INSTANTIATE_TEST_SUITE_P(Lights, ShadowRaysTest,
                         testing::Combine(testing::Values(wire::LightKind::directional, wire::LightKind::point,
                                                          wire::LightKind::spot),
                                          testing::Bool(), testing::Values(1u, 4u, 16u)),
                         [](const auto& info) { return name_of(info.param); });

}  // namespace
}  // namespace mars::test
