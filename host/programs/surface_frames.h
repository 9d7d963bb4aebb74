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

namespace mars::programs {

class SurfaceFrames : public preview::SurfaceSource {
 public:
  // `film` must outlive it.
  explicit SurfaceFrames(const film::CompiledFilm& film) : film_(film) {}
  explicit SurfaceFrames(const film::CompiledFilm&&) = delete;
  ~SurfaceFrames() override { stop(); }

  void aim(images::PictureSize extent, const std::optional<wire::Camera>& camera,
           std::vector<std::uint32_t> frames) override;
  preview::SharedImage frame(std::uint32_t number) override;
  preview::SharedImage wait_for(std::uint32_t number) override;

 private:
  class Taker;

  void stop();
  void render(const film::CompiledFilm& film, const std::vector<std::uint32_t>& frames);

  const film::CompiledFilm& film_;
  std::thread renderer_;
  std::optional<farm::Cancellation> cancellation_;  // of the rendering at hand

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::map<std::uint32_t, std::vector<std::byte>> taken_;  // as PNG: a long film's pictures are many
  std::exception_ptr failure_;
};

}  // namespace mars::programs
