#include "hal/processes/heap.h"

#include <fcntl.h>

#include <algorithm>
#include <bit>
#include <string>

#include "hal/failure/failure.h"

namespace mars::processes {
namespace {

constexpr std::uint32_t kSmallestClass = 6;  // 64 bytes: a cache line
constexpr std::uint32_t kLastSmall = 16;     // classes up to it come in slabs, whose memory is never given back
constexpr std::size_t kSlab = 64 * 1024;
constexpr std::uint64_t kHeapPage = 4096;

std::uint32_t class_for(std::size_t length) {
  return std::max<std::uint32_t>(kSmallestClass, std::bit_width(length - (length > 0)));
}

std::uint64_t block_size(std::uint32_t size_class) { return sizeof(Block) + (std::uint64_t{1} << size_class); }

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

}  // namespace

Heap::Heap(const Segment& segment, int index) : segment_(segment), index_(index), slot_(segment.slot(index)) {
  for (Offset at = segment_.heap(index); at < segment_.heap(index) + slot_.carved;) {
    Block& block = segment_.block(at);
    if (block.state == Block::State::free) release(at);
    at += block_size(block.size_class);
  }
}

Offset Heap::acquire(std::size_t length) {
  const std::uint32_t size_class = class_for(length);
  if (size_class >= free_.size())
    throw Failure("a message of " + std::to_string(length) + " bytes is longer than any memory", "",
                  "send less at once");
  if (free_[size_class] == 0) reclaim();
  const Offset offset = free_[size_class] != 0 ? free_[size_class] : carve(size_class);
  Block& block = segment_.block(offset);
  if (size_class > kLastSmall) touch(block, length);
  free_[size_class] = block.next;
  block.length = length;
  block.state = Block::State::used;
  return offset;
}

void Heap::reclaim() {
  for (Offset at = slot_.returned.exchange(0); at != 0;) {
    const Offset next = segment_.block(at).next;
    segment_.block(at).state = Block::State::free;
    release(at);
    at = next;
  }
}

void Heap::release(Offset offset) {
  Block& block = segment_.block(offset);
  block.next = free_[block.size_class];
  free_[block.size_class] = offset;
  if (block.size_class <= kLastSmall) return;
  idle_ += block.touched;
  if (idle_ > segment_.header().limit / (2 * static_cast<std::uint64_t>(segment_.slots()))) hollow(block, offset);
}

// New blocks of a class: one that is large, or as many as a slab holds, of which one is returned free and
// first.
Offset Heap::carve(std::uint32_t size_class) {
  const std::uint64_t size = block_size(size_class);
  const std::uint64_t count = size_class > kLastSmall ? 1 : std::max<std::uint64_t>(1, kSlab / size);
  if (slot_.carved + count * size > segment_.header().heap_capacity) fail_full();
  if (size_class <= kLastSmall) reserve(count * size);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Offset offset = segment_.heap(index_) + slot_.carved;
    segment_.block(offset).size_class = size_class;
    slot_.carved += size;
    release(offset);
  }
  return free_[size_class];
}

// A large block's memory is counted as it is first used.
void Heap::touch(Block& block, std::size_t length) {
  const std::uint64_t needed = (length + 2 * kHeapPage - 1) / kHeapPage * kHeapPage;
  if (needed > block.touched) reserve(needed - block.touched);
  idle_ -= block.touched;
  block.touched = std::max(block.touched, needed);
}

void Heap::reserve(std::uint64_t bytes) {
  Header& header = segment_.header();
  if (header.used.fetch_add(bytes) + bytes <= header.limit) return;
  header.used.fetch_sub(bytes);
  fail_full();
}

void Heap::fail_full() const {
  throw Failure("messages that nobody has received yet take all the " + mebibytes(segment_.header().limit) +
                    " that this machine's processes may use for them",
                "", "receive before so much is sent, or set MARS_NX_MEMORY to more MiB");
}

// Gives the pages after the block's first back; its addresses stay.
void Heap::hollow(Block& block, Offset offset) {
  const std::uint64_t first = (offset + sizeof(Block) + kHeapPage - 1) / kHeapPage * kHeapPage;
  const std::uint64_t last = (offset + block_size(block.size_class)) / kHeapPage * kHeapPage;
  if (fallocate(segment_.descriptor(), FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(first),
                static_cast<off_t>(last - first)) != 0)
    return;
  idle_ -= block.touched;
  segment_.header().used.fetch_sub(block.touched);
  block.touched = 0;
}

}  // namespace mars::processes
