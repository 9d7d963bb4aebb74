#include "tests/render/shadow_rig.h"

#include "node/geometry/meshlets.h"
#include "node/shadow/pairs.h"
#include "node/shape/dice.h"
#include "node/simd/instruction_set.h"

namespace mars::test {
namespace {

constexpr int kUnseenRate = 32;  // as shadow::CasterStream dices what no pixel shows

CastingSurface triangles_of(const shape::Surface& surface) {
  CastingSurface out;
  const shape::Vertices& v = surface.vertices();
  const auto corner = [&](std::uint32_t k) { return shape::Vec3{v.place[0][k], v.place[1][k], v.place[2][k]}; };
  for (std::uint32_t k = 0; k < surface.triangles().count; ++k) {
    const shape::Corner3 at = surface.triangles()[k];
    out.triangles.push_back({corner(at.a), corner(at.b), corner(at.c)});
  }
  return out;
}

}  // namespace

ShadowRig::ShadowRig(const wire::FilmData& film, std::string_view simd) : block_(film), scene_(block_.view()) {
  scene_.set_interval(0);
  scene_.set_frame(0);
  reference_ = draw_reference(block_.view(), 0);
  lay_out(reference_.still, still_);
  lay_out(reference_.movers, movers_);
  shadow::ShadowCaster caster(simd::best_instruction_set(simd), scene_,
                              shadow::plan_shadows(shadow::shadow_needs(scene_.film()), 1 << 30));
  caster.begin(scene_, [] {});
  shadow::Layer* const drawn[] = {&still_.layer, &movers_.layer};
  shadow::Layer kept{};
  kept.begin(reference_.width, still_.layer.range);
  caster.cast(scene_, drawn, kept);
}

void ShadowRig::lay_out(const std::vector<ReferenceSample>& from, Samples& to) const {
  const std::size_t width = reference_.width, height = static_cast<std::size_t>(scene_.height()),
                    count = static_cast<std::size_t>(reference_.pattern.count), lights = scene_.casting_count();
  to.depth.resize(width * height * count);
  to.pairs.assign(width * height * lights, {0xffff, 0});
  to.moved.assign(to.pairs.size(), 0);
  to.layer.begin(reference_.width, {0, static_cast<std::uint32_t>(height)});
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t s = 0; s < count; ++s) {
        const ReferenceSample& sample = from[(row * width + x) * count + s];
        to.depth[(row * count + s) * width + x] = sample.triangle ? sample.depth : 0;
      }
    to.layer.lines[row] = {&to.depth[row * count * width], width, &to.pairs[row * width * lights],
                           &to.moved[row * width * lights]};
  }
  to.layer.count_all_tiles();
}

shadow::LightViews ShadowRig::views(std::uint32_t light) const {
  return shadow::light_views(scene_.casting_lights()[light], scene_.projection());
}

std::vector<Pair> ShadowRig::pairs() const {
  std::vector<Pair> out;
  for (std::uint32_t light = 0; light < scene_.casting_count(); ++light) {
    add_pairs(reference_.still, still_, light, out);
    add_pairs(reference_.movers, movers_, light, out);
  }
  return out;
}

void ShadowRig::add_pairs(const std::vector<ReferenceSample>& from, const Samples& samples, std::uint32_t light,
                          std::vector<Pair>& out) const {
  const shape::SamplePattern& pattern = reference_.pattern;
  const shape::Projection& p = scene_.projection();
  const auto count = static_cast<std::uint32_t>(pattern.count);
  const bool has_size = scene_.casting_lights()[light].size > 0;
  const std::uint32_t each = shadow::pairs_a_sample(count, has_size);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(scene_.height()); ++row)
    for (std::uint32_t column = 0; column < reference_.width; ++column) {
      const std::size_t at = std::size_t{light} * reference_.width + column;
      const shadow::LayerLine& line = samples.layer.line(row);
      const std::uint32_t blocked = line.pairs[at].blocked | line.moved[at];
      for (std::uint32_t number = 0; number < count * each; ++number) {
        const std::uint32_t s = number / each;
        const ReferenceSample& sample = from[reference_.first_sample(column, row) + s];
        if (!sample.triangle) continue;
        const double w = p.parallel ? -double{sample.depth} : 1.0 / double{sample.depth};
        const double spread = p.parallel ? 1 : w;
        const double x = column + pattern.x[s] / 256.0, y = row + pattern.y[s] / 256.0;
        out.push_back({light,
                       column,
                       row,
                       number,
                       *sample.triangle,
                       w,
                       {(x - double{p.center[0]}) / double{p.scale} * spread,
                        (double{p.center[1]} - y) / double{p.scale} * spread, -w},
                       has_size ? shadow::point_of_pair(column, row, number) : 0,
                       (blocked >> number & 1) != 0});
      }
    }
}

std::vector<CastingSurface> ShadowRig::surfaces() const {
  std::vector<CastingSurface> out;
  shape::Dicer dicer(simd::best_instruction_set("sse2"));
  geometry::MeshletPlacer placer(simd::best_instruction_set("sse2"));
  const wire::PackedFilm& film = scene_.film();
  for (std::size_t s = 0; s < film.segments().size(); ++s) {
    if (film.materials()[scene_.material(s)].casts != 1) continue;
    const std::uint32_t number = film.segments()[s].shape;
    const shape::EyeMatrix matrix = scene_.matrix(s);
    for (const wire::Patch& patch : film.patches_of(number)) {
      const shape::EyePatch eye_patch = shape::to_eye(matrix, patch);
      shape::Dicing dicing = scene_.dicing();
      if (shape::unseen(eye_patch, scene_.projection(), static_cast<float>(scene_.width()),
                        static_cast<float>(scene_.height())))
        dicing.most_inside = kUnseenRate;
      dicer.dice(eye_patch, scene_.projection(), dicing);
      out.push_back(triangles_of(dicer));
    }
    for (const wire::Meshlet& meshlet : film.meshlets_of(number)) {
      placer.place(geometry::eye_map(matrix), film, meshlet, scene_.projection());
      out.push_back(triangles_of(placer));
    }
  }
  return out;
}

}  // namespace mars::test
