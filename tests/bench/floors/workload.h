// A measuring scene as far as the scanline step: what a node's own dicing, set-up and fill make of a film's first
// frame, and what drawing leaves in every line. The same for every instruction set.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "hal/messages/private_memory.h"
#include "host/content/film/compile.h"
#include "node/geometry/scene.h"
#include "node/raster/arena.h"
#include "node/raster/scanline.h"
#include "node/shape/dice.h"
#include "tests/bench/floors/bare.h"

namespace mars::bench {

class Workload {
 public:
  // Throws Failure where the film cannot be read.
  explicit Workload(const std::filesystem::path& film, const film::CompileOptions& options = {});

  // The steps again: patches to vertices; these to triangles and edge boxes; those into their lines. `visit` sees each
  // diced patch.
  void dice(shape::Dicer& dicer, const std::function<void(const shape::Surface&)>& visit = nullptr);
  void make(simd::InstructionSet set);
  void fill();

  const wire::WorkCounts& counts() const { return counts_; }  // vertices; triangles that touch a sample
  std::uint64_t classified() const { return classified_; }    // triangles of all diced patches
  const shading::Shading& shading() const { return shading_; }
  std::span<const wire::Material> materials() const { return view_.materials(); }
  const raster::LineBoxes& boxes() const { return boxes_; }
  const std::vector<raster::LineLoad>& line_loads() const { return line_loads_; }
  std::uint32_t width() const { return static_cast<std::uint32_t>(scene_.width()); }
  std::uint32_t height() const { return static_cast<std::uint32_t>(scene_.height()); }
  // The visible stretches of one triangle each, line by line.
  const std::vector<Piece>& pieces() const { return pieces_; }
  std::uint64_t pixels() const { return pixels_; }

 private:
  void find_pieces();

  film::CompiledFilm film_;
  wire::PackedFilm view_;
  geometry::Scene scene_;
  messages::PrivateMemory made_memory_, filled_memory_;
  raster::Arena made_, filled_;
  std::vector<raster::LineLoad> line_loads_;
  std::vector<std::uint64_t> ebc_;
  std::vector<std::uint8_t> wanted_;
  raster::Polygons polygons_{};
  raster::LineBoxes boxes_{};
  shading::Shading shading_{};
  wire::WorkCounts counts_{};
  std::uint64_t classified_ = 0;
  std::vector<Piece> pieces_;
  std::uint64_t pixels_ = 0;
};

}  // namespace mars::bench
