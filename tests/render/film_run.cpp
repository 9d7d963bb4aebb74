#include "tests/render/film_run.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <mutex>
#include <numeric>
#include <utility>

#include "host/images/picture_file.h"
#include "host/render/sinks/sink_pool.h"
#include "node/firmware.h"

namespace mars::test {
namespace {

// Stores every frame.
class MemorySink : public sinks::Sink {
 public:
  void take(compositor::Frame& frame) override {
    const std::lock_guard lock(mutex_);
    frames_[frame.number] = frame.pixels;
  }
  std::map<std::uint32_t, Pixels> release() { return std::move(frames_); }

 private:
  std::mutex mutex_;
  std::map<std::uint32_t, Pixels> frames_;
};

void write_png(const std::string& path, const wire::FilmSettings& settings, const Pixels& pixels) {
  const bool two_words = pixels.size() > std::size_t{settings.width} * settings.height;
  const auto format = two_words ? images::PictureFormat::png16 : images::PictureFormat::png;
  const auto bytes = images::encode_picture(format, settings.width, settings.height, pixels);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

Pixels difference(const Pixels& a, const Pixels& b) {
  Pixels out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] == b[i] ? 0 : 0xffffff;
  return out;
}

}  // namespace

FilmBlock::FilmBlock(const wire::FilmData& film) {
  const auto packed = wire::pack(film);
  size_ = packed.size();
  words_.resize((size_ + 7) / 8);
  std::memcpy(words_.data(), packed.data(), size_);
}

FilmRun render_as_host(std::span<const std::byte> film, const RunOptions& options) {
  const wire::PackedFilm view(film, "test film");
  const wire::FilmSettings& settings = view.settings();
  farm::FarmOptions farm = options.farm;
  farm.each_frame = true;
  farm::PlanRequest work = options.work;
  if (work.frames.empty()) {
    work.frames.resize(settings.frames);
    std::iota(work.frames.begin(), work.frames.end(), 0u);
  }
  const farm::Plan plan = farm::make_plan(view, work, options.nodes);
  MemorySink sink;
  FilmRun run;
  {
    const sinks::SinkPool::Shape shape{settings.width, settings.height, options.block, 3, 1, 0, options.format};
    const auto pool =
        options.make_sinks ? options.make_sinks(sink, shape) : std::make_unique<sinks::SinkPool>(sink, shape);
    run.report = farm::render_film(film, plan, farm, *pool, {});
  }
  run.frames = sink.release();
  return run;
}

void run_as_node(const RunOptions& options) {
  if (options.around_node) options.around_node();
  node::run_node({"test", "", {}, options.memory, options.simd});
}

FilmRun run_film(std::span<const std::byte> film, const RunOptions& options) {
  FilmRun run;
  threads::run_threads(
      options.nodes, [&] { run = render_as_host(film, options); }, [&] { run_as_node(options); }, options.wrap);
  return run;
}

std::uint64_t edge_boxes_of_inbetweens(const FilmRun& run) {
  std::uint64_t count = 0;
  for (const wire::Strip& strip : run.report.strips)
    if (strip.kind == wire::FrameKind::inbetween) count += strip.work.edge_boxes;
  return count;
}

void expect_same(const FilmRun& rendered, const FilmRun& expected, const wire::FilmSettings& settings,
                 const std::string& name) {
  EXPECT_FALSE(rendered.frames.empty()) << name << ": nothing was rendered";
  for (const auto& [number, pixels] : rendered.frames) {
    const auto twin = expected.frames.find(number);
    ASSERT_NE(twin, expected.frames.end()) << name << ": frame " << number;
    if (pixels == twin->second) continue;
    const std::string stem = name + "-" + std::to_string(number);
    write_png(stem + "-rendered.png", settings, pixels);
    write_png(stem + "-expected.png", settings, twin->second);
    write_png(stem + "-difference.png", settings, difference(pixels, twin->second));
    ADD_FAILURE() << name << ": frame " << number << " differs; see " << stem << "-*.png";
    return;
  }
}

}  // namespace mars::test
