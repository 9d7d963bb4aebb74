#include "node/group/frame_memory.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "hal/failure/failure.h"
#include "hal/messages/process.h"
#include "hal/nx/nx_messages.h"

namespace mars::group {
namespace {

constexpr std::size_t kParts = 2;
constexpr std::size_t kPage = 4096;

// So that parts begin at pages, and triangles of a whole block have numbers of 32 bits.
std::size_t bytes_of_part(std::size_t neighbours, std::uint64_t bytes) {
  const std::uint64_t most = std::uint64_t{shading::kNoTriangle} * sizeof(geometry::Triangle);
  if (neighbours == 1) return std::min(bytes, most);
  return std::min(bytes / kParts, most / (kParts * neighbours)) / kPage * kPage;
}

}  // namespace

FrameMemory::FrameMemory(const raster::Neighbours& neighbours, std::uint64_t bytes)
    : nodes_(neighbours.nodes()), frame_bytes_(bytes_of_part(neighbours.most(), bytes)) {
  try {
    shared_.emplace(neighbours, neighbours.most() * kParts * frame_bytes_, frame_bytes_,
                    raster::NeighboursMemory::Contents::own);
    shared_->prefer_large_pages();
    block_ = shared_->bytes();
  } catch (const Failure& failure) {
    if (nodes_.size() > 1) refusal_ = failure.problem;
    own_ = messages::PrivateMemory(frame_bytes_);
    own_.prefer_large_pages();
    block_ = own_.bytes();
  }
  if (nodes_.size() == 1 || !refusal_.empty()) {
    arenas_[0] = raster::Arena(block_);
    return;
  }
  const auto self = static_cast<int>(mynode());
  std::ranges::copy_if(nodes_, std::back_inserter(readers_), [self](int node) { return node != self; });
  for (std::size_t turn = 0; turn < kParts; ++turn) arenas_[turn] = raster::Arena(part(self, turn));
}

std::span<std::byte> FrameMemory::part(int node, std::size_t turn) const {
  const auto index = static_cast<std::size_t>(std::ranges::lower_bound(nodes_, node) - nodes_.begin());
  return block_.subspan((index * kParts + turn) * frame_bytes_, frame_bytes_);
}

void FrameMemory::begin_frame() {
  if (std::exchange(is_read_, false)) turn_ = 1 - turn_;
  arena().clear();
  if (!readers_.empty()) head_ = arena().take<Published>(1).data();
}

// What neighbours read is theirs until the next frame but one begins.
void FrameMemory::end_frame() {
  if (!is_read_) messages::discard(arena().all());
}

bool FrameMemory::reads(int node) const { return std::ranges::binary_search(readers_, node); }

std::uint64_t FrameMemory::place_of(const void* item) const {
  return static_cast<std::uint64_t>(static_cast<const std::byte*>(item) - block_.data());
}

void FrameMemory::publish(const raster::LineBoxes& own) {
  if (head_ == nullptr) return;
  *head_ = {place_of(own.boxes.data()), own.boxes.size(), place_of(own.end.data()), place_of(own.stationary_end.data()),
            own.lines.last};
}

void FrameMemory::read_published(std::vector<raster::LineBoxes>& parts) {
  for (const int node : readers_) parts.push_back(published_by(node));
  is_read_ = !readers_.empty();
}

raster::LineBoxes FrameMemory::published_by(int node) const {
  const auto& published = *reinterpret_cast<const Published*>(part(node, turn_).data());
  const auto items = [this]<typename T>(std::uint64_t place, std::uint64_t count) {
    return std::span<const T>(reinterpret_cast<const T*>(block_.data() + place), count);
  };
  const auto lines = static_cast<std::uint32_t>(published.lines);
  return {{0, lines},
          items.operator()<raster::EdgeBox>(published.boxes, published.box_count),
          items.operator()<std::uint64_t>(published.end, lines),
          items.operator()<std::uint64_t>(published.stationary_end, lines)};
}

}  // namespace mars::group
