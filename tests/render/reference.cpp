#include "tests/render/reference.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "node/polygons.h"

namespace mars::test {
namespace {

using node::Triangle;

std::uint32_t interval_of(const node::FilmView& film, std::uint32_t frame) {
  std::uint32_t i = 0;
  while (frame >= film.intervals()[i].first_frame + film.intervals()[i].frame_count) ++i;
  return i;
}

// Whether the sample is on the inner side of the directed side a -> b, or on it where left and top sides own
// their samples. Vertices run clockwise as seen (y downwards), so inside is where the cross product is > 0.
bool within(std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by, std::int64_t x, std::int64_t y) {
  const std::int64_t cross = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
  const bool top = by == ay && bx > ax;
  const bool left = by < ay;
  return cross > 0 || (cross == 0 && (top || left));
}

bool covers(const Triangle& t, std::int64_t x, std::int64_t y) {
  const std::int64_t area = std::int64_t{t.x[1] - t.x[0]} * (t.y[2] - t.y[0]) - std::int64_t{t.x[2] - t.x[0]} * (t.y[1] - t.y[0]);
  const int b = area > 0 ? 1 : 2, c = 3 - b;
  return within(t.x[0], t.y[0], t.x[b], t.y[b], x, y) && within(t.x[b], t.y[b], t.x[c], t.y[c], x, y) &&
         within(t.x[c], t.y[c], t.x[0], t.y[0], x, y);
}

float value_at(const node::Plane& plane, const Triangle& t, std::int32_t x, std::int32_t y) {
  const float row = plane.at_first + static_cast<float>(y - t.y[0]) * plane.per_y;
  return row + static_cast<float>(x - t.x[0]) * plane.per_x;
}

// Lower comes first and wins ties.
auto order(const Reference& reference, std::size_t triangle) {
  const Triangle& t = reference.triangles[triangle];
  return std::make_tuple(bool{reference.moving[triangle]}, t.patch, t.index);
}

void draw(Reference& reference, std::size_t number, std::int32_t width, std::int32_t height) {
  const Triangle& t = reference.triangles[number];
  const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
  const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
  const auto sample = [](std::int32_t place) { return (place - 128) / 256; };
  for (std::int32_t row = std::max(sample(top) - 1, 0); row <= std::min(sample(bottom) + 1, height - 1); ++row)
    for (std::int32_t column = std::max(sample(left) - 1, 0); column <= std::min(sample(right) + 1, width - 1); ++column) {
      const std::int32_t x = 256 * column + 128, y = 256 * row + 128;
      if (!covers(t, x, y)) continue;
      ReferenceSample& here = reference.samples[static_cast<std::size_t>(row) * reference.width + static_cast<std::size_t>(column)];
      const float depth = value_at(t.depth, t, x, y);
      const bool nearer = depth > here.depth || (here.triangle && depth == here.depth &&
                                                 order(reference, number) < order(reference, *here.triangle));
      if (nearer) here = {number, depth};
    }
}

struct Vec {
  double x, y, z;
};
double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec unit(const Vec& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Vec{a.x / length, a.y / length, a.z / length} : Vec{0, 0, 0};
}

}  // namespace

Reference draw_reference(const node::FilmView& film, std::uint32_t frame) {
  node::Scene scene(film);
  scene.set_interval(interval_of(film, frame));
  scene.set_frame(frame);
  node::PolygonMaker maker(node::best_kernels(""));
  std::vector<std::uint32_t> counts(film.settings().height);
  node::WorkCounts work{};
  Reference reference;
  reference.width = film.settings().width;
  reference.triangles.resize(1 << 20);
  node::SetUps out{.triangles = reference.triangles, .line_counts = counts, .wanted_lines = {}};
  maker.make(scene, node::Part::moving, {}, out, work);
  reference.moving.assign(out.stored, true);
  maker.make(scene, node::Part::stationary, {}, out, work);
  reference.triangles.resize(out.stored);
  reference.moving.resize(out.stored, false);
  reference.samples.resize(std::size_t{reference.width} * film.settings().height);
  for (std::size_t i = reference.triangles.size(); i-- > 0;) draw(reference, i, scene.width(), scene.height());
  return reference;
}

Color shade_reference(const node::FilmView& film, std::uint32_t frame, const Reference& reference,
                      std::uint32_t column, std::uint32_t row) {
  node::Scene scene(film);
  scene.set_frame(frame);
  const ReferenceSample& sample = reference.at(column, row);
  const Triangle& t = reference.triangles[*sample.triangle];
  const auto x = static_cast<std::int32_t>(256 * column + 128), y = static_cast<std::int32_t>(256 * row + 128);
  const Vec n = unit({value_at(t.normal[0], t, x, y), value_at(t.normal[1], t, x, y), value_at(t.normal[2], t, x, y)});
  const node::Projection& p = scene.projection();
  const double dx = (column + 0.5 - p.center[0]) / p.scale, dy = (row + 0.5 - p.center[1]) / p.scale;
  const Vec eye = unit({-dx, dy, 1});
  const node::Material& m = film.materials()[t.look];
  Color color{};
  for (int c = 0; c < 3; ++c) color.channel[c] = m.ambient * m.color[static_cast<std::size_t>(c)];
  for (const node::EyeLight& light : scene.lights()) {
    Vec to{light.vector[0], light.vector[1], light.vector[2]};
    const double w = 1 / sample.depth;
    if (light.point) to = unit({to.x - dx * w, to.y + dy * w, to.z + w});
    const double facing = dot(n, to);
    if (facing <= 0) continue;
    const double mirrored = 2 * facing * dot(n, eye) - dot(to, eye);
    const double highlight = mirrored > 0 ? std::pow(std::min(mirrored, 1.0), m.exponent) : 0;
    for (int c = 0; c < 3; ++c)
      color.channel[c] += (m.diffuse * m.color[static_cast<std::size_t>(c)] * facing + m.specular * highlight) * light.color[c];
  }
  for (double& channel : color.channel) channel = 255 * std::clamp(channel, 0.0, 1.0);
  return color;
}

}  // namespace mars::test
