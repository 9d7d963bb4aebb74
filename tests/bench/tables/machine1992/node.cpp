#include "tests/bench/tables/machine1992/node.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "hal/failure/failure.h"
#include "hal/nx/nx_global.h"
#include "hal/nx/nx_messages.h"
#include "node/group/mapping.h"
#include "node/shading/shading_of.h"

namespace mars::machine1992 {
namespace {

void pack(const SentBox& box, std::vector<std::byte>& to) {
  const std::size_t at = to.size();
  to.resize(at + kSentBoxBytes);
  std::memcpy(to.data() + at, &box, kSentBoxBytes);
}

SentBox unpacked(const std::byte* from) {
  SentBox box;
  std::memcpy(&box, from, kSentBoxBytes);
  return box;
}

std::size_t self() { return static_cast<std::size_t>(mynode()); }

}  // namespace

Node::Node(const wire::PackedFilm& film)
    : film_(film),
      scene_(film_),
      share_(film_),
      lists_(film_.settings().height),
      buffers_(film_.settings().width, film_.settings().height),
      scanlines_(film_.settings().width),
      homes_(static_cast<std::size_t>(numnodes())),
      to_(homes_.size()) {
  check(film_.settings().samples == 1, "a film of 1992 has one sample a pixel");
}

void Node::draw_interval(std::uint32_t interval, std::uint32_t inbetweens) {
  const wire::Interval& frames = film_.intervals()[interval];
  scene_.set_interval(interval);
  draw_keyframe(frames.first_frame, frames.moving_count > 0);
  gsync();
  crecv(kGoOn, nullptr, 0);
  for (auto k = static_cast<std::uint32_t>(mynode()); k < inbetweens; k += static_cast<std::uint32_t>(numnodes()))
    draw_inbetween(frames.first_frame + 1 + k);
}

void Node::draw_keyframe(std::uint32_t frame, bool moves) {
  scene_.set_frame(frame);
  begin_record(frame, true);
  make_lists();
  const geometry::LineRange lines = find_home();
  exchange_boxes();
  draw_lines(lines);
  const geometry::LineRange columns{0, film_.settings().width};
  send_strip(kKeyframe, false, lines, columns);
  if (moves) send_strip(kKeyframe, true, lines, columns);
  exchange_depths();
}

void Node::begin_record(std::uint32_t frame, bool keyframe) {
  records_.emplace_back();
  records_.back().frame = frame;
  records_.back().keyframe = keyframe;
}

void Node::make_lists() {
  const node::Scatter scatter{static_cast<std::uint32_t>(mynode()), static_cast<std::uint32_t>(numnodes())};
  WorkCounts work;
  own_ = share_.edge_boxes(scene_, scatter, true, work);
  spend(work, records_.back().lists);
  boxes_on_line_.assign(film_.settings().height, 0);
  for (const SentBox& box : own_) boxes_on_line_[box.line] += 1;
}

// Prefix sums of EBC, added up over the nodes, and the heuristic of figure 4.7.
geometry::LineRange Node::find_home() {
  std::vector<double> received(boxes_on_line_.size());
  std::partial_sum(boxes_on_line_.begin(), boxes_on_line_.end(), boxes_on_line_.begin());
  gdsum(boxes_on_line_.data(), static_cast<long>(boxes_on_line_.size()), received.data());
  std::vector<std::uint64_t> totals(1, 0);
  for (const double boxes : boxes_on_line_) totals.push_back(static_cast<std::uint64_t>(boxes));
  group::map_greedy(totals, homes_);
  spend_one(Work::line, boxes_on_line_.size());
  return homes_[self()];
}

void Node::exchange_boxes() {
  lists_.clear();
  std::ranges::for_each(to_, [](auto& boxes) { boxes.clear(); });
  for (const SentBox& box : own_) {
    const auto home =
        std::ranges::find_if(homes_, [&](const geometry::LineRange& lines) { return lines.has(box.line); });
    const auto node = static_cast<std::size_t>(home - homes_.begin());
    if (node == self())
      lists_.add(box);
    else
      pack(box, to_[node]);
  }
  for (const auto& boxes : to_) {
    records_.back().sent.push_back(boxes.size());
    spend_one(Work::pass_on, boxes.size() / kSentBoxBytes);
  }
  std::vector<long> sends;
  for (std::size_t k = 1; k < to_.size(); ++k) {
    const std::size_t node = (self() + k) % to_.size();
    sends.push_back(isend(kEdgeBoxes + mynode(), to_[node].data(), static_cast<long>(to_[node].size()),
                          static_cast<long>(node), 0));
  }
  for (std::size_t k = 1; k < to_.size(); ++k) receive_boxes(static_cast<int>((self() + to_.size() - k) % to_.size()));
  for (const long send : sends) msgwait(send);
}

void Node::receive_boxes(int from) {
  cprobe(kEdgeBoxes + from);
  std::vector<std::byte> boxes(static_cast<std::size_t>(infocount()));
  crecv(kEdgeBoxes + from, boxes.data(), static_cast<long>(boxes.size()));
  for (std::size_t at = 0; at < boxes.size(); at += kSentBoxBytes) lists_.add(unpacked(boxes.data() + at));
  spend_one(Work::pass_on, boxes.size() / kSentBoxBytes);
}

void Node::draw_lines(const geometry::LineRange& lines) {
  const shading::Shading shading = shading::shading_of(scene_);
  buffers_.constant.clear(lines);
  buffers_.moving.clear(lines);
  WorkCounts work;
  work[Work::clear] = 2ull * lines.count() * film_.settings().width;
  scanlines_.draw_stationary(lists_, lines, shading, buffers_, work);
  scanlines_.draw_moving(lists_, lines, shading, buffers_, work);
  spend(work, records_.back().lines);
}

// All nodes' parts of the CZB, which tile the picture in the nodes' order, become everybody's.
void Node::exchange_depths() {
  std::vector<long> bytes;
  for (const geometry::LineRange& lines : homes_)
    bytes.push_back(static_cast<long>(lines.count() * film_.settings().width * sizeof(float)));
  const geometry::LineRange& own = homes_[self()];
  const auto depths = std::span(buffers_.constant.depths).subspan(std::size_t{own.first} * film_.settings().width);
  const std::vector<float> mine(depths.begin(), depths.begin() + own.count() * film_.settings().width);
  gcolx(mine.data(), bytes.data(), buffers_.constant.depths.data());
  records_.back().depths = static_cast<std::uint64_t>(bytes[self()]);
  spend_one(Work::depth, buffers_.constant.depths.size() - mine.size());
}

void Node::draw_inbetween(std::uint32_t frame) {
  scene_.set_frame(frame);
  begin_record(frame, false);
  const std::uint32_t width = film_.settings().width, height = film_.settings().height;
  lists_.clear();
  WorkCounts work;
  for (const SentBox& box : share_.edge_boxes(scene_, {0, 1}, false, work)) lists_.add(box);
  buffers_.moving.clear({0, height});
  work[Work::clear] = std::uint64_t{width} * height;
  scanlines_.draw_moving(lists_, {0, height}, shading::shading_of(scene_), buffers_, work);
  spend(work, records_.back().lines);
  const auto [lines, columns] = moving_box();
  const auto drawn = std::ranges::count_if(buffers_.moving.pixels, [](std::uint32_t pixel) { return pixel != 0; });
  records_.back().moving = {4ull * width * height, 4ull * width * lines.count(), 4ull * columns.count() * lines.count(),
                            4ull * static_cast<std::uint64_t>(drawn)};
  send_strip(kInbetween + static_cast<long>(frame), true, lines, columns);
}

std::pair<geometry::LineRange, geometry::LineRange> Node::moving_box() {
  geometry::LineRange lines{film_.settings().height, 0}, columns{film_.settings().width, 0};
  for (std::uint32_t line = 0; line < film_.settings().height; ++line) {
    const auto pixels = buffers_.moving.pixels_of(line);
    for (std::uint32_t column = 0; column < pixels.size(); ++column) {
      if (pixels[column] == 0) continue;
      lines = {std::min(lines.first, line), line + 1};
      columns = {std::min(columns.first, column), std::max(columns.last, column + 1)};
    }
  }
  spend_one(Work::look, buffers_.moving.pixels.size());
  return lines.last == 0 ? std::pair<geometry::LineRange, geometry::LineRange>() : std::pair(lines, columns);
}

void Node::send_strip(long type, bool moving, const geometry::LineRange& lines, const geometry::LineRange& columns) {
  const StripHead head{moving, lines.first, lines.last, columns.first, columns.last};
  Layer& layer = moving ? buffers_.moving : buffers_.constant;
  std::vector<std::byte> message(sizeof(head) + 4ull * lines.count() * columns.count());
  std::memcpy(message.data(), &head, sizeof(head));
  std::byte* to = message.data() + sizeof(head);
  for (std::uint32_t line = lines.first; line < lines.last; ++line, to += 4ull * columns.count())
    std::memcpy(to, layer.pixels_of(line).data() + columns.first, 4ull * columns.count());
  records_.back().strips.push_back(message.size());
  csend(type, nullptr, 0, myhost(), 0);
  crecv(kReady, nullptr, 0);
  csend(kStrip, message.data(), static_cast<long>(message.size()), myhost(), 0);
}

void Node::spend_one(Work kind, std::uint64_t units) {
  WorkCounts work;
  work[kind] = units;
  spend(work, records_.back().lines);
}

}  // namespace mars::machine1992
