#include "hal/processes/segment.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "hal/failure/failure.h"
#include "hal/messages/futex.h"

namespace mars::processes {
namespace {

static_assert(std::atomic<Offset>::is_always_lock_free, "processes share these");

constexpr std::size_t kSegmentPage = 1 << 16;
// A heap has more addresses than it may use memory: blocks are rounded up, and may have given theirs back.
constexpr std::uint64_t kLeastCapacity = 1 << 26;
constexpr std::uint64_t kAllAddresses = std::uint64_t{1} << 45;
constexpr std::size_t kSharedAddresses = std::size_t{1} << 40;  // addresses, of which few are ever used

std::size_t whole_segment_pages(std::size_t bytes) { return (bytes + kSegmentPage - 1) / kSegmentPage * kSegmentPage; }

std::size_t front_size(int slots) { return whole_segment_pages(sizeof(Header) + slots * sizeof(Slot)); }

Failure no_memory(const std::string& what) {
  return Failure("the machine gives no memory that its processes could share: " + what, "",
                 "see ulimit -v, or use fewer nodes");
}

}  // namespace

Segment::Segment(int nodes, bool host, std::uint64_t limit) : descriptor_(memfd_create("mars-nx", MFD_CLOEXEC)) {
  const int slots = nodes + host;
  const std::size_t capacity =
      whole_segment_pages(std::min<std::uint64_t>(8 * limit + kLeastCapacity, kAllAddresses / slots));
  const std::size_t size = front_size(slots) + slots * capacity + kSharedAddresses;
  if (descriptor_ < 0 || ftruncate(descriptor_, static_cast<off_t>(size)) != 0) throw no_memory(std::strerror(errno));
  mapped_ = front_size(slots);
  map();
  header().nodes = nodes;
  header().has_host = host;
  header().cube = nodes;
  header().heap_capacity = capacity;
  header().limit = limit;
  munmap(base_, mapped_);
  mapped_ = size - kSharedAddresses;
  map();
}

Segment::Segment(int descriptor) : descriptor_(descriptor) {
  struct stat file = {};
  if (fstat(descriptor, &file) != 0) throw no_memory(std::strerror(errno));
  mapped_ = static_cast<std::size_t>(file.st_size) - kSharedAddresses;
  map();
}

Segment::~Segment() {
  munmap(base_, mapped_);
  close(descriptor_);
}

void Segment::map() {
  void* base = mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE, descriptor_, 0);
  if (base == MAP_FAILED) throw no_memory(std::strerror(errno));
  base_ = static_cast<std::byte*>(base);
  slots_ = reinterpret_cast<Slot*>(base_ + sizeof(Header));
  heaps_ = front_size(slots());
}

void Segment::push(BlockStack& stack, Offset block) const {
  Offset first = stack.load(std::memory_order_relaxed);
  do {
    this->block(block).next = first;
  } while (!stack.compare_exchange_weak(first, block));
}

void Segment::flush(int index) const {
  for (BlockStack* stack : {&slot(index).arrived, &slot(index).seen}) {
    for (Offset at = stack->exchange(0); at != 0;) {
      const Offset next = block(at).next;
      give_back(at);
      at = next;
    }
  }
}

void Segment::sleep(Slot& slot, std::int64_t nanoseconds) {
  const timespec timeout{nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000};
  messages::futex(slot.asleep, FUTEX_WAIT, 1, &timeout);
}

// The waker has written its message before; the sleeper looks for one after it has written `asleep`: one sees the
// other.
void Segment::wake(Slot& slot) {
  if (slot.asleep.load() == 1 && slot.asleep.exchange(0) == 1) messages::futex(slot.asleep, FUTEX_WAKE, 1, nullptr);
}

void Segment::wake_all() const {
  for (int index = 0; index < slots(); ++index) wake(slot(index));
}

void Segment::stop(const std::string& reason) const {
  if (header().stopping.fetch_add(1) == 0) {
    const std::size_t length = std::min(reason.size(), sizeof header().reason - 1);
    std::memcpy(header().reason, reason.data(), length);
    header().reason[length] = 0;
    header().stopped = 2;
  } else if (header().stopped == 0) {
    header().stopped = 1;
  }
  wake_all();
}

std::string Segment::reason() const {
  return header().stopped == 2 ? header().reason : "another process of this job has failed";
}

void Segment::go_on() const {
  header().stopped = 0;
  header().stopping = 0;
}

}  // namespace mars::processes
