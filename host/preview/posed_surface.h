// Rendered frames of a film, or of the pose under way in the one frame that is asked for.
#pragma once

#include <functional>
#include <memory>

#include "host/preview/load.h"
#include "host/preview/pose_under_way.h"
#include "host/preview/surface_source.h"

namespace mars::preview {

using MakeSurface = std::function<std::unique_ptr<SurfaceSource>(const film::CompiledFilm&)>;

class PosedSurface : public SurfaceSource {
 public:
  // All must outlive it. A pose that is not empty belongs to a film that has a source.
  PosedSurface(Previewed& film, const PoseUnderWay& pose, const MakeSurface& make_surface);
  PosedSurface(auto&&, const PoseUnderWay&&, auto&&...) = delete;
  PosedSurface(auto&&, auto&&, const MakeSurface&&) = delete;

  void aim(images::PictureSize extent, const std::optional<wire::Camera>& camera,
           std::vector<std::uint32_t> frames) override;
  SharedImage frame(std::uint32_t number) override;
  SharedImage wait_for(std::uint32_t number) override { return film_frames_->wait_for(number); }

 private:
  // What the moment shows.
  struct Shown {
    std::uint64_t pose;
    std::uint32_t frame;

    bool operator==(const Shown&) const = default;
  };

  void render(const Shown& wanted);

  Previewed& film_;
  const PoseUnderWay& pose_;
  const MakeSurface& make_surface_;
  std::unique_ptr<SurfaceSource> film_frames_;
  images::PictureSize extent_{0, 0};
  std::optional<wire::Camera> camera_;
  std::optional<Shown> shown_;
  std::unique_ptr<film::CompiledFilm> moment_;
  std::unique_ptr<SurfaceSource> moment_frame_;
};

}  // namespace mars::preview
