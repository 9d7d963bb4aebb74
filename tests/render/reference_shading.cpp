#include "tests/render/reference_shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

// Cosines between the normal n, the light l, the eye v and the half vector h.
struct Angles {
  double nl, nv, nh, vh;

  Angles(const Vec& n, const Vec& l, const Vec& v) : nl(dot(n, l)), nv(dot(n, v)) {
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
  if (a.nv <= 0 || a.nh <= 0) return 0;
  const double cos2 = square(a.nh), m2 = square(std::max(m.roughness, 0.03f));
  const double d = std::exp(-(1 - cos2) / (cos2 * m2)) / (m2 * square(cos2));
  const double g = std::min({1.0, 2 * a.nh * a.nv / a.vh, 2 * a.nh * a.nl / a.vh});
  return fresnel(m.refraction, a.vh) * d * g / (4 * a.nv);
}

// glTF 2.0, appendix B, times pi and N.L.
Vec metallic_roughness(const Material& m, const Angles& a) {
  const Vec color = vec(m.color), f0 = mix(gray(0.04), color, m.metallic);
  const double a2 = square(square(std::max(m.roughness, 0.08f)));
  const Vec f = mix(f0, gray(1), std::pow(1 - a.vh, 5));
  const double d = a2 / square(square(a.nh) * (a2 - 1) + 1);
  const auto visible = [&](double c) { return 1 / (c + std::sqrt(a2 + (1 - a2) * c * c)); };
  const double specular = a.nv > 0 ? d * visible(a.nl) * visible(a.nv) : 0;
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

ReferenceShading::ReferenceShading(const wire::FilmView& film, std::uint32_t frame) : scene_(film) {
  scene_.set_frame(frame);
}

ReferenceShading::Point ReferenceShading::point_at(const Triangle& t, std::int32_t x, std::int32_t y) const {
  const shape::Projection& p = scene_.projection();
  const Vec toward{(x / 256.0 - p.center[0]) / p.scale, (p.center[1] - y / 256.0) / p.scale, -1};
  const Vec normal{value_at(t, shape::kNormalX, x, y), value_at(t, shape::kNormalY, x, y),
                   value_at(t, shape::kNormalZ, x, y)};
  return {1 / value_at(t, shape::kDepth, x, y) * toward, unit(normal), unit(-1 * toward)};
}

Color ReferenceShading::ambient_of(const Material& material, const Point& point) const {
  const auto up = scene_.up();
  const wire::AmbientLight& around = settings().ambient;
  const Vec light = mix(vec(around.ground), vec(around.sky), 0.5 + 0.5 * dot(point.normal, vec(up)));
  return material.ambient * product(light, vec(material.color));
}

Color ReferenceShading::light_of(const Material& material, const Point& point) const {
  Color sum = ambient_of(material, point);
  for (const EyeLight& light : scene_.lights()) {
    const Shine shines = shine(light, point.place);
    sum = sum + product(shines.color, reflected(material, point.normal, shines.to, point.eye));
  }
  return sum;
}

Color ReferenceShading::light_of_corners(const raster::PlainTriangle& triangle, const Vec& weight) const {
  const Material& material = scene_.film().materials()[triangle.record.material];
  Color sum{};
  double weights = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point corner = point_at(triangle.record, triangle.corners.x[k], triangle.corners.y[k]);
    const double share = weight[k] / -corner.place[2];
    sum = sum + share * light_of(material, corner);
    weights += share;
  }
  return (1 / weights) * sum;
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
    case wire::Interpolation::gouraud: light = light_of_corners(triangle, weights_at(triangle.corners, x, y)); break;
    case wire::Interpolation::flat: light = light_of_corners(triangle, {1, 0, 0}); break;
  }
  light = in_fog(light, -here.place[2]);
  if (settings().color_space == wire::ColorSpace::coded)
    for (double& channel : light) channel = std::clamp(channel, 0.0, 1.0);
  return light;
}

}  // namespace mars::test
