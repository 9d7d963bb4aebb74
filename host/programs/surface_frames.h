// Rendered frames for the previewer: host and nodes as threads of this process, in the background.
#pragma once

#include <condition_variable>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "host/content/film/compile.h"
#include "host/preview/surface_source.h"
#include "host/render/farm/cancellation.h"

namespace mars::host {

class SurfaceFrames : public SurfaceSource {
 public:
  // `film` must outlive it.
  explicit SurfaceFrames(const CompiledFilm& film) : film_(film) {}
  ~SurfaceFrames() override { stop(); }

  void aim(PictureSize extent, const std::optional<node::Camera>& camera, std::vector<std::uint32_t> frames) override;
  SharedImage frame(std::uint32_t number) override;
  SharedImage wait_for(std::uint32_t number) override;

 private:
  class Taker;

  void stop();
  void render(const CompiledFilm& film, const std::vector<std::uint32_t>& frames);

  const CompiledFilm& film_;
  std::thread renderer_;
  std::optional<Cancellation> cancellation_;  // of the rendering at hand

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::map<std::uint32_t, std::vector<std::byte>> taken_;  // as PNG: a long film's pictures are many
  std::exception_ptr failure_;
};

}  // namespace mars::host
