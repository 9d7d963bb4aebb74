// What a pixel makes of its samples: how many of them show what, exactly, and which of them is shaded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "host/content/modeler/primitives.h"
#include "tests/node/shape/patches.h"
#include "tests/render/film_run.h"
#include "tests/render/films.h"
#include "tests/render/looks.h"
#include "tests/render/reference.h"

namespace mars::test {
namespace {

constexpr std::uint32_t kAllSamples[] = {1, 2, 4, 8, 16};

FilmRun draw(const wire::FilmData& film, int nodes) {
  RunOptions options;
  options.nodes = nodes;
  return run_film(FilmBlock(film).bytes(), options);
}

// Two frames, 64 x 64: a green box before a red one. The edges of the green one's front, which the eye sees straight
// ahead 8 away, are at 16 + `share` pixels from the left and at as many from below; above and to the right it leaves
// the picture. It stands still or moves, into the picture's depth where nothing of it is seen.
wire::FilmData box_edges(double share, bool moving) {
  FilmMaker maker(64, 64, 2);
  const std::uint32_t box = maker.add_shape(modeler::make_box());
  const std::uint32_t red = maker.add_material({{1, 0, 0}, 1, 0, 0, 1, 2});
  const std::uint32_t green = maker.add_material({{0, 1, 0}, 1, 0, 0, 1, 2});
  const double edge = -2 + share / 8;
  std::vector<wire::Matrix> motion{placed({edge, 0, edge}, 20)};
  if (moving) {
    motion.push_back(motion.front());
    motion.back().m[1][1] += 1;
  }
  maker.add_segment(box, red, {placed({-50, 10, -50}, 100)});
  maker.add_segment(box, green, motion);
  wire::Camera camera = looking({0, -8, 0}, {0, 0, 0}, 50);
  camera.focal = 2;  // 8 pixels a unit
  maker.set_cameras({camera});
  return maker.make();
}

// By frames.
using Pictures = std::map<std::uint32_t, Pixels>;

Pictures draw_plainly(const wire::FilmData& film) {
  const FilmBlock block(film);
  Pictures out;
  for (std::uint32_t frame = 0; frame < film.settings.frames; ++frame)
    out[frame] = reference_pixels(draw_reference(block.view(), frame), {block.view(), frame});
  return out;
}

void expect_edges(const Pictures& pictures, double share, const std::string& name) {
  const auto red = static_cast<std::uint32_t>(255 * share + 0.5);
  const auto green = static_cast<std::uint32_t>(255 * (1 - share) + 0.5);
  for (const auto& [number, pixels] : pictures) {
    const auto at = [&, &drawn = pixels](std::uint32_t column, std::uint32_t row) { return drawn[64 * row + column]; };
    EXPECT_EQ(at(16, 20), red | green << 8) << name << ", frame " << number;
    EXPECT_EQ(at(40, 47), red | green << 8) << name << ", frame " << number;
    EXPECT_EQ(at(15, 20), 0xffu);
    EXPECT_EQ(at(17, 20), 0xff00u);
    EXPECT_EQ(at(40, 46), 0xff00u);
    EXPECT_EQ(at(40, 48), 0xffu);
  }
}

TEST(Samples, AnEdgeGivesThePixelItsShareOfSamples) {
  for (const std::uint32_t samples : kAllSamples)
    for (std::uint32_t uncovered = 0; uncovered <= samples; ++uncovered)
      for (const bool moving : {false, true}) {
        const double share = double(uncovered) / samples;
        const wire::FilmData film = with_samples(box_edges(share, moving), samples);
        const std::string name = std::to_string(uncovered) + " of " + std::to_string(samples);
        expect_edges(draw(film, 2).frames, share, name);
        expect_edges(draw_plainly(film), share, name + ", twin");
      }
}

// Pixels where a moving part covers only some of what stands still, by the twin.
int half_covered(const Reference& reference) {
  int count = 0;
  const auto samples = static_cast<std::size_t>(reference.pattern.count);
  for (std::size_t first = 0; first < reference.still.size(); first += samples) {
    std::size_t still = 0, covered = 0;
    for (std::size_t s = first; s < first + samples; ++s) {
      still += reference.still[s].triangle.has_value();
      covered += reference.movers[s].triangle.has_value();
    }
    count += still == samples && covered > 0 && covered < samples;
  }
  return count;
}

// Where colours are pure, the mean of samples is exact and all samples can be distinguished.
void expect_same_samples(const wire::FilmData& film, int nodes, bool has_edges_of_movers) {
  const FilmBlock block(film);
  const FilmRun run = draw(film, nodes);
  FilmRun expected;
  int edges = 0;
  for (std::uint32_t frame = 0; frame < film.settings.frames; ++frame) {
    const Reference reference = draw_reference(block.view(), frame);
    expected.frames[frame] = reference_pixels(reference, {block.view(), frame});
    edges += half_covered(reference);
  }
  expect_same(run, expected, film.settings, "pure-colors-" + std::to_string(film.settings.samples));
  EXPECT_EQ(edges > 20, has_edges_of_movers && film.settings.samples > 1) << edges;
}

// Heaps of triangles of all sizes and forms that cross each other, every other heap in motion.
wire::FilmData shards(std::uint32_t seed) {
  shape::Random random(seed);
  FilmMaker maker(120, 90, 2);
  const std::uint32_t material = maker.add_material(kClay);
  for (int heap = 0; heap < 6; ++heap) {
    modeler::Mesh mesh;
    for (std::uint32_t corner = 0; corner < 180; ++corner) {
      const double spread = corner % 3 == 0 ? 1 : std::pow(random.real(0, 1), 4);
      mesh.vertices.push_back(corner % 3 == 0 ? std::array{0.5f, 0.5f, 0.5f} : mesh.vertices[corner - 1]);
      for (float& place : mesh.vertices.back())
        place = static_cast<float>(std::clamp(place + random.real(-spread, spread) / 2, 0.0, 1.0));
      mesh.corners.push_back(corner);
      if (corner % 3 == 2) mesh.ends.push_back(corner + 1);
    }
    std::vector<wire::Matrix> motion{placed({-2, -2, -2}, 4, 0.1 * heap)};
    if (heap % 2 == 1) motion.push_back(placed({-2, -1.9, -2}, 4, 0.1 * heap + 0.03));
    maker.add_segment(maker.add_shape(modeler::cut_meshlets(mesh)), material, motion);
  }
  maker.set_cameras({looking({0.3, -8, 0.4}, {0, 0, 0}, 40)});
  return maker.make();
}

TEST(Samples, ShardsShowWhatTheTwinShows) {
  for (const std::uint32_t samples : kAllSamples)
    for (const std::uint32_t seed : {1u, 2u, 3u})
      expect_same_samples(with_samples(in_pure_colors(shards(seed)), samples), 2, true);
}

TEST(Samples, AllShowWhatTheTwinShows) {
  for (const std::uint32_t samples : kAllSamples) {
    expect_same_samples(with_samples(in_pure_colors(crowd(160, 90, 3, 3)), samples), 3, true);
    expect_same_samples(with_samples(in_pure_colors(flight(100, 56, 2)), samples), 2, false);
    expect_same_samples(with_samples(in_pure_colors(ties(80, 60)), samples), 3, true);
  }
}

// A wall and a ground in fog so thick that a tenth of a pixel shows, still or moving: what is shaded is the group's
// sample nearest to the pixel's centre, on every edge of their triangles.
wire::FilmData steep(bool moving) {
  FilmMaker maker(120, 90, 2);
  const std::uint32_t box = maker.add_shape(modeler::make_box());
  const std::uint32_t white = maker.add_material({{1, 1, 1}, 1, 0, 0, 1, 2});
  const auto motion = [&](const wire::Matrix& matrix) {
    std::vector<wire::Matrix> out{matrix};
    if (moving) out.push_back(placed({matrix.m[0][3], matrix.m[1][3] + 0.013, matrix.m[2][3]}, matrix.m[2][2], 0.6));
    return out;
  };
  maker.add_segment(box, white, motion(placed({-2.2, 0, -1.5}, 3, 0.6)));
  maker.add_segment(box, white, motion(placed({0, -9, -21}, 20, 0.6)));
  maker.set_cameras({looking({0.3, -8, 0.4}, {0, 0, 0}, 50)});
  wire::FilmData film = maker.make();
  film.settings.background = {1, 1, 1};
  film.settings.fog = {{0, 0, 0}, 7.4f, 8};
  return film;
}

TEST(Samples, TheNearestOfAGroupIsShaded) {
  for (const std::uint32_t samples : kAllSamples)
    for (const bool moving : {false, true}) {
      const wire::FilmData film = with_samples(steep(moving), samples);
      const FilmBlock block(film);
      const FilmRun run = draw(film, 2);
      for (std::uint32_t frame = 0; frame < 2; ++frame) {
        const Reference reference = draw_reference(block.view(), frame);
        const Pixels expected = reference_pixels(reference, {block.view(), frame});
        const Pixels& pixels = run.frames.at(frame);
        int wrong = 0, in_fog = 0;
        for (std::size_t k = 0; k < pixels.size(); ++k) {
          const auto level = static_cast<int>(pixels[k] & 255);
          wrong += std::abs(level - static_cast<int>(expected[k] & 255)) > 1;
          in_fog += level > 0 && level < 255;
        }
        EXPECT_EQ(wrong, 0) << samples << " samples, frame " << frame << (moving ? ", moving" : "");
        EXPECT_GT(in_fog, 100);
      }
    }
}

// Moving parts are grouped apart from those that stand still. So if a film's intervals are cut elsewhere, a group may
// begin at another of its samples, at edges and nowhere else; how many samples show what stays the same.
TEST(Samples, WhereIntervalsAreCutOnlyEdgesMayDiffer) {
  const wire::FilmData whole = with_samples(crowd(160, 90, 4, 4), 4), cut = with_samples(crowd(160, 90, 4, 1), 4);
  expect_same(draw(in_pure_colors(whole), 3), draw(in_pure_colors(cut), 2), whole.settings, "pure-cuts");
  const FilmRun a = draw(richly_lit(whole), 3), b = draw(richly_lit(cut), 2);
  const FilmBlock block(whole);
  for (const auto& [number, pixels] : a.frames) {
    const Reference reference = draw_reference(block.view(), number);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      if (pixels[k] == b.frames.at(number)[k]) continue;
      const auto groups = reference.groups(static_cast<std::uint32_t>(k % 160), static_cast<std::uint32_t>(k / 160));
      EXPECT_GT(groups.size(), 1u) << "pixel " << k << ", frame " << number;
    }
  }
}

}  // namespace
}  // namespace mars::test
