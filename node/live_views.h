// The views that a studio's host asks for (protocol.h), each of a scene of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "node/renderer.h"
#include "node/canvas.h"
#include "node/wire/commands.h"
#include "node/wire/scene.h"

namespace mars::node {

class LiveViews {
 public:
  // Whether what was asked for of a view is wanted no more.
  using HasEnded = std::function<bool(std::uint32_t view)>;

  // The film's block and `renderer` outlive it.
  LiveViews(const wire::PackedFilm& film, simd::InstructionSet set, Renderer& renderer, HasEnded has_ended);

  // Each executes a command of this kind.
  void begin(std::span<const std::byte> begin_command);
  void draw(std::span<const std::byte> draw_command);
  void close(std::span<const std::byte> close_command);

 private:
  // A view's scene: the node's own copy of the block, with the patches that the current Draw names.
  class LiveScene {
   public:
    LiveScene(std::span<const std::byte> block, const wire::PackedFilm& base);

    const wire::PackedFilm& film() const { return film_; }
    const wire::MovingParts& moving() const { return moving_; }
    // Those that an earlier call changed and this one does not name are again as in the block.
    void put(std::span<const wire::MovedPatch> patches);

   private:
    wire::Patch& patch(std::uint32_t number);

    std::vector<std::uint64_t> block_;
    wire::PackedFilm film_;
    wire::MovingParts moving_;
    std::vector<wire::MovedPatch> replaced_;  // the block's, the latest last
  };

  struct LiveView {
    LiveScene scene;
    Canvas::Memory memory;
    Canvas canvas;
  };

  LiveView& put_scene(const wire::BeginViewCommand& command);
  void draw_picture(LiveView& live, const Frame& frame);

  wire::PackedFilm film_;
  simd::InstructionSet instruction_set_;
  Renderer& renderer_;
  HasEnded has_ended_;
  std::map<std::uint32_t, LiveView> views_;
};

}  // namespace mars::node
