#include "host/programs/surface_frames.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "hal/threads/run_threads.h"
#include "host/images/picture_file.h"
#include "host/images/png_file.h"
#include "host/preview/viewpoint.h"
#include "host/programs/node_job.h"
#include "host/render/farm/farm.h"
#include "topology/machine.h"

namespace mars::programs {
class SurfaceFrames::Taker : public sinks::Sink {
 public:
  explicit Taker(SurfaceFrames& frames) : frames_(frames) {}

  void take(compositor::Frame& frame) override {
    std::vector<std::byte> bytes =
        images::encode_picture(images::PictureFormat::png, frame.width, frame.height, frame.pixels);
    const std::lock_guard lock(frames_.mutex_);
    frames_.taken_[frame.number] = std::move(bytes);
    frames_.changed_.notify_all();
  }

 private:
  SurfaceFrames& frames_;
};

void SurfaceFrames::aim(images::PictureSize extent, const std::optional<wire::Camera>& camera,
                        std::vector<std::uint32_t> frames) {
  stop();
  taken_.clear();
  failure_ = nullptr;
  cancellation_.emplace();
  const wire::Camera* by = camera ? &*camera : nullptr;
  renderer_ = std::thread(
      [this, film = preview::as_seen(film_, {extent.width, extent.height}, by), frames = std::move(frames)] {
        try {
          render(film, frames);
        } catch (...) {
          const std::lock_guard lock(mutex_);
          failure_ = std::current_exception();
          changed_.notify_all();
        }
      });
}

// A farm takes ascending frames: those from the middle of a film on, then those before.
void SurfaceFrames::render(const film::CompiledFilm& film, const std::vector<std::uint32_t>& frames) {
  const wire::FilmSettings& settings = film.view().settings();
  const auto processors = static_cast<std::uint32_t>(topology::Machine::here().processors());
  for (auto first = frames.begin(); first != frames.end() && !cancellation_->cancelled();) {
    const auto end = std::is_sorted_until(first, frames.end());
    const farm::Plan plan = farm::make_plan(film.view(), {{first, end}}, static_cast<int>(processors));
    farm::FarmOptions farm;
    farm.cancellation = &*cancellation_;
    Taker taker(*this);
    threads::run_threads(
        static_cast<int>(processors),
        [&] {
          sinks::SinkPool pool(taker, {settings.width, settings.height, 16, 4, 2});
          farm::render_film(film.block(), plan, farm, pool, {});
        },
        [=] { run_node_job(processors); });
    first = end;
  }
}

void SurfaceFrames::stop() {
  if (cancellation_) cancellation_->cancel();
  if (renderer_.joinable()) renderer_.join();
}

preview::SharedImage SurfaceFrames::frame(std::uint32_t number) {
  std::vector<std::byte> bytes;
  {
    const std::lock_guard lock(mutex_);
    const auto found = taken_.find(number);
    if (found == taken_.end() && failure_) std::rethrow_exception(failure_);
    if (found == taken_.end()) return nullptr;
    bytes = found->second;
  }
  return std::make_shared<const images::Image>(images::decode_png(bytes, "a rendered frame"));
}

preview::SharedImage SurfaceFrames::wait_for(std::uint32_t number) {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return taken_.contains(number) || failure_; });
  }
  return frame(number);
}

}  // namespace mars::programs
