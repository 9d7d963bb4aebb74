#include "node/renderer.h"

#include <algorithm>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "hal/messages/process.h"
#include "hal/messages/recorder.h"

namespace mars::node {
namespace {

// Part `number` of `parts` of a range; the parts for twice as many parts lie within these.
LineRange part_of(const LineRange& range, std::uint32_t number, std::uint32_t parts) {
  const auto at = [&](std::uint32_t n) {
    return range.first + static_cast<std::uint32_t>(std::uint64_t{range.count()} * n / parts);
  };
  return {at(number), at(number + 1)};
}

// Bytes of a pass besides triangles and edge boxes: the sort's offsets and heads, and what is lost where each
// piece of memory is rounded up.
std::uint64_t overhead(std::uint64_t lines, std::uint64_t nodes) { return 24 * lines + 512 * nodes + 4096; }

// Bytes of edge boxes that travel with their triangles, at most; and of those that lie in their lines.
constexpr std::uint64_t kTravelling = sizeof(Triangle) + sizeof(Crossing);
constexpr std::uint64_t kInLine = sizeof(EdgeBox);

}  // namespace

Renderer::Renderer(const FilmView& film, const Load& load, std::span<const std::int32_t> machines,
                   const Kernels& kernels)
    : scene_(film),
      kernels_(kernels),
      mapping_(load.mapping),
      polygon_maker_(kernels),
      arena_(load.memory),
      z_buffer_(kernels, scene_.width()),
      czb_(machines, load.groups, scene_.width(), scene_.height()),
      exchange_(static_cast<int>(numnodes()), film.settings().height),
      outbox_(film.settings().width, load.credits),
      draws_(static_cast<std::size_t>(numnodes())),
      line_counts_(film.settings().height),
      ebc_(film.settings().height + 1),
      wanted_lines_(film.settings().height) {
  const auto nodes = static_cast<std::size_t>(numnodes());
  for (auto* numbers : {&sums_, &work_}) numbers->resize(film.settings().height + nodes);
  for (auto* ranges : {&homes_, &pass_homes_}) ranges->resize(nodes);
  if (load.traced == 1) tracer_.emplace();
}

void Renderer::render(const Render& command, std::span<const std::uint32_t> frames) {
  const hal::Group group{command.group_first, command.group_count};
  const auto index = static_cast<std::int32_t>(mynode() - group.first);
  const auto inbetweens = frames.subspan(1);
  const auto contributor = [&](std::size_t k) {
    return contributor_of_inbetween(command.first_inbetween + k, group.count);
  };
  command_ = command;
  scene_.set_interval(command.interval);
  lines_of_movers_ = scene_.lines_of_movers(inbetweens);
  std::fill(draws_.begin(), draws_.end(), std::uint8_t{0});
  for (std::size_t k = 0; k < inbetweens.size(); ++k) draws_[static_cast<std::size_t>(contributor(k))] = 1;

  frame_ = frames.front();
  draw_frame(FrameKind::keyframe, group);
  for (std::size_t k = 0; k < inbetweens.size() && !outbox_.stopped(); ++k) {
    if (contributor(k) != index) continue;
    frame_ = inbetweens[k];
    draw_frame(FrameKind::inbetween, {static_cast<int>(mynode()), 1});
  }
}

void Renderer::send_trace() {
  if (tracer_) tracer_->send();
}

void Renderer::finish() {
  outbox_.flush();
  if (tracer_) tracer_->finish();
}

void Renderer::draw_frame(FrameKind kind, const hal::Group& group) {
  const double begin = clock_ = dclock();
  hal::record_frame(static_cast<std::int32_t>(frame_));
  sent_before_ = hal::traffic().to_nodes.bytes;
  scene_.set_frame(frame_);
  strip_ = {};
  strip_.kind = kind;
  arena_.clear();
  arena_.forget_fullest();

  std::fill(wanted_lines_.begin(), wanted_lines_.end(), std::uint8_t{1});
  Polygons own = make_polygons(group);
  strip_.work.triangles = made_.triangles;
  strip_.work.edge_boxes_diced = made_.edge_boxes;
  clock(Phase::dice);
  sum_counts(group);
  clock(Phase::sum);
  const auto homes = std::span(homes_).first(static_cast<std::size_t>(group.count));
  map_lines(mapping_, ebc_, homes);
  strip_.load_ratio = load_ratio(ebc_, homes);
  const std::uint32_t passes = plan_passes(group);
  clock(Phase::map);

  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    if (passes > 1) {
      arena_.clear();
      mark_lines(group, pass, passes);
      own = make_polygons(group);
      check(made_.all_stored, "a pass's triangles fit the memory planned for it");
      clock(Phase::dice);
    }
    draw_pass(group, own, pass, passes);
    if (pass + 1 < passes) send_trace();
  }
  const Phase whole = kind == FrameKind::keyframe ? Phase::keyframe : Phase::inbetween;
  hal::record_span(static_cast<int>(whole), begin, clock_, command_.interval);
  send_trace();
}

