// A film's frames, as Render commands ask for them: the keyframe of an interval together with the other nodes of the
// group, inbetweens alone. All buffers are made when the film is loaded.
#pragma once

#include "node/geometry/scene.h"
#include "node/renderer.h"
#include "node/canvas.h"
#include "node/wire/commands.h"

namespace mars::node {

class FilmFrames {
 public:
  // The film's block and `renderer` outlive it. Collective over a machine's nodes.
  FilmFrames(const wire::PackedFilm& film, const wire::Load& load, simd::InstructionSet set, Renderer& renderer);

  // From now on frames are written into files; else they go to the host.
  void write_files() { writes_ = true; }
  // Draws the caller's share of the frames (see Render) and sends it.
  void render(const wire::RenderCommand& command);

 private:
  void begin_interval(const wire::RenderCommand& command);
  void begin_still(const wire::RenderCommand& command);
  void draw_inbetweens(const wire::RenderCommand& command);

  Renderer& renderer_;
  Canvas canvas_;
  const geometry::ShapeBoxes boxes_;
  bool writes_ = false;
};

}  // namespace mars::node
