#include "node/renderer.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "node/charges.h"
#include "node/color/encoding.h"
#include "node/group/mapping.h"
#include "node/shading/shading_of.h"

namespace mars::node {
namespace {

// Between looks at the clock: few, for a line may have millions of samples.
constexpr std::uint32_t kLinesABeat = 4;

}  // namespace

Renderer::Renderer(const wire::Load& load, std::span<const std::int32_t> machines, simd::InstructionSet set,
                   Heartbeat& heartbeat, wire::FrameWriter* writer)
    : heartbeat_(heartbeat),
      mapping_(load.mapping),
      exchange_(load.exchange),
      pixel_format_(load.pixel_format),
      tessellator_(set, &heartbeat),
      neighbours_(machines, load.groups),
      memory_(neighbours_, load.memory),
      outbox_(load.pixel_format, load.credits, neighbours_.group(), load.watched == 1),
      homes_(group_size()),
      pass_homes_(group_size()),
      others_(group_size()),
      is_watched_(load.watched == 1) {
  parts_.reserve(neighbours_.nodes().size() + 1);
  if (load.traced == 1) tracer_.emplace();
  if (writer != nullptr) file_output_.emplace(*writer, neighbours_, outbox_, heartbeat_);
}

void Renderer::send_trace() {
  if (tracer_) tracer_->send();
}

void Renderer::join(const collectives::Group& team) {
  if (file_output_) file_output_->team_bands().join(team);
}

void Renderer::finish() {
  if (file_output_) file_output_->team_bands().finish();
  outbox_.flush();
  if (tracer_) tracer_->finish();
}

// The thesis's four steps: triangles, homes for the scanlines, triangles to their homes, scanlines. An inbetween takes
// them with moving parts only, by one node, which is the home of all lines.
void Renderer::draw(Canvas& canvas, const Frame& frame, const HasEnded& has_ended) {
  begin(canvas, frame, has_ended);
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
  if (report_.is_keyframe()) ++keyframes_;
  if (report_.is_keyframe() && triangles_travel())
    canvas_->exchange_record.note(makes_again(), report_.strip().times.exchange);
  memory_.end_frame();
  outbox_.discard_sent();
  send_trace();
}

void Renderer::begin(Canvas& canvas, const Frame& frame, const HasEnded& has_ended) {
  canvas_ = &canvas;
  has_ended_ = &has_ended;
  group_ = frame.group;
  contributors_ = static_cast<std::size_t>(frame.contributors);
  sharing_ = frame.sharing;
  boxes_ = frame.boxes;
  file_ = frame.is_written ? &file_output_.value() : nullptr;
  heartbeat_.begin_frame(frame.number);
  report_.begin(frame.kind, frame.number, frame.interval);
  if (canvas.shadows && report_.is_keyframe()) canvas.shadows->forget_still();
  charge_begin(report_, scene(), std::exchange(is_first_, false));
}

geometry::LineRange Renderer::share_lines() {
  if (!sharing_.is_shared()) return {0, static_cast<std::uint32_t>(canvas_->line_loads.size())};
  const PhaseScope map = phase(wire::Phase::map);
  group::FileBands bands;
  if (file_) bands = {file_->writer().lines_of_band(), scene().film().settings().width * pixel_bytes(pixel_format_)};
  const auto ranges = canvas_->team_lines.divide(scene(), *boxes_, canvas_->sweep.lines(),
                                                 static_cast<std::size_t>(sharing_.team.count), bands);
  report_.charge(wire::Work::vertex, canvas_->team_lines.points());
  return ranges[static_cast<std::size_t>(mynode() - sharing_.team.first)];
}

// Every line that may be the caller's is wanted, so that all edge boxes are counted.
Tessellation Renderer::tessellate_all() {
  memory_.begin_frame();
  parts_.clear();
  own_lines_ = share_lines();
  std::ranges::fill(canvas_->wanted_lines, std::uint8_t{0});
  std::ranges::fill(std::span(canvas_->wanted_lines).subspan(own_lines_.first, own_lines_.count()), std::uint8_t{1});
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
  group::mark_lines(homes(), pass, canvas_->wanted_lines);
  const Tessellation own = tessellate();
  check(own.all_stored, "a pass's triangles fit the memory planned for it");
  fill_own_lines(own.polygons);
  const PhaseScope sum = phase(wire::Phase::sum);
  group::wait_for_all(group_);
  return own;
}

Tessellation Renderer::tessellate() {
  const PhaseScope dice = phase(wire::Phase::dice);
  const Scatter scatter{static_cast<std::uint32_t>(member()), static_cast<std::uint32_t>(contributors_)};
  std::optional<OwnLines> own;
  if (sharing_.is_shared()) own.emplace(OwnLines{*boxes_, own_lines_});
  const LineTable lines{canvas_->wanted_lines, report_.is_keyframe() ? canvas_->wanted_lines : unkept_lines(),
                        canvas_->line_loads, own ? &*own : nullptr};
  shadow::DicedSurfaces* const diced = canvas_->shadows ? &canvas_->shadows->diced() : nullptr;
  if (diced != nullptr) diced->clear(shadow::Casting::moving);
  const Tessellation made = tessellator_.tessellate(
      scene(), scatter, lines, {memory_.arena(), memory_.first_triangle()}, report_.strip().work, {diced});
  std::transform_inclusive_scan(canvas_->line_loads.begin(), canvas_->line_loads.end(),
                                canvas_->line_totals.begin() + 1, std::plus<>(),
                                [](const raster::LineLoad& load) { return load.boxes(); });
  charge_tessellation(report_, scene(), made, report_.strip().work.triangles_tested);
  report_.charge(wire::Work::fresh_byte, memory_.arena().take_fresh());
  return made;
}

// Those of the pass on which an inbetween needs stationary parts; none where all are kept.
std::span<const std::uint8_t> Renderer::unkept_lines() {
  bool any = false;
  const geometry::LineRange lines = canvas_->still.lines();
  for (std::uint32_t line = 0; line < canvas_->wanted_lines.size(); ++line) {
    const bool unkept = canvas_->wanted_lines[line] == 1 && lines.has(line) && !canvas_->still.keeps(line);
    canvas_->wanted_still_lines[line] = unkept ? 1 : 0;
    any |= unkept;
  }
  return any ? canvas_->wanted_still_lines : std::span<const std::uint8_t>();
}

bool Renderer::can_fill(const Tessellation& own) const {
  const std::uint64_t needed = group::own_bytes(own.made, triangles_travel()) +
                               group::fixed_bytes(canvas_->line_loads.size(), static_cast<std::size_t>(group_.count));
  return canvas_->line_totals.back() == own.made.edge_boxes && needed <= memory_.frame_bytes();
}

void Renderer::fill_own_lines(const raster::Polygons& own) {
  const PhaseScope fill = phase(wire::Phase::fill);
  raster::LineFiller filler({0, static_cast<std::uint32_t>(canvas_->line_loads.size())}, canvas_->line_totals,
                            memory_.first_triangle(), memory_.arena());
  filler.add(own);
  parts_.assign(1, filler.finish());
  memory_.publish(parts_.front());
  report_.charge(wire::Work::edge_box_filled, canvas_->line_totals.back());
}

std::uint32_t Renderer::map_to_homes(const group::MadeCounts& made) {
  sum_up(made);
  const PhaseScope map = phase(wire::Phase::map);
  const auto weights = canvas_->sums.weights(mapping_);
  const auto drawing = homes().first(contributors_);
  if (sharing_.is_shared())
    drawing.front() = own_lines_;
  else
    group::map_lines(mapping_, weights, drawing);
  const auto height = static_cast<std::uint32_t>(canvas_->line_loads.size());
  std::ranges::fill(homes().subspan(contributors_), geometry::LineRange{height, height});
  report_.strip().load_ratio = group::load_ratio(weights, drawing);
  report_.strip().work.samples = canvas_->sums.samples_on(homes()[member()]);
  const std::uint32_t passes = group::agree_on_passes({group_, canvas_->sums.ebc(), homes(), canvas_->sums.large(),
                                                       canvas_->line_loads, made.triangles, triangles_travel()},
                                                      memory_.frame_bytes());
  report_.strip().work.passes = passes;
  report_.charge(wire::Work::line_mapped, canvas_->line_loads.size());
  return passes;
}

std::span<const std::uint64_t> Renderer::foreseen_still_bytes() {
  if (!report_.is_keyframe()) return {};
  for (std::uint32_t line = 0; line < canvas_->still_bytes.size(); ++line)
    canvas_->still_bytes[line] = canvas_->still.foreseen_bytes(line);
  return canvas_->still_bytes;
}

void Renderer::sum_up(const group::MadeCounts& made) {
  const bool large = group::is_large(group::own_bytes(made, triangles_travel()), memory_.frame_bytes());
  const PhaseScope sum = phase(wire::Phase::sum);
  canvas_->sums.add_up(group_, {canvas_->line_loads, made.edge_boxes, large, foreseen_still_bytes(),
                                canvas_->exchange_record.expected(report_.strip().times.dice)});
  report_.strip().edge_box_total = canvas_->sums.ebc().back();
}

bool Renderer::makes_again() const {
  if (!triangles_travel() || boxes_ == nullptr || exchange_ == wire::Exchange::send) return false;
  return exchange_ == wire::Exchange::again || group::is_sooner_again(canvas_->sums.exchange());
}

// Neighbours read each other's edge boxes where they lie; the others' are sent, or made again.
geometry::LineRange Renderer::exchange_triangles(const raster::Polygons& own, const group::Pass& pass) {
  const auto homes_now = std::span(pass_homes_).first(homes().size());
  std::ranges::transform(homes(), homes_now.begin(),
                         [&](const geometry::LineRange& home) { return group::part_of(home, pass); });
  const geometry::LineRange lines = homes_now[member()];
  if (group_.count > 1) {
    if (makes_again())
      make_triangles_again(lines);
    else
      send_triangles(own, homes_now);
  }
  for (const raster::LineBoxes& part : parts_) report_.strip().work.edge_boxes += part.count(lines);
  return lines;
}

void Renderer::send_triangles(const raster::Polygons& own, std::span<const geometry::LineRange> homes_now) {
  {
    const PhaseScope exchange = phase(wire::Phase::exchange);
    canvas_->triangle_exchange.send_triangles(group_, own, homes_now, canvas_->line_loads, memory_);
    memory_.read_published(parts_);
  }
  if (triangles_travel()) receive_triangles(homes_now[member()]);
}

// As many edge boxes as EBC counts on `lines` beside those that are there.
raster::LineFiller Renderer::await_triangles(const geometry::LineRange& lines) {
  const auto totals = memory_.arena().take<std::uint64_t>(lines.count() + 1);
  totals[0] = 0;
  for (std::uint32_t i = 0; i < lines.count(); ++i) {
    const std::uint64_t all = canvas_->sums.ebc()[lines.first + i + 1] - canvas_->sums.ebc()[lines.first + i];
    std::uint64_t there = 0;
    for (const raster::LineBoxes& part : parts_) there += part.of(lines.first + i).size();
    if (there > all) throw Failure("nodes' counts of edge boxes make no sense", "", "please report it");
    canvas_->awaited[i] = all - there;
    totals[i + 1] = totals[i] + canvas_->awaited[i];
  }
  return {lines, totals, memory_.first_triangle(), memory_.arena()};
}

void Renderer::receive_triangles(const geometry::LineRange& lines) {
  raster::LineFiller filler = await_triangles(lines);
  const wire::PackedFilm& film = scene().film();
  group::AwaitedTriangles awaited{lines, std::span(canvas_->awaited).first(lines.count()), film.settings().width,
                                  film.settings().samples, film.materials().size()};
  for (std::uint64_t left = filler.box_count(); left > 0;) {
    const raster::Polygons others = receive_some(awaited);
    heartbeat_.look();
    const PhaseScope fill = phase(wire::Phase::fill);
    const std::uint64_t came = others.stationary.size() + others.moving.size();
    left -= came;
    filler.add(others);
    report_.charge(wire::Work::edge_box_filled, came);
  }
  parts_.push_back(filler.finish());
}

void Renderer::make_triangles_again(const geometry::LineRange& lines) {
  memory_.read_published(parts_);
  raster::LineFiller filler = await_triangles(lines);
  const Tessellation others = tessellate_others(lines);
  const PhaseScope fill = phase(wire::Phase::fill);
  filler.add(others.polygons);
  parts_.push_back(filler.finish());
  report_.charge(wire::Work::edge_box_filled, filler.box_count());
}

// What nodes of other machines made for `lines`.
Tessellation Renderer::tessellate_others(const geometry::LineRange& lines) {
  const PhaseScope exchange = phase(wire::Phase::exchange);
  for (std::size_t k = 0; k < contributors_; ++k) {
    const int node = group_.first + static_cast<int>(k);
    others_[k] = node == static_cast<int>(mynode()) || memory_.reads(node) ? 0 : 1;
  }
  std::ranges::fill(canvas_->wanted_lines, std::uint8_t{0});
  std::ranges::fill(std::span(canvas_->wanted_lines).subspan(lines.first, lines.count()), std::uint8_t{1});
  const OwnLines own{*boxes_, lines};
  const auto count = static_cast<std::uint32_t>(contributors_);
  wire::WorkCounts work{};
  const Tessellation others =
      tessellator_.tessellate(scene(), {.count = count, .remainders = std::span(others_).first(contributors_)},
                              {canvas_->wanted_lines, canvas_->wanted_lines, canvas_->other_loads, &own},
                              {memory_.arena(), memory_.first_triangle()}, work);
  check(others.all_stored, "what is made again fits where it would have been received");
  report_.strip().work.patches += work.patches;
  report_.strip().work.vertices += work.vertices;
  report_.strip().work.triangles_tested += work.triangles_tested;
  charge_tessellation(report_, scene(), others, work.triangles_tested);
  return others;
}

raster::Polygons Renderer::receive_some(group::AwaitedTriangles& awaited) {
  const PhaseScope exchange = phase(wire::Phase::exchange);
  return canvas_->triangle_exchange.receive_triangles(memory_, awaited);
}

void Renderer::draw_lines(const geometry::LineRange& lines, const group::Pass& pass) {
  if (file_ && pass.number == 0) begin_writing();
  if (!contributes()) return finish_exchange(pass);
  shading::Shading shading = this->shading();
  if (canvas_->surfaces) {
    canvas_->surfaces->set_frame(report_.strip().frame, has_layer(pixel_format_, wire::Layer::motion));
    shading.surfaces = &*canvas_->surfaces;
  }
  prepared_ = {lines.first, lines.first};
  if (canvas_->shadows) canvas_->shadows->begin(picture(shading), [this] { heartbeat_.look(); });
  const bool constant = report_.is_keyframe() && raster::any_stationary(parts_, lines);
  geometry::LineRange strip{lines.first, lines.first};
  for (bool drawn = false; !drawn;) {
    raster::StripBuffer& buffer = begin_strip(constant);
    strip = {strip.last, draw_strip({strip.last, lines.last}, shading, buffer)};
    drawn = strip.last == lines.last || report_.is_cut();
    if (file_) paste_strip(strip);
    if (drawn) finish_exchange(pass);
    send_strip(strip, drawn && pass.is_last());
  }
}

// Waits for the host's credit.
raster::StripBuffer& Renderer::begin_strip(bool constant) {
  if (file_) return outbox_.begin_own(scene().film().settings().width, constant);
  const PhaseScope credit = phase(wire::Phase::credit);
  return outbox_.begin(scene().film().settings().width, constant, report_.strip().work);
}

std::uint32_t Renderer::draw_strip(const geometry::LineRange& lines, const shading::Shading& shading,
                                   raster::StripBuffer& out) {
  std::uint32_t line = lines.first;
  do {
    if (canvas_->shadows && line < lines.last && !prepared_.has(line)) prepare_shadows({line, lines.last}, shading);
    line = draw_until_full({line, canvas_->shadows ? prepared_.last : lines.last}, shading, out);
  } while (line < lines.last && out.lines_that_fit() > 0 && !report_.is_cut());
  return line;
}

std::uint32_t Renderer::draw_until_full(const geometry::LineRange& lines, const shading::Shading& shading,
                                        raster::StripBuffer& out) {
  const PhaseScope scanline = phase(wire::Phase::scanline);
  const std::uint64_t pixels = out.pixel_count();
  std::uint32_t line = lines.first;
  while (line < lines.last && out.lines_that_fit() > 0) {
    heartbeat_.look();
    if (has_ended()) {
      report_.cut();
      break;
    }
    const geometry::LineRange some{line, std::min(line + std::min(out.lines_that_fit(), kLinesABeat), lines.last)};
    draw_some(some, shading, out);
    line = some.last;
  }
  if (!canvas_->shadows) charge_seen({lines.first, line}, canvas_->z_buffer.take_counts());
  report_.charge(wire::Work::pixel, out.pixel_count() - pixels);
  return line;
}

void Renderer::draw_some(const geometry::LineRange& some, const shading::Shading& shading, raster::StripBuffer& out) {
  if (canvas_->shadows)
    for (std::uint32_t line = some.first; line < some.last; ++line)
      canvas_->shadows->put_line(picture(shading), line, out);
  else if (report_.is_keyframe())
    canvas_->z_buffer.draw_keyframe(parts_, some, shading, canvas_->still, out);
  else
    canvas_->z_buffer.draw_inbetween(parts_, some, shading, canvas_->still, out);
}

void Renderer::prepare_shadows(const geometry::LineRange& lines, const shading::Shading& shading) {
  if (has_ended()) return report_.cut();
  {
    const PhaseScope scanline = phase(wire::Phase::scanline);
    prepared_ = canvas_->shadows->see(picture(shading), lines);
    charge_seen(prepared_, canvas_->shadows->take_counts());
  }
  const PhaseScope shadow = phase(wire::Phase::shadow);
  canvas_->shadows->cast(picture(shading));
  charge_shadows(report_, canvas_->shadows->take_cast_counts());
}

void Renderer::charge_seen(const geometry::LineRange& lines, const raster::DrawnCounts& counts) {
  report_.strip().work.lines_drawn_again += counts.drawn_again;
  charge_lines(report_, scene(), {lines, parts_, canvas_->sums.samples_on(lines), counts});
}

shadow::Picture Renderer::picture(const shading::Shading& shading) const {
  return {scene(), canvas_->sweep, shading, parts_, canvas_->still, report_.is_keyframe()};
}

void Renderer::finish_exchange(const group::Pass& pass) {
  finish_triangles();
  if (!pass.is_last()) return;
  if (report_.is_keyframe() && group_.count > 1) {
    const PhaseScope depth = phase(wire::Phase::depth);
    canvas_->still_exchange.complete({group_, homes(), canvas_->contributes}, canvas_->still);
  }
  if (file_) finish_writing();
}

// Nodes take turns with keyframes.
int Renderer::frame_writer() const {
  if (sharing_.is_shared()) return sharing_.writer;
  return group_.first + static_cast<int>(keyframes_ % contributors_);
}

void Renderer::begin_writing() {
  const wire::Strip& strip = report_.strip();
  if (!report_.is_keyframe()) return file_->writer().begin_inbetween(strip.frame, {own_lines_.first, own_lines_.last});
  const wire::PackedFilm& film = scene().film();
  const wire::FilmSettings& settings = film.settings();
  const auto encoding =
      color::encoding_of(settings, film.camera_at(film.intervals()[strip.interval].first_frame), pixel_format_);
  const geometry::LineRange home = homes()[member()], touched = canvas_->still.lines();
  file_->writer().begin_keyframe({strip.frame,
                                  strip.interval,
                                  {home.first, home.last},
                                  color::background_pixel(encoding, settings.background.data()),
                                  {touched.first, touched.last},
                                  std::ranges::count(canvas_->contributes, 1) > 0});
}

void Renderer::paste_strip(const geometry::LineRange& lines) {
  const PhaseScope compose = phase(wire::Phase::compose);
  report_.set_strip(lines, false);
  file_->paste(report_.strip());
}

// An inbetween that one node draws is whole there.
void Renderer::finish_writing() {
  bool is_whole = true;
  if (report_.is_keyframe()) {
    const int writer = frame_writer();
    exchange_bands({group_, homes(), canvas_->contributes, writer});
    is_whole = writer == static_cast<int>(mynode());
  } else if (sharing_.is_shared()) {
    is_whole = exchange_team_bands();
  }
  const PhaseScope storage = phase(wire::Phase::storage);
  if (is_whole) file_->write();
}

// Bands go to the node that writes the file; whether it is the caller, which has all then. Nodes of which all know that
// they have no lines send nothing.
bool Renderer::exchange_team_bands() {
  const PhaseScope compose = phase(wire::Phase::bands);
  const std::uint32_t frame = report_.strip().frame;
  const int self = static_cast<int>(mynode()), writer = frame_writer();
  if (writer != self) {
    if (own_lines_.count() > 0 && !outbox_.stopped())
      file_->team_bands().send(frame, file_->writer().picture(), writer);
    return false;
  }
  const auto ranges = canvas_->team_lines.ranges();
  for (int node = sharing_.team.first; node < sharing_.team.first + sharing_.team.count; ++node) {
    if (node == self || ranges[static_cast<std::size_t>(node - sharing_.team.first)].count() == 0) continue;
    const auto bands = file_->team_bands().receive(frame, node, outbox_);
    if (!bands) return false;
    file_->writer().add_picture(*bands);
  }
  return true;
}

void Renderer::exchange_bands(const group::BandNeeds& needs) {
  {
    const PhaseScope bands = phase(wire::Phase::bands);
    file_->exchange_edges(needs);
  }
  {
    const PhaseScope compose = phase(wire::Phase::compose);
    file_->writer().finish_bands();
  }
  const PhaseScope bands = phase(wire::Phase::bands);
  file_->exchange_bands(needs);
}

void Renderer::finish_triangles() {
  const PhaseScope exchange = phase(wire::Phase::exchange);
  canvas_->triangle_exchange.finish();
}

void Renderer::send_strip(const geometry::LineRange& lines, bool last) {
  report_.note_memory(memory_.arena().peak());
  report_.set_strip(lines, last);
  if (file_) {
    if (last) outbox_.send_drawn(report_.strip());
    return report_.skip_clock();
  }
  outbox_.send(report_.strip(), watched_edge_boxes(lines));
  ++report_.strip().number;
  report_.skip_clock();  // sending belongs to no phase
}

std::span<const std::uint32_t> Renderer::watched_edge_boxes(const geometry::LineRange& lines) {
  if (!is_watched_) return {};
  watched_.resize(lines.count());
  const auto ebc = canvas_->sums.ebc().subspan(lines.first, lines.count() + 1);
  std::transform(ebc.begin() + 1, ebc.end(), ebc.begin(), watched_.begin(),
                 [](std::uint64_t to, std::uint64_t from) { return static_cast<std::uint32_t>(to - from); });
  return watched_;
}

std::size_t Renderer::group_size() const { return static_cast<std::size_t>(neighbours_.group().count); }

std::size_t Renderer::member() const { return static_cast<std::size_t>(mynode() - group_.first); }

bool Renderer::triangles_travel() const {
  return memory_.readers().size() + 1 < static_cast<std::size_t>(group_.count);
}

shading::Shading Renderer::shading() const {
  shading::Shading shading = shading::shading_of(scene(), pixel_format_);
  shading.triangles = memory_.first_triangle();
  return shading;
}

}  // namespace mars::node
