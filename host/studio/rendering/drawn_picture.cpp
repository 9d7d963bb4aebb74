#include "host/studio/rendering/drawn_picture.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "host/content/document/base64.h"

namespace mars::studio {
namespace {

constexpr int kMarkBits = 24;
constexpr std::size_t kMostDrawn = 256;  // frames whose times are kept
constexpr std::size_t kMostBars = 540;   // of EBC

// Bits, the lowest of a byte first, block after block in rows.
std::string bits_of(const compositor::BlockFlags& flags) {
  std::vector<std::uint8_t> bytes((std::size_t{flags.rows()} * flags.columns() + 7) / 8);
  for (std::uint32_t row = 0; row < flags.rows(); ++row)
    flags.for_stretches(row, [&](std::uint32_t first, std::uint32_t last) {
      for (std::size_t bit = std::size_t{row} * flags.columns() + first; first < last; ++first, ++bit)
        bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] | 1 << bit % 8);
    });
  return document::base64(std::as_bytes(std::span(bytes)));
}

// In the order in which a node takes them; `map` and `fill` put edge boxes where they belong.
Json seconds_of(const wire::PhaseTimes& times) {
  return {{"dice", times.dice},
          {"setup", times.sum + times.map + times.fill},
          {"exchange", times.exchange + times.depth},
          {"raster", times.scanline},
          {"shadow", times.shadow},
          {"wait", times.credit}};
}

const char* word_of(wire::FrameKind kind) { return kind == wire::FrameKind::keyframe ? "keyframe" : "inbetween"; }

}  // namespace

DrawnPicture::DrawnPicture(const pictures::Begin& begin)
    : width_(begin.width),
      height_(begin.height),
      block_(begin.block),
      pixels_(std::size_t{begin.width} * begin.height),
      lines_(begin.height, pictures::Line{-1, 0}) {}

void DrawnPicture::take(pictures::Picture update, std::span<compositor::BlockFlags* const> changed) {
  head_ = update.head;
  lines_ = std::move(update.lines);
  pictures::paste(update.pixels, update.rects, width_, pixels_);
  for (compositor::BlockFlags* flags : changed)
    pictures::for_rows(update.rects, width_, [&](std::size_t at, std::size_t count) {
      flags->set_pixels(static_cast<std::uint32_t>(at / width_), static_cast<std::uint32_t>(at % width_),
                        static_cast<std::uint32_t>(count));
    });
}

void DrawnPicture::note_drawn(pictures::DrawnMessage drawn) {
  drawn_[drawn.head.frame] = std::move(drawn);
  if (drawn_.size() <= kMostDrawn) return;
  const auto older = [](const auto& one, const auto& other) {
    return one.second.head.seconds < other.second.head.seconds;
  };
  drawn_.erase(std::ranges::min_element(drawn_, older));
}

Json DrawnPicture::describe(const compositor::BlockFlags& flagged) const {
  return {{"is", "drawn"},
          {"frame", head_.frame},
          {"kind", word_of(head_.kind)},
          {"interval", head_.interval},
          {"whole", head_.whole == 1},
          {"group", head_.group},
          {"seconds", head_.seconds},
          {"block", block_},
          {"flagged", bits_of(flagged)},
          {"moving", bits_of(blocks_with(pictures::Mark::moving))},
          {"still", bits_of(blocks_with(pictures::Mark::still))},
          {"ebc", edge_boxes()},
          {"nodes", nodes()}};
}

// Who drew which lines [first, last], and their times where the frame is whole.
Json DrawnPicture::nodes() const {
  std::map<std::int32_t, Json> lines;
  for (std::uint32_t first = 0, last; first < height_; first = last) {
    const std::int32_t node = lines_[first].node;
    last = first + 1;
    while (last < height_ && lines_[last].node == node) ++last;
    if (node >= 0) lines[node].push_back({first, last - 1});
  }
  const auto drawn = head_.whole == 1 ? drawn_.find(head_.frame) : drawn_.end();
  Json nodes = Json::array();
  for (auto& [node, ranges] : lines) {
    Json each{{"node", node}, {"lines", std::move(ranges)}};
    if (drawn != drawn_.end()) {
      const auto part = std::ranges::find(drawn->second.parts, node, &pictures::Part::node);
      if (part != drawn->second.parts.end()) {
        each["seconds"] = seconds_of(part->times);
        each["ended"] = part->ended;
        each["triangles"] = part->triangles;
        each["edge_boxes"] = part->edge_boxes;
      }
    }
    nodes.push_back(std::move(each));
  }
  return nodes;
}

// Of each line, or of as many lines together as leave few bars.
Json DrawnPicture::edge_boxes() const {
  const std::size_t lines = (height_ + kMostBars - 1) / kMostBars;
  Json counts = Json::array();
  for (std::size_t first = 0; first < height_; first += lines) {
    std::uint64_t sum = 0;
    for (std::size_t line = first; line < std::min<std::size_t>(height_, first + lines); ++line)
      sum += lines_[line].edge_boxes;
    counts.push_back(sum);
  }
  return counts;
}

compositor::BlockFlags DrawnPicture::blocks_with(pictures::Mark mark) const {
  compositor::BlockFlags flags = no_blocks();
  for (std::uint32_t line = 0; line < height_; ++line)
    for (std::uint32_t x = 0; x < width_; x += block_) {
      const std::span block(&pixels_[std::size_t{line} * width_ + x], std::min(block_, width_ - x));
      const auto has_mark = [mark](std::uint32_t pixel) {
        return pixel >> kMarkBits == static_cast<std::uint32_t>(mark);
      };
      if (!flags.at(x / block_, line / block_) && std::ranges::any_of(block, has_mark)) flags.set_pixels(line, x, 1);
    }
  return flags;
}

}  // namespace mars::studio
