#include "tests/node/shading/plain_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "node/shading/environment.h"

namespace mars::shading {

using shape::dot;
using shape::Vec3;
using shape::operator-;

namespace {

Vec3 times(double factor, const Vec3& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
Vec3 plus(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec3 unit(const Vec3& a) {
  const double size = shape::length(a);
  return size > 0 ? times(1 / size, a) : Vec3{};
}
Vec3 vec(const float* a) { return {a[0], a[1], a[2]}; }
double limited(double cosine) { return std::clamp(cosine, 1e-4, 1.0); }

double phong(const wire::Material& m, const Vec3& n, const Vec3& l, const Vec3& v) {
  const double mirrored = 2 * dot(n, l) * dot(n, v) - dot(l, v);
  return mirrored > 0 ? std::pow(std::min(mirrored, 1.0), static_cast<double>(m.exponent)) : 0;
}

double blinn(const wire::Material& m, const Vec3& n, const Vec3& l, const Vec3& v) {
  const double nh = dot(n, unit(plus(l, v)));
  return nh > 0 ? std::pow(std::min(nh, 1.0), static_cast<double>(m.exponent)) : 0;
}

// F D G / (4 N.V), D pi times Beckmann's.
double cook_torrance(const wire::Material& m, const Vec3& n, const Vec3& l, const Vec3& v) {
  const double nl = limited(dot(n, l)), nv = limited(dot(n, v));
  const Vec3 h = unit(plus(l, v));
  const double nh = limited(dot(n, h)), vh = limited(dot(v, h));
  const double slope = std::max(m.roughness, 0.03f), index = m.refraction;
  const double d = std::exp((nh * nh - 1) / (nh * nh * slope * slope)) / (slope * slope * std::pow(nh, 4));
  const double g = std::min({1.0, 2 * nh * nv / vh, 2 * nh * nl / vh});
  const double root = std::sqrt(index * index - 1 + vh * vh);
  const double f =
      0.5 * std::pow((root - vh) / (root + vh), 2) * (1 + std::pow((vh * (root + vh) - 1) / (vh * (root - vh) + 1), 2));
  return f * d * g / (4 * nv);
}

Vec3 metallic_roughness(const wire::Material& m, const Vec3& n, const Vec3& l, const Vec3& v) {
  const double nl = limited(dot(n, l)), nv = limited(dot(n, v));
  const Vec3 h = unit(plus(l, v));
  const double nh = limited(dot(n, h)), vh = limited(dot(v, h));
  const double alpha = std::pow(std::max(m.roughness, 0.08f), 2), alpha2 = alpha * alpha;
  const double d = alpha2 / std::pow(nh * nh * (alpha2 - 1) + 1, 2);
  const double visible =
      0.5 / (nl * std::sqrt(nv * nv * (1 - alpha2) + alpha2) + nv * std::sqrt(nl * nl * (1 - alpha2) + alpha2));
  Vec3 out;
  for (std::size_t c = 0; c < 3; ++c) {
    const double f0 = 0.04 + m.metallic * (m.color[c] - 0.04);
    const double f = f0 + (1 - f0) * std::pow(1 - vh, 5);
    out[c] = nl * ((1 - f) * m.color[c] * (1 - m.metallic) + f * d * visible);
  }
  return out;
}

double share_of_sky(double z) { return std::clamp(0.5 + 0.5 * z, 0.0, 1.0); }

double from_around(const Shading& shading, std::size_t c, double z) {
  const double ground = shading.ambient.ground[c], sky = shading.ambient.sky[c];
  return ground + (sky - ground) * share_of_sky(z);
}

double look_up(const float* table, double nv, double rough) {
  constexpr int kSide = EnvironmentTable::kSide;
  const double x = nv * (kSide - 1), y = rough * (kSide - 1);
  const int column = std::min(static_cast<int>(x), kSide - 2), row = std::min(static_cast<int>(y), kSide - 2);
  const auto at = [&](int r, int c) { return static_cast<double>(table[(row + r) * kSide + column + c]); };
  const double dx = x - column, dy = y - row;
  return (1 - dy) * ((1 - dx) * at(0, 0) + dx * at(0, 1)) + dy * ((1 - dx) * at(1, 0) + dx * at(1, 1));
}

Vec3 plain_ambient(const Shading& shading, const wire::Material& m, const Vec3& n, const Vec3& v) {
  const Vec3 up = vec(shading.up);
  Vec3 out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = m.ambient * m.color[c] * from_around(shading, c, dot(n, up));
  if (m.reflection != wire::Reflection::metallic_roughness) return out;
  const double rough = std::max(m.roughness, 0.08f), nv = std::clamp(dot(n, v), 0.0, 1.0);
  const Vec3 mirrored = times(2 * dot(n, v), n) - v;
  const EnvironmentTable& table = environment_table();
  for (std::size_t c = 0; c < 3; ++c) {
    const double f0 = 0.04 + m.metallic * (m.color[c] - 0.04);
    const double share = f0 * look_up(table.colored, nv, rough) + look_up(table.white, nv, rough);
    const double diffuse = (1 - share) * m.color[c] * (1 - m.metallic);
    out[c] = m.ambient * (diffuse * from_around(shading, c, dot(n, up)) +
                          share * from_around(shading, c, dot(mirrored, up) / rough));
  }
  return out;
}

}  // namespace

Vec3 plain_reflection(const wire::Material& m, const Vec3& n, const Vec3& l, const Vec3& v) {
  if (m.reflection == wire::Reflection::metallic_roughness) return metallic_roughness(m, n, l, v);
  const auto highlight = m.reflection == wire::Reflection::phong         ? phong
                         : m.reflection == wire::Reflection::blinn_phong ? blinn
                                                                         : cook_torrance;
  const double white = m.specular * highlight(m, n, l, v);
  Vec3 out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = m.diffuse * m.color[c] * dot(n, l) + white;
  return out;
}

double plain_brightness(const geometry::EyeLight& light, const Vec3& place) {
  if (light.kind == wire::LightKind::directional) return 1;
  const Vec3 to = vec(light.vector) - place;
  const double ratio = light.reach > 0 ? shape::length(to) / light.reach : 0;
  const double bright = 1 / (1 + ratio * ratio);
  if (light.kind == wire::LightKind::point) return bright;
  const double cosine = -dot(vec(light.axis), unit(to));
  if (cosine >= light.cos_inner) return bright;
  if (cosine <= light.cos_outer) return 0;
  const double x = (cosine - light.cos_outer) / (light.cos_inner - light.cos_outer);
  return bright * x * x * (3 - 2 * x);
}

Vec3 plain_light(const Shading& shading, const wire::Material& m, const Spot& spot) {
  const Vec3 v = unit(times(-1, spot.place));
  Vec3 out = plain_ambient(shading, m, spot.normal, v);
  for (std::uint32_t i = 0; i < shading.light_count; ++i) {
    const geometry::EyeLight& light = shading.lights[i];
    const Vec3 vector = vec(light.vector);
    const Vec3 l = light.kind == wire::LightKind::directional ? vector : unit(vector - spot.place);
    if (dot(spot.normal, l) <= 0) continue;
    const Vec3 reflected = plain_reflection(m, spot.normal, l, v);
    const double bright = plain_brightness(light, spot.place);
    for (std::size_t c = 0; c < 3; ++c) out[c] += reflected[c] * bright * light.color[c];
  }
  return out;
}

Vec3 plain_fog(const wire::Fog& fog, const Vec3& light, double w) {
  if (fog.end <= fog.start) return light;
  const double share = std::clamp((w - fog.start) / (static_cast<double>(fog.end) - fog.start), 0.0, 1.0);
  Vec3 out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = light[c] + share * (fog.color[c] - light[c]);
  return out;
}

}  // namespace mars::shading
