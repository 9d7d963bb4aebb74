#include "node/renderer.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "node/group/mapping.h"

namespace mars::node {

Renderer::Renderer(const wire::FilmView& film, const wire::Load& load, std::span<const std::int32_t> machines,
                   simd::InstructionSet set)
    : scene_(film),
      mapping_(load.mapping),
      tessellator_(set),
      arena_(load.memory),
      z_buffer_(set, scene_.width()),
      czb_(machines, load.groups, scene_.width(), scene_.height()),
      sums_(film.settings().height, machines.size()),
      triangle_exchange_(static_cast<int>(numnodes()), film.settings().height),
      depth_exchange_(static_cast<int>(numnodes())),
      outbox_(film.settings().width, load.credits),
      contributes_(machines.size()),
      line_loads_(film.settings().height),
      wanted_lines_(film.settings().height),
      homes_(machines.size()),
      pass_homes_(machines.size()) {
  if (load.traced == 1) tracer_.emplace();
}

void Renderer::render(const wire::Render& command, std::span<const std::uint32_t> frames) {
  const auto inbetweens = frames.subspan(1);
  begin_interval(command, inbetweens);
  draw_frame(wire::FrameKind::keyframe, command.interval, frames.front(), {command.group_first, command.group_count});
  const int self = static_cast<int>(mynode());
  for (std::size_t k = 0; k < inbetweens.size() && !outbox_.stopped(); ++k)
    if (command.group_first + wire::contributor_of_inbetween(command.first_inbetween + k, command.group_count) == self)
      draw_frame(wire::FrameKind::inbetween, command.interval, inbetweens[k], {self, 1});
}

void Renderer::send_trace() {
  if (tracer_) tracer_->send();
}

void Renderer::finish() {
  outbox_.flush();
  if (tracer_) tracer_->finish();
}

void Renderer::begin_interval(const wire::Render& command, std::span<const std::uint32_t> inbetweens) {
  scene_.set_interval(command.interval);
  moving_line_bounds_ = scene_.moving_line_bounds(inbetweens);
  std::ranges::fill(contributes_, std::uint8_t{0});
  for (std::size_t k = 0; k < inbetweens.size(); ++k)
    contributes_[static_cast<std::size_t>(
        wire::contributor_of_inbetween(command.first_inbetween + k, command.group_count))] = 1;
}

// The thesis's four steps: triangles, homes for the scanlines, triangles to their homes, scanlines. An inbetween takes
// them with moving parts only, by one node, which is the home of all lines.
void Renderer::draw_frame(wire::FrameKind kind, std::uint32_t interval, std::uint32_t frame,
                          const collectives::Group& group) {
  group_ = group;
  report_.begin(kind, frame, interval);
  scene_.set_frame(frame);
  Tessellation own = tessellate_all();
  group::Pass pass{0, map_to_homes(own.made)};
  for (; pass.number < pass.count; ++pass.number) {
    if (pass.count > 1) own = tessellate_part(pass);
    const raster::LineBoxes boxes = exchange_triangles(own.polygons, pass);
    draw_lines(boxes, own.polygons.triangles, pass);
    if (!pass.is_last()) send_trace();
  }
  report_.end();
  send_trace();
}

// Every line is wanted, so that all edge boxes are counted.
Tessellation Renderer::tessellate_all() {
  arena_.clear();
  arena_.reset_peak();
  std::ranges::fill(wanted_lines_, std::uint8_t{1});
  const Tessellation own = tessellate();
  report_.strip().work.triangles = own.made.triangles;
  report_.strip().work.edge_boxes_diced = own.made.edge_boxes;
  return own;
}

// The triangles of the pass's lines, made again.
Tessellation Renderer::tessellate_part(const group::Pass& pass) {
  arena_.clear();
  group::mark_lines(homes(), pass, wanted_lines_);
  const Tessellation own = tessellate();
  check(own.all_stored, "a pass's triangles fit the memory planned for it");
  return own;
}

Tessellation Renderer::tessellate() {
  const Scatter scatter{static_cast<std::uint32_t>(member()), static_cast<std::uint32_t>(group_.count)};
  const Tessellation own = tessellator_.tessellate(scene_, report_.strip().kind, scatter, {wanted_lines_, line_loads_},
                                                   arena_, report_.strip().work);
  report_.clock(wire::Phase::dice);
  return own;
}

std::uint32_t Renderer::map_to_homes(const group::MadeCounts& made) {
  sums_.add_up(group_, {line_loads_, made.edge_boxes, group::own_bytes(made, group_)});
  report_.strip().edge_box_total = sums_.ebc().back();
  report_.clock(wire::Phase::sum);
  const auto weights = sums_.weights(mapping_);
  group::map_lines(mapping_, weights, homes());
  report_.strip().load_ratio = group::load_ratio(weights, homes());
  report_.strip().work.samples = sums_.samples_on(homes()[member()]);
  const std::uint32_t passes = group::agree_on_passes(
      {group_, sums_.ebc(), homes(), sums_.own_bytes(), line_loads_, made.triangles}, arena_.size());
  report_.strip().work.passes = passes;
  report_.clock(wire::Phase::map);
  return passes;
}

// Edge boxes of all nodes on the caller's lines. While others' are on their way, the own ones are put into their lines.
raster::LineBoxes Renderer::exchange_triangles(const raster::Polygons& own, const group::Pass& pass) {
  const auto homes_now = std::span(pass_homes_).first(homes().size());
  std::ranges::transform(homes(), homes_now.begin(),
                         [&](const geometry::LineRange& home) { return group::part_of(home, pass); });
  triangle_exchange_.send_triangles(group_, own, homes_now, line_loads_, arena_);
  report_.clock(wire::Phase::exchange);
  raster::LineFiller filler(homes_now[member()], sums_.ebc(), own.triangles, arena_);
  filler.add(own);
  report_.clock(wire::Phase::fill);
  for (int number = 1; number < group_.count; ++number) {
    const raster::Polygons others = triangle_exchange_.receive_triangles(group_, number, arena_);
    report_.clock(wire::Phase::exchange);
    filler.add(others);
    report_.clock(wire::Phase::fill);
  }
  const raster::LineBoxes boxes = filler.finish();
  report_.strip().work.edge_boxes += boxes.boxes.size();
  return boxes;
}

void Renderer::draw_lines(const raster::LineBoxes& boxes, const geometry::Triangle* triangles,
                          const group::Pass& pass) {
  const shading::Shading shading = shading_for(triangles);
  const bool constant = boxes.any_stationary();
  geometry::LineRange strip{boxes.lines.first, boxes.lines.first};
  do {
    raster::StripBuffer& buffer = outbox_.begin(constant);
    report_.clock(wire::Phase::credit);
    strip = {strip.last, draw_strip(boxes, strip.last, shading, buffer)};
    report_.clock(wire::Phase::scanline);
    const bool drawn = strip.last == boxes.lines.last;
    if (drawn) finish_exchange(pass);
    send_strip(strip, drawn && pass.is_last());
  } while (strip.last < boxes.lines.last);
}

std::uint32_t Renderer::draw_strip(const raster::LineBoxes& boxes, std::uint32_t first, const shading::Shading& shading,
                                   raster::StripBuffer& out) {
  std::uint32_t line = first;
  while (line < boxes.lines.last && out.lines_that_fit() > 0) {
    const geometry::LineRange part{line, std::min(line + out.lines_that_fit(), boxes.lines.last)};
    if (report_.is_keyframe())
      z_buffer_.draw_keyframe(boxes, part, shading, moving_line_bounds_, czb_, out);
    else
      z_buffer_.draw_inbetween(boxes, part, shading, moving_line_bounds_, czb_, out);
    line = part.last;
  }
  return line;
}

void Renderer::finish_exchange(const group::Pass& pass) {
  triangle_exchange_.finish();
  report_.clock(wire::Phase::exchange);
  if (!pass.is_last() || !report_.is_keyframe() || group_.count == 1) return;
  depth_exchange_.complete({group_, homes(), moving_line_bounds_, contributes_}, czb_);
  report_.clock(wire::Phase::depth);
}

void Renderer::send_strip(const geometry::LineRange& lines, bool last) {
  report_.set_strip(lines, last, arena_.peak());
  outbox_.send(report_.strip());
  ++report_.strip().number;
  report_.skip_clock();  // send() has counted its own wait
}

std::size_t Renderer::member() const { return static_cast<std::size_t>(mynode() - group_.first); }

shading::Shading Renderer::shading_for(const geometry::Triangle* triangles) const {
  return {triangles, scene_.film().materials().data(), scene_.lights().data(),
          static_cast<std::uint32_t>(scene_.lights().size()), scene_.projection()};
}

}  // namespace mars::node
