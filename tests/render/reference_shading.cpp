#include "tests/render/reference_shading.h"

#include <algorithm>
#include <cmath>

#include "node/shading/environment.h"

namespace mars::test {
namespace {

using geometry::EyeLight;
using geometry::Triangle;
using wire::Material;
using Vec = std::array<double, 3>;

Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
Vec product(const Vec& a, const Vec& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vec& a) { return std::sqrt(dot(a, a)); }
Vec unit(const Vec& a) { return length(a) > 0 ? (1 / length(a)) * a : Vec{}; }
Vec mix(const Vec& a, const Vec& b, double t) { return (1 - t) * a + t * b; }
Vec vec(const float* a) { return {a[0], a[1], a[2]}; }
Vec vec(const std::array<float, 3>& a) { return vec(a.data()); }
double square(double a) { return a * a; }
Vec gray(double level) { return {level, level, level}; }

double value_at(const Triangle& t, int value, std::int32_t x, std::int32_t y) {
  return t.at_first[value] + (double(y) - t.first_y) * t.per_y[value] + (double(x) - t.first_x) * t.per_x[value];
}

// Light that reaches a place, and where it comes from.
struct Shine {
  Vec to;  // unit
  Vec color;
};

double within_cone(const EyeLight& light, const Vec& to) {
  const double cosine = -dot(to, vec(light.axis));
  if (light.cos_inner <= light.cos_outer) return cosine >= light.cos_outer;
  const double t = std::clamp((cosine - light.cos_outer) / (double{light.cos_inner} - light.cos_outer), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Shine shine(const EyeLight& light, const Vec& place) {
  if (light.kind == wire::LightKind::directional) return {vec(light.vector), vec(light.color)};
  const Vec toward = vec(light.vector) - place;
  double brightness = light.reach > 0 ? 1 / (1 + square(length(toward) / light.reach)) : 1;
  if (light.kind == wire::LightKind::spot) brightness *= within_cone(light, unit(toward));
  return {unit(toward), brightness * vec(light.color)};
}

// Cosines between the normal n, the light l, the eye v and the half vector h. An interpolated normal that is turned
// away from the eye counts as seen from the side.
struct Angles {
  double nl, nv, nh, vh;

  Angles(const Vec& n, const Vec& l, const Vec& v) : nl(dot(n, l)), nv(std::max(dot(n, v), 1e-4)) {
    const Vec h = unit(l + v);
    nh = std::clamp(dot(n, h), 0.0, 1.0);
    vh = std::clamp(dot(v, h), 0.0, 1.0);
  }
};

double phong_highlight(const Material& m, const Vec& n, const Vec& l, const Vec& v) {
  const double mirrored = 2 * dot(n, l) * dot(n, v) - dot(l, v);
  return mirrored > 0 ? std::pow(std::min(mirrored, 1.0), m.exponent) : 0;
}

double blinn_highlight(const Material& m, const Angles& a) { return a.nh > 0 ? std::pow(a.nh, m.exponent) : 0; }

// Fresnel's reflectance of an insulator for unpolarised light (Cook and Torrance 1982).
double fresnel(double index, double c) {
  const double g = std::sqrt(index * index + c * c - 1);
  return 0.5 * square((g - c) / (g + c)) * (1 + square((c * (g + c) - 1) / (c * (g - c) + 1)));
}

// pi F D G / (4 (N.V)) with Beckmann's D.
double cook_torrance(const Material& m, const Angles& a) {
  if (a.nh <= 0) return 0;
  const double cos2 = square(a.nh), m2 = square(std::max(m.roughness, 0.03f));
  const double d = std::exp(-(1 - cos2) / (cos2 * m2)) / (m2 * square(cos2));
  const double g = std::min({1.0, 2 * a.nh * a.nv / a.vh, 2 * a.nh * a.nl / a.vh});
  return fresnel(m.refraction, a.vh) * d * g / (4 * a.nv);
}

// Smith's: the share of facets at cosine c to the normal that others hide, over the share of those seen.
double hidden(double alpha2, double c) { return (std::sqrt(1 + alpha2 * (1 / square(c) - 1)) - 1) / 2; }

// glTF 2.0, appendix B, times pi and N.L; hidden to the eye and to the light as one random height of a facet decides
// both (E. Heitz, "Understanding the masking-shadowing function in microfacet-based BRDFs", JCGT 3, 2014).
Vec metallic_roughness(const Material& m, const Angles& a) {
  const Vec color = vec(m.color), f0 = mix(gray(0.04), color, m.metallic);
  const double a2 = square(square(std::max(m.roughness, 0.08f)));
  const Vec f = mix(f0, gray(1), std::pow(1 - a.vh, 5));
  const double d = a2 / square(square(a.nh) * (a2 - 1) + 1);
  const double g = 1 / (1 + hidden(a2, a.nl) + hidden(a2, a.nv));
  const double specular = d * g / (4 * a.nl * a.nv);
  return a.nl * (product(gray(1) - f, (1 - m.metallic) * color) + specular * f);
}

// Of light 1 that comes from l, what is seen from v.
Vec reflected(const Material& m, const Vec& n, const Vec& l, const Vec& v) {
  const Angles a(n, l, v);
  if (!(a.nl > 0)) return {};
  const Vec diffuse = m.diffuse * a.nl * vec(m.color);
  switch (m.reflection) {
    case wire::Reflection::phong: return diffuse + gray(m.specular * phong_highlight(m, n, l, v));
    case wire::Reflection::blinn_phong: return diffuse + gray(m.specular * blinn_highlight(m, a));
    case wire::Reflection::cook_torrance: return diffuse + gray(m.specular * cook_torrance(m, a));
    default: return metallic_roughness(m, a);
  }
}

// A share of EnvironmentTable, between its four numbers round N.V and the roughness.
double look_up(const float* table, double nv, double rough) {
  constexpr int kSide = shading::EnvironmentTable::kSide;
  const double x = std::clamp(nv, 0.0, 1.0) * (kSide - 1), y = rough * (kSide - 1);
  const int column = std::min(static_cast<int>(x), kSide - 2), row = std::min(static_cast<int>(y), kSide - 2);
  const float* at = table + row * kSide + column;
  return std::lerp(std::lerp(at[0], at[1], x - column), std::lerp(at[kSide], at[kSide + 1], x - column), y - row);
}

// How much of each corner of `whole` there is at a corner of one of its pieces; a corner that was not cut is number
// `k`.
Vec shares_of(const geometry::ClipVertex (&whole)[3], const geometry::ClipVertex& corner, std::size_t k) {
  Vec share{};
  const Vec place = vec(corner.place), a = vec(whole[0].place), b = vec(whole[1].place), c = vec(whole[2].place);
  if (place == vec(whole[k].place)) {
    share[k] = 1;
    return share;
  }
  const Vec normal = cross(b - a, c - a);
  share[0] = dot(normal, cross(b - place, c - place)) / dot(normal, normal);
  share[1] = dot(normal, cross(c - place, a - place)) / dot(normal, normal);
  share[2] = 1 - share[0] - share[1];
  return share;
}

// How much of each corner there is on the screen at (x, y).
Vec weights_at(const raster::Corners& corners, std::int32_t x, std::int32_t y) {
  Vec weight;
  for (std::size_t k = 0; k < 3; ++k) {
    raster::Corners opposite = corners;
    opposite.x[k] = x;
    opposite.y[k] = y;
    weight[k] = static_cast<double>(raster::area(opposite)) / static_cast<double>(raster::area(corners));
  }
  return weight;
}

}  // namespace

ReferenceShading::ReferenceShading(const wire::PackedFilm& film, std::uint32_t frame) : scene_(film) {
  scene_.set_frame(frame);
}

ReferenceShading::Point ReferenceShading::point_at(const Triangle& t, std::int32_t x, std::int32_t y) const {
  const shape::Projection& p = scene_.projection();
  const double right = (x / 256.0 - p.center[0]) / p.scale, up = (p.center[1] - y / 256.0) / p.scale;
  const double depth = value_at(t, shape::kDepth, x, y);
  const Vec normal{value_at(t, shape::kNormalX, x, y), value_at(t, shape::kNormalY, x, y),
                   value_at(t, shape::kNormalZ, x, y)};
  const Vec place = p.parallel ? Vec{right, up, depth} : 1 / depth * Vec{right, up, -1};
  return {place, unit(normal), toward_eye(place)};
}

Vec ReferenceShading::toward_eye(const Vec& place) const {
  return scene_.projection().parallel ? Vec{0, 0, 1} : unit(-1 * place);
}

Color ReferenceShading::ambient_of(const Material& material, const Point& point) const {
  const Vec up = vec(scene_.up()), color = vec(material.color);
  const auto around = [&](double z) {
    return mix(vec(settings().ambient.ground), vec(settings().ambient.sky), std::clamp(0.5 + 0.5 * z, 0.0, 1.0));
  };
  const Vec matt = product(around(dot(point.normal, up)), color);
  if (material.reflection != wire::Reflection::metallic_roughness) return material.ambient * matt;
  const double rough = std::max(material.roughness, 0.08f), nv = dot(point.normal, point.eye);
  const Vec mirror = 2 * nv * point.normal - point.eye;
  const shading::EnvironmentTable& table = shading::environment_table();
  const Vec share = look_up(table.colored, nv, rough) * mix(gray(0.04), color, material.metallic) +
                    gray(look_up(table.white, nv, rough));
  const Vec inside = (1 - material.metallic) * product(gray(1) - share, matt);
  return material.ambient * (inside + product(share, around(dot(mirror, up) / rough)));
}

Color ReferenceShading::light_of(const Material& material, const Point& point) const {
  Color sum = ambient_of(material, point);
  for (const EyeLight& light : scene_.lights()) {
    const Shine shines = shine(light, point.place);
    sum = sum + product(shines.color, reflected(material, point.normal, shines.to, point.eye));
  }
  return sum;
}

Color ReferenceShading::light_of_corner(const raster::PlainTriangle& triangle, std::size_t corner) const {
  const geometry::ClipVertex& vertex = triangle.whole[corner];
  const Vec place = vec(vertex.place);
  const Point point{place, (triangle.faces ? 1 : -1) * unit(vec(vertex.varying)), toward_eye(place)};
  return light_of(scene_.film().materials()[triangle.record.material], point);
}

Color ReferenceShading::gouraud_light(const raster::PlainTriangle& triangle, std::int32_t x, std::int32_t y) const {
  const Color whole[] = {light_of_corner(triangle, 0), light_of_corner(triangle, 1), light_of_corner(triangle, 2)};
  const Vec weight = weights_at(triangle.corners, x, y);
  Color sum{};
  double weights = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec share = shares_of(triangle.whole, triangle.eye[k], k);
    const double here = weight[k] / (scene_.projection().parallel ? 1 : -triangle.eye[k].place[2]);
    for (std::size_t corner = 0; corner < 3; ++corner) sum = sum + here * share[corner] * whole[corner];
    weights += here;
  }
  return (1 / weights) * sum;
}

Color ReferenceShading::flat_light(const raster::PlainTriangle& triangle) const {
  const Vec a = vec(triangle.whole[0].place), b = vec(triangle.whole[1].place), c = vec(triangle.whole[2].place);
  const Vec middle = (1.0 / 3) * (a + b + c), normal = unit(cross(b - a, c - a));
  const Vec eye = toward_eye(middle);
  const Point point{middle, dot(normal, eye) > 0 ? normal : -1 * normal, eye};
  return light_of(scene_.film().materials()[triangle.record.material], point);
}

Color ReferenceShading::in_fog(const Color& light, double w) const {
  const wire::Fog& fog = settings().fog;
  if (fog.end <= fog.start) return light;
  return mix(light, vec(fog.color), std::clamp((w - fog.start) / (double{fog.end} - fog.start), 0.0, 1.0));
}

Color ReferenceShading::shade(const raster::PlainTriangle& triangle, std::int32_t x, std::int32_t y) const {
  const Material& material = scene_.film().materials()[triangle.record.material];
  const Point here = point_at(triangle.record, x, y);
  Color light{};
  switch (material.interpolation) {
    case wire::Interpolation::phong: light = light_of(material, here); break;
    case wire::Interpolation::gouraud: light = gouraud_light(triangle, x, y); break;
    case wire::Interpolation::flat: light = flat_light(triangle); break;
  }
  light = in_fog(light, -here.place[2]);
  if (settings().color_space == wire::ColorSpace::coded)
    for (double& channel : light) channel = std::clamp(channel, 0.0, 1.0);
  return light;
}

}  // namespace mars::test
