// Embree as a competitor: peer-embree MESH THREADS whole|inbetween SAMPLES. How it was made fast: README.md.
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "tests/bench/peers/cover.h"
#include "tests/bench/peers/crew.h"
#include "tests/bench/peers/embree_painter.h"
#include "tests/bench/peers/mesh.h"
#include "tests/bench/peers/peer.h"

namespace mars::bench {
namespace {

constexpr Motion kStill{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

class Renderer {
 public:
  Renderer(const Mesh& mesh, int threads, bool inbetweens, std::uint32_t samples);

  void render();
  Picture picture() const { return {mesh_.head.width, mesh_.head.height, canvas_.frame}; }
  std::string note() const { return note_; }

 private:
  enum class Task { whole, keep, inbetween };

  void load(int threads);
  void draw_tiles(Task task);
  void work();
  void draw(std::size_t number);
  void draw_inbetween(std::size_t number);
  void mark_tiles(View& view, const Motion& motion) const;

  const Mesh& mesh_;
  bool inbetweens_;
  std::uint32_t number_;  // of the last frame rendered; inbetweens are all but 0
  Canvas canvas_;
  std::unique_ptr<Painter> painter_;
  std::string note_;
  std::vector<std::uint32_t> kept_;   // what stands, as it shows
  int columns_;                       // of tiles
  std::vector<Area> tiles_;           // row by row
  std::vector<std::uint8_t> before_;  // the mover's tiles in the frame before
  Task task_ = Task::whole;
  std::atomic<std::size_t> next_tile_{0};
  std::unique_ptr<Crew> crew_;
};

Renderer::Renderer(const Mesh& mesh, int threads, bool inbetweens, std::uint32_t samples)
    : mesh_(mesh),
      inbetweens_(inbetweens),
      number_(mesh.head.frames - 1),
      canvas_{mesh, {}, {}, std::vector<std::uint32_t>(mesh.head.width * std::size_t{mesh.head.height})},
      painter_(samples == 1 ? make_pixel_painter(canvas_, inbetweens)
                            : make_sample_painter(canvas_, inbetweens, shape::sample_pattern(samples))) {
  load(threads);
  const int width = static_cast<int>(mesh.head.width), height = static_cast<int>(mesh.head.height);
  for (int top = 0; top < height; top += kTile)
    for (int left = 0; left < width; left += kTile)
      tiles_.push_back({left, top, std::min(left + kTile, width), std::min(top + kTile, height)});
  columns_ = (width + kTile - 1) / kTile;
  before_.resize(tiles_.size());
  canvas_.mover.tiles.resize(tiles_.size());
  crew_ = std::make_unique<Crew>(threads, [this] { work(); });
  if (!inbetweens) return;
  mark_tiles(canvas_.standing, kStill);
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

void Renderer::mark_tiles(View& view, const Motion& motion) const {
  view.tiles.assign(tiles_.size(), 0);
  for (const Outline& outline : view.outlines) {
    const Area pixels = cover(outline, mesh_.head, motion);
    for (int row = pixels.top / kTile; row * kTile < pixels.bottom; ++row)
      for (int column = pixels.left / kTile; column * kTile < pixels.right; ++column)
        view.tiles[static_cast<std::size_t>(row * columns_ + column)] = 1;
  }
}

void Renderer::render() {
  number_ = (number_ + 1) % mesh_.head.frames;
  if (inbetweens_ && number_ == 0) number_ = 1;
  if (View& mover = canvas_.mover; !mover.empty()) {
    const Motion& motion = mesh_.motion[number_];
    set_motion(mover, mesh_.head, motion);
    before_ = mover.tiles;
    mark_tiles(mover, motion);
  }
  if (!inbetweens_) mark_tiles(canvas_.standing, kStill);
  draw_tiles(inbetweens_ ? Task::inbetween : Task::whole);
}

void Renderer::work() {
  for (std::size_t k; (k = next_tile_.fetch_add(1, std::memory_order_relaxed)) < tiles_.size();) draw(k);
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
  const bool mover_here = canvas_.mover.tiles[number] == 1;
  if (!mover_here && before_[number] == 0) return;
  for (int line = tile.top; line < tile.bottom; ++line) {
    const std::size_t row = std::size_t(line) * mesh_.head.width;
    std::copy(&kept_[row + tile.left], &kept_[row] + tile.right, &canvas_.frame[row + tile.left]);
  }
  if (mover_here) painter_->draw_mover(tile);
}

void run(int argc, char** argv) {
  if (argc != 5) throw std::runtime_error("usage: peer-embree MESH THREADS whole|inbetween SAMPLES");
  const Mesh mesh = read_mesh(argv[1]);
  Renderer renderer(mesh, std::stoi(argv[2]), std::string_view(argv[3]) == "inbetween",
                    static_cast<std::uint32_t>(std::stoul(argv[4])));
  obey({renderer.note(), [&] { renderer.render(); }, [&] { return renderer.picture(); }});
}

}  // namespace
}  // namespace mars::bench

int main(int argc, char** argv) {
  return mars::bench::main_of("peer-embree", [&] { mars::bench::run(argc, argv); });
}
