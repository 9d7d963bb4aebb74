// The studio's end of a serving host: starts it (mars-threads, or mpirun with mars-host and mars-node), gives it the
// film and what views ask for, takes pictures. When the host dies it is started again, with growing pauses, and gets
// the film and every view's last scene again. All calls and callbacks are on the thread that runs the io_context.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/render/pictures/reading.h"
#include "node/wire/protocol.h"

namespace mars::studio {

// Of a view: where it differs from the picture sent before.
using SurfacePicture = pictures::Picture;

class RendererLink {
 public:
  struct Listener {
    std::function<void(SurfacePicture)> picture;
    std::function<void(std::uint32_t view, std::uint32_t picture)> dropped;
    // All nodes have the film: how many; views asked for before are drawn by themselves.
    std::function<void(std::uint32_t nodes, std::uint32_t machines)> ready;
    // "" while it works; else why no pictures come at the moment, in one line for a person.
    std::function<void(const std::string& trouble)> state;
  };

  virtual ~RendererLink() = default;

  virtual void set_film(std::shared_ptr<const std::vector<std::byte>> block) = 0;
  virtual void begin(std::uint32_t view, std::uint32_t picture, std::vector<std::byte> scene_block) = 0;
  virtual void draw(std::uint32_t view, std::uint32_t picture, std::span<const wire::MovedSegment> segments,
                    std::span<const wire::MovedPatch> patches) = 0;
  virtual void close(std::uint32_t view) = 0;
};

}  // namespace mars::studio