// Triangles of the node's patches: of all in a keyframe, of the moving ones in an inbetween. The first time
// in a frame every line is wanted and their boxes are counted; later, for passes, those of some lines are made again.
Polygons Renderer::make_polygons(const hal::Group& group) {
  std::fill(line_counts_.begin(), line_counts_.end(), 0u);
  SetUps out(arena_.rest(), line_counts_, wanted_lines_);
  strip_.work.patches = strip_.work.vertices = 0;
  const Scatter scatter{static_cast<std::uint32_t>(mynode() - group.first), static_cast<std::uint32_t>(group.count)};
  if (strip_.kind == FrameKind::keyframe) polygon_maker_.make(scene_, Part::stationary, scatter, out, strip_.work);
  const std::size_t stationary = out.crossings().size();
  polygon_maker_.make(scene_, Part::moving, scatter, out, strip_.work);
  made_ = {out.touching, out.edge_boxes, out.all_stored()};
  const auto crossings = out.crossings();
  arena_.keep(out.triangles().size_bytes(), crossings.size_bytes());
  return {out.first, crossings.last(stationary), crossings.first(crossings.size() - stationary)};
}

// Prefix sum, then global sum of EBC; with it travels each node's memory for its own triangles.
void Renderer::sum_counts(const hal::Group& group) {
  const std::size_t lines = line_counts_.size();
  const auto nodes = static_cast<std::size_t>(group.count);
  const auto sums = std::span(sums_).first(lines + nodes);
  double total = 0;
  for (std::size_t line = 0; line < lines; ++line) sums[line] = total += line_counts_[line];
  std::fill(sums.begin() + static_cast<std::ptrdiff_t>(lines), sums.end(), 0.0);
  const std::uint64_t sent = group.count > 1 ? made_.edge_boxes * kTravelling : 0;
  sums[lines + static_cast<std::size_t>(mynode() - group.first)] =
      static_cast<double>(made_.triangles * sizeof(Triangle) + made_.edge_boxes * sizeof(Crossing) + sent);
  if (group.count > 1) hal::group_sum(group, sums, std::span(work_).first(sums.size()));
  for (std::size_t line = 0; line < lines; ++line) ebc_[line + 1] = static_cast<std::uint64_t>(sums[line]);
  strip_.edge_box_total = ebc_[lines];
}

// How many passes over parts of the lines the group needs, the same number on every node. Nodes ask each other
// only where one pass might not do for one of them, which all can tell from the sums.
std::uint32_t Renderer::plan_passes(const hal::Group& group) {
  const std::size_t lines = line_counts_.size();
  const std::uint64_t height = lines;
  std::uint32_t passes = 1;
  bool fits = true;
  for (std::size_t n = 0; n < static_cast<std::size_t>(group.count); ++n) {
    const std::uint64_t boxes = ebc_[homes_[n].last] - ebc_[homes_[n].first];
    const std::uint64_t received = group.count > 1 ? boxes * kTravelling : 0;
    const double need = sums_[lines + n] + static_cast<double>(received + boxes * kInLine) +
                        static_cast<double>(overhead(height, static_cast<std::uint64_t>(group.count)));
    fits &= need <= static_cast<double>(arena_.size());
  }
  if (fits) return passes;
  while (memory_for(group, passes) > arena_.size() && passes < 2 * height) passes *= 2;
  if (memory_for(group, passes) > arena_.size())
    throw Failure("one line's edge boxes need " + std::to_string((memory_for(group, passes) >> 20) + 1) +
                      " MiB, but a frame has " + std::to_string(arena_.size() >> 20) + " MiB",
                  "memory", "set MARS_MEMORY to more MiB");
  double most = passes, work = 0;
  if (group.count > 1) hal::group_high(group, {&most, 1}, {&work, 1});
  return static_cast<std::uint32_t>(most);
}

// A bound on the bytes that this node uses in any of `passes` passes: a triangle has at least one edge box.
std::uint64_t Renderer::memory_for(const hal::Group& group, std::uint32_t passes) const {
  const auto nodes = static_cast<std::size_t>(group.count);
  const LineRange& home = homes_[static_cast<std::size_t>(mynode() - group.first)];
  std::uint64_t most = 0;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    std::uint64_t own_boxes = 0;
    for (const LineRange& range : std::span(homes_).first(nodes)) {
      const LineRange part = part_of(range, pass, passes);
      for (std::uint32_t line = part.first; line < part.last; ++line) own_boxes += line_counts_[line];
    }
    const LineRange part = part_of(home, pass, passes);
    const std::uint64_t boxes = ebc_[part.last] - ebc_[part.first];
    const std::uint64_t own = std::min(own_boxes, made_.triangles) * sizeof(Triangle) + own_boxes * sizeof(Crossing);
    const std::uint64_t travelling = nodes > 1 ? (own_boxes + boxes) * kTravelling : 0;
    most = std::max(most, own + travelling + boxes * kInLine);
  }
  return most + overhead(line_counts_.size(), nodes);
}

