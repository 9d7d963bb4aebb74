#include "node/film_frames.h"

#include <algorithm>

#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"

namespace mars::node {

FilmFrames::FilmFrames(const wire::PackedFilm& film, const wire::Load& load, simd::InstructionSet set,
                       Renderer& renderer)
    : renderer_(renderer),
      canvas_(film, renderer.neighbours(), {load.still_memory, load.shadow_memory}, set,
              wire::layers_of(load.pixel_format) != 0),
      boxes_(film) {}

void FilmFrames::render(const wire::RenderCommand& command) {
  const wire::Render& render = command.render;
  messages::keep_to(render.group_first, render.group_count);
  if (render.goes_on == 0) {
    begin_interval(command);
    const std::uint32_t frame = command.frames.front();
    canvas_.scene.set_frame(frame);
    renderer_.draw(canvas_, {wire::FrameKind::keyframe,
                             frame,
                             render.interval,
                             {render.group_first, render.group_count},
                             render.contributors,
                             writes_,
                             {},
                             &boxes_});
  }
  draw_inbetweens(command);
  messages::keep_to_nobody();
}

// Inbetweens that are left may come to any node.
void FilmFrames::begin_interval(const wire::RenderCommand& command) {
  canvas_.scene.set_interval(command.render.interval);
  renderer_.join(wire::own_team(static_cast<int>(mynode()), command.group(), command.render.teams));
  begin_still(command);
  std::ranges::fill(canvas_.contributes, static_cast<std::uint8_t>(command.left().empty() ? 0 : 1));
  for (std::size_t k = 0; k < command.inbetweens().size(); ++k) {
    const collectives::Group team = command.team(k);
    std::fill_n(canvas_.contributes.begin() + (team.first - command.render.group_first), team.count, std::uint8_t{1});
  }
}

// The keyframe keeps what inbetweens may change. Where shadows of moving parts may be, homes of lines mark when they
// see what stands still.
void FilmFrames::begin_still(const wire::RenderCommand& command) {
  raster::StillMarks& marks = canvas_.still.marks();
  marks.clear();
  const auto frames = command.frames.size() > 1 ? command.frames : std::span<const std::uint32_t>();
  canvas_.sweep.begin(canvas_.scene, frames, boxes_,
                      [&](const geometry::PictureBounds& bounds) { marks.mark(bounds.lines, bounds.columns); });
  canvas_.still.begin_interval(command.frames.front(), canvas_.sweep.lines());
}

void FilmFrames::draw_inbetweens(const wire::RenderCommand& command) {
  const auto inbetweens = command.inbetweens();
  const int self = static_cast<int>(mynode());
  for (std::size_t k = 0; k < inbetweens.size() && !renderer_.outbox().stopped(); ++k) {
    const collectives::Group team = command.team(k);
    if (self < team.first || self >= team.first + team.count) continue;
    canvas_.scene.set_frame(inbetweens[k]);
    renderer_.draw(canvas_, {wire::FrameKind::inbetween,
                             inbetweens[k],
                             command.render.interval,
                             {self, 1},
                             1,
                             writes_,
                             {team, command.writer(k)},
                             &boxes_});
  }
}

}  // namespace mars::node
