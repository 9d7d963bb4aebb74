// Embree as a competitor: peer-embree MESH THREADS whole|inbetween SAMPLES SUN. How it was made fast: README.md.
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "tests/bench/peers/cover.h"
#include "tests/bench/peers/crew.h"
#include "tests/bench/peers/embree_painter.h"
#include "tests/bench/peers/embree_sun.h"
#include "tests/bench/peers/light.h"
#include "tests/bench/peers/mesh.h"
#include "tests/bench/peers/peer.h"

namespace mars::bench {
namespace {

class Renderer {
 public:
  Renderer(const Mesh& mesh, int threads, bool inbetweens, std::uint32_t samples, std::optional<float> sun);

  void render();
  Cost measure_ray();
  Picture picture() const { return {mesh_.head.width, mesh_.head.height, canvas_.frame}; }
  std::string note() const { return note_; }

 private:
  enum class Task { whole, keep, inbetween };

  void load(int threads);
  void draw_tiles(Task task);
  void work();
  void draw(std::size_t number);
  void draw_inbetween(std::size_t number);
  void mark_outlines(View& view, const Motion& motion) const;
  void mark(const Area& pixels, std::vector<std::uint8_t>& tiles) const;
  void mark_changes(const Motion& motion);

  const Mesh& mesh_;
  bool inbetweens_;
  std::uint32_t number_;  // of the last frame rendered; inbetweens are all but 0
  int threads_;
  Canvas canvas_;
  std::unique_ptr<Painter> painter_;
  std::string note_;
  std::vector<std::uint32_t> kept_;  // what stands, as it shows
  int columns_;                      // of tiles
  std::vector<Area> tiles_;          // row by row
  std::optional<ShadedAreas> shaded_areas_;
  std::vector<std::uint8_t> shaded_;   // the tiles on which the mover's shadow may fall
  std::vector<std::uint8_t> changed_;  // those that differed from what stands in the frame before
  Task task_ = Task::whole;
  std::atomic<std::size_t> next_tile_{0};
  std::atomic<std::uint64_t> rays_{0};  // to the sun, so far
  std::unique_ptr<Crew> crew_;
};

Renderer::Renderer(const Mesh& mesh, int threads, bool inbetweens, std::uint32_t samples, std::optional<float> sun)
    : mesh_(mesh),
      inbetweens_(inbetweens),
      number_(mesh.head.frames - 1),
      threads_(threads),
      canvas_{mesh, {}, {}, sun, std::vector<std::uint32_t>(mesh.head.width * std::size_t{mesh.head.height})},
      painter_(samples == 1 ? make_pixel_painter(canvas_, inbetweens)
                            : make_sample_painter(canvas_, inbetweens, shape::sample_pattern(samples))) {
  load(threads);
  const int width = static_cast<int>(mesh.head.width), height = static_cast<int>(mesh.head.height);
  for (int top = 0; top < height; top += kTile)
    for (int left = 0; left < width; left += kTile)
      tiles_.push_back({left, top, std::min(left + kTile, width), std::min(top + kTile, height)});
  columns_ = (width + kTile - 1) / kTile;
  changed_.resize(tiles_.size());
  canvas_.mover.tiles.resize(tiles_.size());
  shaded_.resize(tiles_.size());
  crew_ = std::make_unique<Crew>(threads, [this] { work(); });
  if (!inbetweens) return;
  if (sun) shaded_areas_.emplace(mesh, *sun);
  mark_outlines(canvas_.standing, kStill);
  draw_tiles(Task::keep);
  kept_ = canvas_.frame;
}

void Renderer::load(int threads) {
  const std::string config = "threads=" + std::to_string(threads);
  RTCDevice device = rtcNewDevice(config.c_str());
  const auto start = std::chrono::steady_clock::now();
  canvas_.standing = view_of(mesh_, false, device);
  canvas_.mover = view_of(mesh_, true, device);
  std::ostringstream note;
  note << "Embree " << rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION) << ", tree built in "
       << milliseconds_since(start) << " ms";
  note_ = note.str();
}

void Renderer::draw_tiles(Task task) {
  task_ = task;
  next_tile_ = 0;
  crew_->run();
}

void Renderer::mark(const Area& pixels, std::vector<std::uint8_t>& tiles) const {
  for (int row = pixels.top / kTile; row * kTile < pixels.bottom; ++row)
    for (int column = pixels.left / kTile; column * kTile < pixels.right; ++column)
      tiles[static_cast<std::size_t>(row * columns_ + column)] = 1;
}

void Renderer::mark_outlines(View& view, const Motion& motion) const {
  view.tiles.assign(tiles_.size(), 0);
  for (const Outline& outline : view.outlines) mark(cover(outline, mesh_.head, motion), view.tiles);
}

void Renderer::mark_changes(const Motion& motion) {
  shaded_.assign(tiles_.size(), 0);
  if (shaded_areas_)
    for (const Area& area : shaded_areas_->of(motion)) mark(area, shaded_);
}

void Renderer::render() {
  number_ = (number_ + 1) % mesh_.head.frames;
  if (inbetweens_ && number_ == 0) number_ = 1;
  if (View& mover = canvas_.mover; !mover.empty()) {
    const Motion& motion = mesh_.motion[number_];
    set_motion(mover, mesh_.head, motion);
    mark_outlines(mover, motion);
    mark_changes(motion);
  }
  if (!inbetweens_) mark_outlines(canvas_.standing, kStill);
  draw_tiles(inbetweens_ ? Task::inbetween : Task::whole);
}

// The same frames with and without tracing, in turn.
Cost Renderer::measure_ray() {
  constexpr int kRounds = 15;
  double least[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  std::uint64_t rays = 0;
  for (int round = 0; round < kRounds; ++round)
    for (const bool traces : {false, true}) {
      number_ = 0;
      painter_->set_tracing(traces);
      rays_ = 0;
      const auto start = std::chrono::steady_clock::now();
      render();
      least[traces] = std::min(least[traces], milliseconds_since(start));
      rays = rays_;
    }
  return {"a shadow ray", "ns of a processor", 1e6 * threads_ * (least[1] - least[0]) / static_cast<double>(rays),
          std::to_string(rays) + " rays a frame"};
}

void Renderer::work() {
  for (std::size_t k; (k = next_tile_.fetch_add(1, std::memory_order_relaxed)) < tiles_.size();) draw(k);
  rays_ += take_rays_traced();
}

void Renderer::draw(std::size_t number) {
  const Area& tile = tiles_[number];
  if (task_ == Task::inbetween) return draw_inbetween(number);
  const bool standing_here = canvas_.standing.tiles[number] == 1;
  if (task_ == Task::keep)
    painter_->keep(tile, standing_here);
  else
    painter_->draw(tile, {standing_here, canvas_.mover.tiles[number] == 1});
}

void Renderer::draw_inbetween(std::size_t number) {
  const Area& tile = tiles_[number];
  const Changes here{canvas_.mover.tiles[number] == 1, shaded_[number] == 1};
  const bool changes = here.mover || here.shadow;
  if (!changes && changed_[number] == 0) return;
  changed_[number] = changes ? 1 : 0;
  for (int line = tile.top; line < tile.bottom; ++line) {
    const std::size_t row = std::size_t(line) * mesh_.head.width;
    std::copy(&kept_[row + tile.left], &kept_[row] + tile.right, &canvas_.frame[row + tile.left]);
  }
  if (changes) painter_->draw_changes(tile, here);
}

void run(int argc, char** argv) {
  if (argc != 6) throw std::runtime_error("usage: peer-embree MESH THREADS whole|inbetween SAMPLES SUN");
  const Mesh mesh = read_mesh(argv[1]);
  Renderer renderer(mesh, std::stoi(argv[2]), std::string_view(argv[3]) == "inbetween",
                    static_cast<std::uint32_t>(std::stoul(argv[4])), sun_of(argv[5]));
  obey({renderer.note(), [&] { renderer.render(); }, [&] { return renderer.picture(); },
        [&] { return renderer.measure_ray(); }});
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  return mars::bench::main_of("peer-embree", [&] { mars::bench::run(argc, argv); });
}
