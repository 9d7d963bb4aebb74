// Renders a compiled film on the threads backend into memory, for tests that compare pictures.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hal/threads/run_threads.h"
#include "host/render/farm/farm.h"
#include "node/wire/film.h"
#include "node/wire/pixel_format.h"

namespace mars::test {

using Pixels = std::vector<std::uint32_t>;  // words: one or two a pixel, by RunOptions::format

struct RunOptions {
  int nodes = 1;
  farm::PlanRequest work;  // no frames: all of the film
  farm::FarmOptions farm;
  std::uint32_t block = 16;
  wire::PixelFormat format = wire::PixelFormat::rgb8;
  std::string simd;                  // "" for the widest
  std::uint64_t memory = 256 << 20;  // bytes a node offers
  threads::WrapBackend wrap;
  // Makes the pool of sinks; none: a thread takes frames.
  std::function<std::unique_ptr<sinks::SinkPool>(sinks::Sink& sink, const sinks::SinkPool::Shape& shape)> make_sinks;
  std::function<void()> around_node;  // called on each node's thread before it runs
};

struct FilmRun {
  std::map<std::uint32_t, Pixels> frames;
  farm::FarmReport report;
};

// The packed film, aligned as PackedFilm wants it.
class FilmBlock {
 public:
  explicit FilmBlock(const wire::FilmData& film);
  std::span<const std::byte> bytes() const { return {reinterpret_cast<const std::byte*>(words_.data()), size_}; }
  wire::PackedFilm view() const { return {bytes(), "test film"}; }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t size_;
};

FilmRun run_film(std::span<const std::byte> film, const RunOptions& options = {});
// The parts of the host and of each node, in a job of any transport.
FilmRun render_as_host(std::span<const std::byte> film, const RunOptions& options);
void run_as_node(const RunOptions& options);

// Drawn in all of them.
std::uint64_t edge_boxes_of_inbetweens(const FilmRun& run);

// EXPECTs at least one frame, and equal pictures for equal frames; where they differ writes both and their difference
// as PNG files into the working directory, named after `name`.
void expect_same(const FilmRun& rendered, const FilmRun& expected, const wire::FilmSettings& settings,
                 const std::string& name);

}  // namespace mars::test
