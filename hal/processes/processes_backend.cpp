#include "hal/processes/processes_backend.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "hal/failure/failure.h"
#include "hal/messages/memory_file.h"
#include "topology/processor_limit.h"

namespace mars::processes {
namespace {

constexpr std::size_t kSharedPage = 4096;

// A message may come at once from a process on another processor; where processes share one, not before this process
// has yielded.
constexpr int kLooks = 20;   // turns
constexpr int kYields = 10;  // turns after these
constexpr int kLooksATurn = 32;
// A caller that lets that much time pass has nothing to do before a message comes.
constexpr std::chrono::microseconds kPatience{5000};

std::size_t whole_shared_pages(std::size_t bytes) { return (bytes + kSharedPage - 1) / kSharedPage * kSharedPage; }

}  // namespace

ProcessesBackend::ProcessesBackend(const Segment& segment, int index)
    : segment_(segment),
      index_(index),
      slot_(segment.slot(index)),
      ended_before_(slot_.ended),
      heap_(segment, index),
      oversubscribed_(segment.nodes() > topology::usable_processors()),
      next_shared_(segment.shared_memory()) {
  slot_.waiting = Waiting::no;  // as the process before this one may have been
}

void ProcessesBackend::check_running() const {
  if (segment_.stopped()) throw Failure(segment_.reason(), "", "");
}

// One that has ended before this process began is to be followed by another.
bool ProcessesBackend::will_not_receive(const Slot& receiver) const {
  const Life life = receiver.life;
  if (life == Life::ended || life == Life::died) return slot_.begun < receiver.ended;
  return life == Life::left;
}

void ProcessesBackend::send(int to, int type, const void* data, std::size_t length) {
  check_running();
  const int target = index(to);
  Slot& receiver = segment_.slot(target);
  const std::uint32_t now = segment_.header().age;
  if (will_not_receive(receiver)) return;
  const Offset offset = heap_.acquire(length);
  Block& block = segment_.block(offset);
  block.type = type;
  block.from = static_cast<std::uint32_t>(index_);
  block.sent = now;
  if (length > 0) std::memcpy(block.bytes(), data, length);
  segment_.push(receiver.arrived, offset);
  if (target != index_) Segment::wake(receiver);
}

// Were the sender to end, its buffer would be gone under the receiver's hands: a copy is needed here too.
messages::Ticket ProcessesBackend::start_send(int to, int type, const void* data, std::size_t length) {
  send(to, type, data, length);
  return 0;
}

// The message that is next, or 0. One that was under way to the process before this one is discarded.
Offset ProcessesBackend::first_seen() {
  for (;;) {
    const Offset first = slot_.seen.load(std::memory_order_relaxed);
    if (first == 0 && !see_arrived()) return 0;
    if (first == 0) continue;
    const Block& block = segment_.block(first);
    if (block.sent >= ended_before_) return first;
    slot_.seen.store(block.next, std::memory_order_relaxed);
    segment_.give_back(first);
  }
}

// Takes what has arrived, which is then in the order of arrival.
bool ProcessesBackend::see_arrived() {
  Offset first = 0;
  for (Offset at = slot_.arrived.load(std::memory_order_relaxed) == 0 ? 0 : slot_.arrived.exchange(0); at != 0;)
    first = std::exchange(at, std::exchange(segment_.block(at).next, first));
  if (first == 0) return false;
  slot_.seen = first;
  slot_.waiting.store(Waiting::no, std::memory_order_relaxed);
  return true;
}

std::optional<messages::Envelope> ProcessesBackend::peek() {
  check_running();
  const Offset offset = first_seen();
  if (offset == 0) return std::nullopt;
  const Block& block = segment_.block(offset);
  return messages::Envelope{id(static_cast<int>(block.from)), block.type, block.length};
}

void ProcessesBackend::take(void* buffer) {
  const Offset offset = slot_.seen.load(std::memory_order_relaxed);
  Block& block = segment_.block(offset);
  if (block.length > 0) std::memcpy(buffer, block.bytes(), block.length);
  slot_.seen.store(block.next, std::memory_order_relaxed);
  slot_.taken.store(slot_.taken.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  segment_.give_back(offset);
}

void ProcessesBackend::idle(int turn, std::chrono::microseconds longest) {
  check_running();
  const int looks = oversubscribed_ ? 0 : kLooks;
  if (turn < looks) {
    for (int i = 0; i < kLooksATurn && slot_.arrived.load(std::memory_order_relaxed) == 0; ++i) __builtin_ia32_pause();
    return;
  }
  if (turn < looks + kYields) {
    sched_yield();
    return;
  }
  slot_.waiting.store(longest >= kPatience ? Waiting::for_message : Waiting::no, std::memory_order_relaxed);
  slot_.asleep = 1;
  if (slot_.arrived.load() == 0 && !segment_.stopped())
    Segment::sleep(slot_, std::chrono::nanoseconds(longest).count());
  slot_.asleep = 0;
}

messages::Neighbourhood ProcessesBackend::neighbourhood() {
  check(rank() != host(), "the host is not one of a machine's nodes");
  return {0, rank(), nodes(), rank(), false};
}

// All nodes share in the same order, so each finds the same place by itself.
std::shared_ptr<std::byte> ProcessesBackend::share(std::size_t bytes) {
  check(rank() != host(), "the host takes no part in shared memory");
  const int number = shares_++ % kShares;
  Share& share = segment_.header().shares[number];
  std::uint32_t state = Share::open;
  const std::uint32_t verdict = bytes <= segment_.header().limit ? Share::granted : Share::refused;
  if (!share.state.compare_exchange_strong(state, verdict)) check(state == verdict, "all nodes share the same bytes");
  const std::size_t size = std::max(whole_shared_pages(bytes), kSharedPage);
  const Offset begin = std::exchange(next_shared_, next_shared_ + size);
  void* block = verdict == Share::refused ? MAP_FAILED
                                          : mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE,
                                                 segment_.descriptor(), static_cast<off_t>(begin));
  if (block == MAP_FAILED) {
    const Failure failure("the nodes of a machine cannot share " + std::to_string(bytes) + " bytes",
                          "node " + std::to_string(rank()),
                          "use a machine with more memory, or set MARS_NX_MEMORY to more MiB");
    if (verdict == Share::granted) segment_.stop(failure.what());  // the others have it, and would rely on this node
    throw failure;
  }
  return {static_cast<std::byte*>(block), [this, number, begin, size](std::byte* old) {
            munmap(old, size);
            release(number, begin, size);
          }};
}

void ProcessesBackend::release(int number, Offset begin, std::size_t bytes) {
  Share& share = segment_.header().shares[number];
  if (share.holders.fetch_add(1) + 1 < nodes()) return;
  fallocate(segment_.descriptor(), FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(begin),
            static_cast<off_t>(bytes));
  share.holders = 0;
  share.state = Share::open;
}

messages::Offer ProcessesBackend::offer(std::size_t bytes) {
  std::string refusal;
  return messages::offer_file(rank(), bytes, refusal);
}

std::shared_ptr<std::byte> ProcessesBackend::attach(int rank, const messages::MemoryName& name, std::size_t bytes) {
  std::string refusal;
  return messages::attach_file(rank, name, bytes, refusal);
}

bool ProcessesBackend::finish() {
  check_running();
  const int ranks = nodes() + segment_.header().has_host;
  if (!std::exchange(finishing_, true) && segment_.header().finished.fetch_add(1) + 1 == ranks) segment_.wake_all();
  return segment_.header().finished == ranks && !peek();
}

void ProcessesBackend::abort(const std::string& reason) {
  if (!segment_.stopped()) {
    std::fprintf(stderr, "mars: %s\n", reason.c_str());
    std::fflush(nullptr);
  }
  segment_.stop(reason);
  std::_Exit(1);
}

}  // namespace mars::processes