void Renderer::mark_lines(const hal::Group& group, std::uint32_t pass, std::uint32_t passes) {
  std::fill(wanted_lines_.begin(), wanted_lines_.end(), std::uint8_t{0});
  for (const LineRange& home : std::span(homes_).first(static_cast<std::size_t>(group.count))) {
    const LineRange part = part_of(home, pass, passes);
    std::fill(wanted_lines_.begin() + part.first, wanted_lines_.begin() + part.last, std::uint8_t{1});
  }
}

void Renderer::draw_pass(const hal::Group& group, const Polygons& own, std::uint32_t pass, std::uint32_t passes) {
  const auto nodes = static_cast<std::size_t>(group.count);
  const auto pass_homes = std::span(pass_homes_).first(nodes);
  for (std::size_t n = 0; n < nodes; ++n) pass_homes[n] = part_of(homes_[n], pass, passes);
  const LineRange lines = pass_homes[static_cast<std::size_t>(mynode() - group.first)];

  const LineBoxes line_boxes = gather_boxes(group, own, lines, pass_homes);
  strip_.work.edge_boxes += line_boxes.boxes.size();
  strip_.work.passes = passes;
  const Shading look = shading(own.triangles);
  const bool constant = line_boxes.any_stationary();
  LineRange strip{lines.first, lines.first};
  do {
    StripBuffer& buffer = outbox_.begin(constant);
    clock(Phase::credit);
    strip = {strip.last, draw_strip(line_boxes, strip.last, look, buffer)};
    clock(Phase::scanline);
    const bool drawn = strip.last == lines.last;
    if (drawn) finish_pass(group, pass + 1 == passes);
    send_strip(strip, drawn && pass + 1 == passes);
  } while (strip.last < lines.last);
}

// Draws lines from `first` on until the strip is full or all are drawn; one past the last of them.
std::uint32_t Renderer::draw_strip(const LineBoxes& boxes, std::uint32_t first, const Shading& look, StripBuffer& out) {
  std::uint32_t line = first;
  while (line < boxes.lines.last && out.lines_that_fit() > 0) {
    const LineRange part{line, std::min(line + out.lines_that_fit(), boxes.lines.last)};
    if (strip_.kind == FrameKind::keyframe)
      z_buffer_.draw_keyframe(boxes, part, look, lines_of_movers_, czb_, out);
    else
      z_buffer_.draw_inbetween(boxes, part, look, lines_of_movers_, czb_, out);
    line = part.last;
  }
  return line;
}

void Renderer::finish_pass(const hal::Group& group, bool last) {
  exchange_.finish();
  clock(Phase::exchange);
  if (!last || strip_.kind != FrameKind::keyframe || group.count == 1) return;
  exchange_.depth_lines(group, homes_, lines_of_movers_, draws_, czb_);
  clock(Phase::depth);
}

void Renderer::send_strip(const LineRange& lines, bool last) {
  strip_.frame = frame_;
  strip_.interval = command_.interval;
  strip_.node = static_cast<std::int32_t>(mynode());
  strip_.last = last ? 1 : 0;
  strip_.first_line = lines.first;
  strip_.last_line = lines.last;
  strip_.work.memory = arena_.fullest();
  strip_.work.bytes_to_nodes = hal::traffic().to_nodes.bytes - sent_before_;
  outbox_.send(strip_);
  ++strip_.number;
  clock_ = dclock();  // send() told its wait itself: it is no step of the next strip
}

// Edge boxes of all nodes on `lines`. While others' are on their way, the own ones are put into their lines.
LineBoxes Renderer::gather_boxes(const hal::Group& group, const Polygons& own, const LineRange& lines,
                                 std::span<const LineRange> homes) {
  exchange_.send_triangles(group, own, homes, line_counts_, arena_);
  clock(Phase::exchange);
  LineFiller filler(lines, ebc_, own.triangles, arena_);
  filler.add(own);
  clock(Phase::fill);
  for (int number = 1; number < group.count; ++number) {
    const Polygons others = exchange_.receive_triangles(group, number, arena_);
    clock(Phase::exchange);
    filler.add(others);
    clock(Phase::fill);
  }
  return filler.finish();
}

Shading Renderer::shading(const Triangle* triangles) const {
  return {triangles, scene_.film().materials().data(), scene_.lights().data(),
          static_cast<std::uint32_t>(scene_.lights().size()), scene_.projection()};
}

void Renderer::clock(Phase phase) {
  const double now = dclock();
  strip_.times.*kPhaseTimes[static_cast<std::size_t>(phase)] += now - clock_;
  hal::record_span(static_cast<int>(phase), clock_, now);
  clock_ = now;
}

}  // namespace mars::node
