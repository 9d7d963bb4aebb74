#include "node/renderer.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"
#include "node/group/mapping.h"
#include "node/shading/shading_of.h"

namespace mars::node {
namespace {

// Between looks at the clock: few, for a line may have millions of samples.
constexpr std::uint32_t kLinesABeat = 4;

}  // namespace

Renderer::Renderer(const wire::FilmView& film, const wire::Load& load, std::span<const std::int32_t> machines,
                   simd::InstructionSet set, Heartbeat& heartbeat)
    : heartbeat_(heartbeat),
      scene_(film),
      mapping_(load.mapping),
      pixel_format_(load.pixel_format),
      tessellator_(set, &heartbeat),
      z_buffer_(set, film.settings().width, scene_.pattern()),
      neighbours_(machines, load.groups),
      still_(neighbours_, film.settings().width, film.settings().height, scene_.pattern(), load.still_memory),
      memory_(neighbours_, load.memory),
      sums_(film.settings().height),
      triangle_exchange_(group_size(), film.settings().height),
      still_exchange_(neighbours_, film.settings().samples, film.settings().height),
      outbox_(film.settings().width, load.pixel_format, load.credits, neighbours_.group(),
              load.watched == 1 ? film.settings().height : 0),
      contributes_(group_size()),
      line_loads_(film.settings().height),
      line_totals_(film.settings().height + 1),
      awaited_(film.settings().height),
      wanted_lines_(film.settings().height),
      wanted_still_lines_(film.settings().height),
      homes_(group_size()),
      pass_homes_(group_size()),
      watched_(load.watched == 1 ? film.settings().height : 0) {
  parts_.reserve(neighbours_.nodes().size() + 1);
  if (load.traced == 1) tracer_.emplace();
}

void Renderer::render(const wire::RenderCommand& command) {
  const wire::Render& render = command.render;
  messages::keep_to(render.group_first, render.group_count);
  if (render.goes_on == 0) {
    begin_interval(command);
    draw_frame(wire::FrameKind::keyframe, render.interval, command.frames.front(),
               {render.group_first, render.group_count}, render.contributors);
  }
  draw_inbetweens(command);
  messages::keep_to_nobody();
}

void Renderer::draw_inbetweens(const wire::RenderCommand& command) {
  const auto inbetweens = command.inbetweens();
  const int self = static_cast<int>(mynode());
  for (std::size_t k = 0; k < inbetweens.size() && !outbox_.stopped(); ++k)
    if (command.render.group_first + command.contributor(k) == self)
      draw_frame(wire::FrameKind::inbetween, command.render.interval, inbetweens[k], {self, 1}, 1);
}

void Renderer::send_trace() {
  if (tracer_) tracer_->send();
}

void Renderer::finish() {
  outbox_.flush();
  if (tracer_) tracer_->finish();
}

// Those that are left may come to any node.
void Renderer::begin_interval(const wire::RenderCommand& command) {
  scene_.set_interval(command.render.interval);
  still_.begin_interval(command.render.interval, scene_.moving_line_bounds(command.frames.subspan(1)));
  std::ranges::fill(contributes_, static_cast<std::uint8_t>(command.left().empty() ? 0 : 1));
  for (std::size_t k = 0; k < command.inbetweens().size(); ++k)
    contributes_[static_cast<std::size_t>(command.contributor(k))] = 1;
}

// The thesis's four steps: triangles, homes for the scanlines, triangles to their homes, scanlines. An inbetween takes
// them with moving parts only, by one node, which is the home of all lines.
void Renderer::draw_frame(wire::FrameKind kind, std::uint32_t interval, std::uint32_t frame,
                          const collectives::Group& group, std::int32_t contributors) {
  group_ = group;
  contributors_ = static_cast<std::size_t>(contributors);
  heartbeat_.begin_frame(frame);
  report_.begin(kind, frame, interval);
  scene_.set_frame(frame);
  report_.charge(wire::Work::first_frame, std::exchange(is_first_, false) ? 1 : 0);
  report_.charge(wire::Work::frame, 1);
  report_.charge(wire::Work::segment, scene_.film().segments().size());
  Tessellation own = tessellate_all();
  group::Pass pass{0, map_to_homes(own.made)};
  if (pass.count == 1 && parts_.empty())
    throw Failure("nodes' counts of large frames make no sense", "", "please report it");
  for (; pass.number < pass.count; ++pass.number) {
    if (pass.count > 1) own = tessellate_part(pass);
    draw_lines(exchange_triangles(own.polygons, pass), pass);
    if (!pass.is_last()) send_trace();
  }
  report_.end();
  memory_.end_frame();
  outbox_.discard_sent();
  send_trace();
}

// Every line is wanted, so that all edge boxes are counted.
Tessellation Renderer::tessellate_all() {
  memory_.begin_frame();
  parts_.clear();
  std::ranges::fill(wanted_lines_, std::uint8_t{1});
  const Tessellation own = tessellate();
  report_.strip().work.triangles = own.made.triangles;
  report_.strip().work.edge_boxes_diced = own.made.edge_boxes;
  if (can_fill(own)) fill_own_lines(own.polygons);
  return own;
}

// The triangles of the pass's lines, made again. No node goes on before all have published them and have received what
// was sent in the pass before.
Tessellation Renderer::tessellate_part(const group::Pass& pass) {
  report_.note_memory(memory_.arena().peak());
  memory_.begin_frame();
  group::mark_lines(homes(), pass, wanted_lines_);
  const Tessellation own = tessellate();
  check(own.all_stored, "a pass's triangles fit the memory planned for it");
  fill_own_lines(own.polygons);
  heartbeat_.enter(wire::Phase::sum);
  group::wait_for_all(group_);
  report_.clock(wire::Phase::sum);
  return own;
}

Tessellation Renderer::tessellate() {
  heartbeat_.enter(wire::Phase::dice);
  const Scatter scatter{static_cast<std::uint32_t>(member()), static_cast<std::uint32_t>(contributors_)};
  const LineTable lines{wanted_lines_, report_.is_keyframe() ? wanted_lines_ : unkept_lines(), line_loads_};
  const Tessellation own = tessellator_.tessellate(scene_, scatter, lines, {memory_.arena(), memory_.first_triangle()},
                                                   report_.strip().work);
  std::transform_inclusive_scan(line_loads_.begin(), line_loads_.end(), line_totals_.begin() + 1, std::plus<>(),
                                [](const raster::LineLoad& load) { return load.boxes(); });
  charge_tessellation(own);
  report_.charge(wire::Work::fresh_byte, memory_.arena().take_fresh());
  report_.clock(wire::Phase::dice);
  return own;
}

void Renderer::charge_tessellation(const Tessellation& own) {
  const auto charge = [&](wire::Work kind, std::uint64_t units) { report_.charge(kind, units); };
  charge(wire::Work::patch, own.surfaces.patches);
  charge(wire::Work::meshlet, own.surfaces.meshlets);
  charge(wire::Work::vertex, own.surfaces.vertices);
  charge(wire::Work::mesh_vertex, own.surfaces.mesh_vertices);
  charge(wire::Work::triangle_tested, report_.strip().work.triangles_tested);
  charge(wire::Work::row_tested,
         report_.strip().work.triangles_tested * static_cast<std::uint64_t>(scene_.pattern().count));
  charge(wire::Work::triangle, own.made.triangles);
  charge(wire::Work::edge_box_made, own.made.edge_boxes);
  charge(wire::Work::vertex_light, own.surfaces.colored * scene_.lights().size());
}

// Those of the pass on which an inbetween needs stationary parts; none where all are kept.
std::span<const std::uint8_t> Renderer::unkept_lines() {
  bool any = false;
  const geometry::LineRange lines = still_.lines();
  for (std::uint32_t line = 0; line < wanted_lines_.size(); ++line) {
    const bool unkept = wanted_lines_[line] == 1 && lines.has(line) && !still_.keeps(line);
    wanted_still_lines_[line] = unkept ? 1 : 0;
    any |= unkept;
  }
  return any ? wanted_still_lines_ : std::span<const std::uint8_t>();
}

bool Renderer::can_fill(const Tessellation& own) const {
  const std::uint64_t needed = group::own_bytes(own.made, triangles_travel()) +
                               group::fixed_bytes(line_loads_.size(), static_cast<std::size_t>(group_.count));
  return line_totals_.back() == own.made.edge_boxes && needed <= memory_.frame_bytes();
}

void Renderer::fill_own_lines(const raster::Polygons& own) {
  heartbeat_.enter(wire::Phase::fill);
  raster::LineFiller filler({0, static_cast<std::uint32_t>(line_loads_.size())}, line_totals_, memory_.first_triangle(),
                            memory_.arena());
  filler.add(own);
  parts_.assign(1, filler.finish());
  memory_.publish(parts_.front());
  report_.charge(wire::Work::edge_box_filled, line_totals_.back());
  report_.clock(wire::Phase::fill);
}

std::uint32_t Renderer::map_to_homes(const group::MadeCounts& made) {
  const bool large = group::is_large(group::own_bytes(made, triangles_travel()), memory_.frame_bytes());
  heartbeat_.enter(wire::Phase::sum);
  sums_.add_up(group_, {line_loads_, made.edge_boxes, large});
  report_.strip().edge_box_total = sums_.ebc().back();
  report_.clock(wire::Phase::sum);
  heartbeat_.enter(wire::Phase::map);
  const auto weights = sums_.weights(mapping_);
  const auto drawing = homes().first(contributors_);
  group::map_lines(mapping_, weights, drawing);
  const auto height = static_cast<std::uint32_t>(line_loads_.size());
  std::ranges::fill(homes().subspan(contributors_), geometry::LineRange{height, height});
  report_.strip().load_ratio = group::load_ratio(weights, drawing);
  report_.strip().work.samples = sums_.samples_on(homes()[member()]);
  const std::uint32_t passes = group::agree_on_passes(
      {group_, sums_.ebc(), homes(), sums_.large(), line_loads_, made.triangles, triangles_travel()},
      memory_.frame_bytes());
  report_.strip().work.passes = passes;
  report_.charge(wire::Work::line_mapped, line_loads_.size());
  report_.clock(wire::Phase::map);
  return passes;
}

// Neighbours read each other's edge boxes where they lie; the others' are sent.
geometry::LineRange Renderer::exchange_triangles(const raster::Polygons& own, const group::Pass& pass) {
  heartbeat_.enter(wire::Phase::exchange);
  const auto homes_now = std::span(pass_homes_).first(homes().size());
  std::ranges::transform(homes(), homes_now.begin(),
                         [&](const geometry::LineRange& home) { return group::part_of(home, pass); });
  const geometry::LineRange lines = homes_now[member()];
  if (group_.count > 1) {
    triangle_exchange_.send_triangles(group_, own, homes_now, line_loads_, memory_);
    memory_.read_published(parts_);
    report_.clock(wire::Phase::exchange);
    if (triangles_travel()) receive_triangles(lines);
  }
  for (const raster::LineBoxes& part : parts_) report_.strip().work.edge_boxes += part.count(lines);
  return lines;
}

// As many edge boxes as EBC counts on `lines` beside those that are there.
void Renderer::receive_triangles(const geometry::LineRange& lines) {
  const auto totals = memory_.arena().take<std::uint64_t>(lines.count() + 1);
  totals[0] = 0;
  for (std::uint32_t i = 0; i < lines.count(); ++i) {
    const std::uint64_t all = sums_.ebc()[lines.first + i + 1] - sums_.ebc()[lines.first + i];
    std::uint64_t there = 0;
    for (const raster::LineBoxes& part : parts_) there += part.of(lines.first + i).size();
    if (there > all) throw Failure("nodes' counts of edge boxes make no sense", "", "please report it");
    awaited_[i] = all - there;
    totals[i + 1] = totals[i] + awaited_[i];
  }
  const wire::FilmView& film = scene_.film();
  group::AwaitedTriangles awaited{lines, std::span(awaited_).first(lines.count()), film.settings().width,
                                  film.settings().samples, film.materials().size()};
  raster::LineFiller filler(lines, totals, memory_.first_triangle(), memory_.arena());
  for (std::uint64_t left = totals.back(); left > 0;) {
    const raster::Polygons others = triangle_exchange_.receive_triangles(memory_, awaited);
    report_.clock(wire::Phase::exchange);
    heartbeat_.look();
    const std::uint64_t came = others.stationary.size() + others.moving.size();
    left -= came;
    filler.add(others);
    report_.charge(wire::Work::edge_box_filled, came);
    report_.clock(wire::Phase::fill);
  }
  parts_.push_back(filler.finish());
}

void Renderer::draw_lines(const geometry::LineRange& lines, const group::Pass& pass) {
  if (!contributes()) return finish_exchange(pass);
  const shading::Shading shading = this->shading();
  const bool constant = report_.is_keyframe() && raster::any_stationary(parts_, lines);
  geometry::LineRange strip{lines.first, lines.first};
  do {
    heartbeat_.enter(wire::Phase::credit);
    raster::StripBuffer& buffer = outbox_.begin(constant, report_.strip().work);
    report_.clock(wire::Phase::credit);
    heartbeat_.enter(wire::Phase::scanline);
    strip = {strip.last, draw_strip({strip.last, lines.last}, shading, buffer)};
    charge_strip(strip, buffer);
    report_.clock(wire::Phase::scanline);
    const bool drawn = strip.last == lines.last;
    if (drawn) finish_exchange(pass);
    if (drawn && pass.is_last()) charge_file();
    send_strip(strip, drawn && pass.is_last());
  } while (strip.last < lines.last);
}

void Renderer::charge_strip(const geometry::LineRange& lines, const raster::StripBuffer& strip) {
  const auto charge = [&](wire::Work kind, std::uint64_t units) { report_.charge(kind, units); };
  std::uint64_t boxes = 0;
  for (const raster::LineBoxes& part : parts_) boxes += part.count(lines);
  const raster::DrawnCounts drawn = z_buffer_.take_counts();
  charge(wire::Work::line, drawn.lines);
  charge(wire::Work::edge_box, boxes);
  charge(wire::Work::sample, sums_.samples_on(lines));
  charge(wire::Work::shaded, drawn.shaded.samples);
  charge(wire::Work::light, drawn.shaded.highlights * scene_.lights().size());
  charge(wire::Work::facet_light, drawn.shaded.facets * scene_.lights().size());
  charge(wire::Work::pixel, strip.pixel_count());
  charge(wire::Work::still_byte, drawn.still_bytes);
}

// Its own lines of a keyframe, an inbetween whole.
void Renderer::charge_file() {
  const std::uint64_t lines = homes()[member()].count();
  const std::uint64_t bytes = lines * scene_.film().settings().width * wire::pixel_bytes(pixel_format_);
  messages::charge(static_cast<int>(wire::Work::node_frame), 1);
  messages::charge(static_cast<int>(wire::Work::node_frame_byte), bytes);
}

std::uint32_t Renderer::draw_strip(const geometry::LineRange& lines, const shading::Shading& shading,
                                   raster::StripBuffer& out) {
  std::uint32_t line = lines.first;
  while (line < lines.last && out.lines_that_fit() > 0) {
    heartbeat_.look();
    const geometry::LineRange some{line, std::min(line + std::min(out.lines_that_fit(), kLinesABeat), lines.last)};
    if (report_.is_keyframe())
      z_buffer_.draw_keyframe(parts_, some, shading, still_, out);
    else
      report_.strip().work.lines_drawn_again += z_buffer_.draw_inbetween(parts_, some, shading, still_, out);
    line = some.last;
  }
  return line;
}

void Renderer::finish_exchange(const group::Pass& pass) {
  heartbeat_.enter(wire::Phase::exchange);
  triangle_exchange_.finish();
  report_.clock(wire::Phase::exchange);
  if (!pass.is_last() || !report_.is_keyframe() || group_.count == 1) return;
  heartbeat_.enter(wire::Phase::depth);
  still_exchange_.complete({group_, homes(), contributes_}, still_);
  report_.clock(wire::Phase::depth);
}

void Renderer::send_strip(const geometry::LineRange& lines, bool last) {
  report_.note_memory(memory_.arena().peak());
  report_.set_strip(lines, last);
  outbox_.send(report_.strip(), watched_edge_boxes(lines));
  ++report_.strip().number;
  report_.skip_clock();  // sending belongs to no phase
}

std::span<const std::uint32_t> Renderer::watched_edge_boxes(const geometry::LineRange& lines) {
  if (watched_.empty()) return {};
  const auto ebc = sums_.ebc().subspan(lines.first, lines.count() + 1);
  std::transform(ebc.begin() + 1, ebc.end(), ebc.begin(), watched_.begin(),
                 [](std::uint64_t to, std::uint64_t from) { return static_cast<std::uint32_t>(to - from); });
  return std::span(watched_).first(lines.count());
}

std::size_t Renderer::group_size() const { return static_cast<std::size_t>(neighbours_.group().count); }

std::size_t Renderer::member() const { return static_cast<std::size_t>(mynode() - group_.first); }

bool Renderer::triangles_travel() const {
  return memory_.readers().size() + 1 < static_cast<std::size_t>(group_.count);
}

shading::Shading Renderer::shading() const {
  shading::Shading shading = shading::shading_of(scene_, pixel_format_);
  shading.triangles = memory_.first_triangle();
  return shading;
}

}  // namespace mars::node
