// The pixel version (node/wire/pixel_version.h) is held to pixels: small films that have what renderers draw, each
// model of reflection and interpolation, 1, 4 and 16 samples, patches and meshes, keyframes and inbetweens, all formats
// of pixels. Where pixels change on purpose: raise kPixelVersion, and store the table that the failing test prints.
#include "node/wire/pixel_version.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "host/content/modeler/primitives.h"
#include "host/content/document/checksum.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

// A ball of polygons and one of patches, which turn the one through the other.
wire::FilmData balls() {
  FilmMaker maker(64, 48, 3);
  maker.add_material(kClay);
  const std::uint32_t mesh = maker.add_shape(modeler::cut_meshlets(mesh_ball(6, 60)));
  const std::uint32_t ball = maker.add_shape(modeler::make_sphere());
  maker.add_segment(ball, 0, {placed({-0.6, -1, -1}, 1.8)});
  maker.add_segment(mesh, 0,
                    {placed({-1.2, -1, -1}, 2, 0.1), placed({-1, -1, -1}, 2, 0.3), placed({-0.8, -1, -1}, 2, 0.5)});
  maker.add_light({wire::LightKind::directional, {-0.36f, -0.48f, 0.8f}, {0.9f, 0.9f, 0.8f}});
  maker.set_cameras({looking({0, -6, 2}, {0, 0, 0}, 30)});
  return maker.make();
}

struct HashedCase {
  std::string name;
  wire::FilmData film;
  wire::PixelFormat format = wire::PixelFormat::rgb8;
};

std::vector<HashedCase> hashed_cases() {
  std::vector<HashedCase> all;
  for (const std::uint32_t samples : {1u, 4u, 16u}) {
    const std::string of = "-" + std::to_string(samples);
    all.push_back({"crowd" + of, with_samples(crowd(96, 54, 4, 3), samples)});
    all.push_back({"models" + of, with_samples(richly_lit(crowd(96, 54, 3, 3)), samples)});
    all.push_back({"flight" + of, with_samples(flight(64, 36, 2), samples)});
    all.push_back({"balls" + of, with_samples(balls(), samples)});
    all.push_back({"skins" + of, with_samples(bending(72, 54, 3, 3), samples)});
  }
  all.push_back({"ties", ties(48, 36)});
  all.push_back({"orthographic", orthographic(casting(richly_lit(with_samples(crowd(64, 36, 3, 3), 4)), {0.0f}))});
  all.push_back({"shifted", shifted(richly_lit(crowd(96, 54, 3, 3)), 0.3, -0.2)});
  all.push_back({"models-rgb16", richly_lit(crowd(96, 54, 2, 2)), wire::PixelFormat::rgb16});
  all.push_back({"models-half", richly_lit(crowd(96, 54, 2, 2)), wire::PixelFormat::half});
  return all;
}

std::string hash_of(const HashedCase& of) {
  RunOptions options;
  options.nodes = 2;
  options.format = of.format;
  document::Checksum sum;
  const FilmBlock block(of.film);
  const FilmRun run = run_film(block.bytes(), options);
  for (const auto& [number, pixels] : run.frames) sum.add(std::as_bytes(std::span(pixels)));
  return sum.digits();
}

std::string table() {
  std::string lines = "pixel-version " + std::to_string(wire::kPixelVersion) + "\n";
  for (const HashedCase& each : hashed_cases()) lines += each.name + " " + hash_of(each) + "\n";
  return lines;
}

TEST(PixelVersion, PixelsAreThoseThatItStandsFor) {
  std::ostringstream stored;
  stored << std::ifstream(MARS_PIXEL_HASHES).rdbuf();
  const std::string now = table();
  if (now == stored.str()) return;
  const bool raised = !stored.str().starts_with(now.substr(0, now.find('\n') + 1));
  ADD_FAILURE() << (raised ? "kPixelVersion has changed: store these hashes"
                           : "pixels have changed: raise kPixelVersion and store these hashes")
                << " in " << MARS_PIXEL_HASHES << '\n'
                << now;
}

}  // namespace
}  // namespace mars::test
