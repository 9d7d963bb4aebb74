// The memory that the processes of one machine share to be the ranks of one job: what stands where in it. All
// is zero at the start, addresses are offsets, and what several processes change is one atomic word,
// changed by one instruction: so any of them may be killed at any instant and the others go on. Slot i is
// node i; the host's is the last.
//
//   Header | Slot of each rank | heap of each rank | memory that share() gives
//
// A message is a Block in its sender's heap. It is pushed on the receiver's `arrived`, copied out, and pushed
// on the `returned` of the slot that it belongs to.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace mars::processes {

using Offset = std::uint64_t;  // from the segment's begin; 0: none

struct alignas(64) Block {
  enum class State : std::uint32_t { free, used };

  Offset next;            // in the list it is in
  std::uint64_t length;   // of the message, whose bytes follow the block
  std::uint64_t touched;  // bytes of it that have taken memory
  std::int32_t type;
  std::uint32_t from;
  std::uint32_t size_class;  // 2^size_class bytes
  State state;               // changed by the heap's owner alone
  std::uint32_t sent;        // the job's age then

  std::byte* bytes() { return reinterpret_cast<std::byte*>(this + 1); }
};

// Blocks that anyone pushes and one takes, all at once: the last pushed is the first.
using BlockStack = std::atomic<Offset>;

enum class Life : std::uint32_t {
  none,     // nothing runs, or nothing is known of it
  started,  // a process runs, which has made no NX call yet
  joined,
  left,   // in order; its process is about to end
  ended,  // in order; its code is known
  died,
};

enum class Waiting : std::uint32_t {
  no,
  for_message,  // and can do nothing before one comes
  for_end,      // of another process
};

struct alignas(64) Slot {
  BlockStack arrived;                 // messages to this rank
  std::atomic<std::uint32_t> asleep;  // 1: waits on this word (a futex), woken by the process that makes it 0
  std::atomic<Waiting> waiting;
  alignas(64) BlockStack returned;   // blocks of this rank's heap
  alignas(64) Offset carved;         // bytes of its heap that are blocks; changed by the owner alone
  std::atomic<Offset> seen;          // messages taken from `arrived`, the next one first; by the receiver
  std::atomic<std::uint64_t> taken;  // messages
  std::atomic<Life> life;
  std::atomic<std::int32_t> code;  // of an ended one; minus the signal of one that died
  // The job's age when its process began, and when the one before that or, where none runs, the last ended.
  std::atomic<std::uint32_t> begun;
  std::atomic<std::uint32_t> ended;
};

// One memory that all nodes share: granted to all or to none.
struct Share {
  enum : std::uint32_t { open, granted, refused };
  std::atomic<std::uint32_t> state;
  std::atomic<std::int32_t> holders;  // that have let go
};

inline constexpr int kShares = 256;  // at a time

struct alignas(64) Header {
  std::int32_t nodes;  // the machine's
  std::int32_t has_host;
  std::atomic<std::int32_t> cube;       // number of them, the first ones, that are the cube
  std::atomic<std::uint32_t> age;       // begins and ends of processes so far
  std::uint64_t heap_capacity;          // addresses that each heap has
  std::uint64_t limit;                  // bytes that messages under way may take in all heaps
  std::atomic<std::uint64_t> used;      // bytes in use
  std::atomic<std::int32_t> finished;   // ranks that have come to their orderly end
  std::atomic<std::uint32_t> stopped;   // 1: the reason is not there yet; 2: `reason` can be read
  std::atomic<std::uint32_t> stopping;  // the process that adds first writes the reason
  char reason[1000];
  Share shares[kShares];
};

// One process's view of a segment.
class Segment {
 public:
  // A new one, for `nodes` nodes and perhaps a host. Throws Failure.
  Segment(int nodes, bool host, std::uint64_t limit);
  // The one that another process made, from the descriptor it left open to us.
  explicit Segment(int descriptor);
  ~Segment();
  Segment(const Segment&) = delete;
  Segment& operator=(const Segment&) = delete;

  Header& header() const { return *reinterpret_cast<Header*>(base_); }
  int nodes() const { return header().nodes; }
  int slots() const { return header().nodes + header().has_host; }
  Slot& slot(int index) const { return slots_[index]; }
  Offset heap(int index) const { return heaps_ + index * header().heap_capacity; }
  Block& block(Offset offset) const { return *reinterpret_cast<Block*>(base_ + offset); }
  // Whose heap it is in.
  int owner(Offset block) const { return static_cast<int>((block - heaps_) / header().heap_capacity); }
  Offset shared_memory() const { return heaps_ + slots() * header().heap_capacity; }
  int descriptor() const { return descriptor_; }

  void push(BlockStack& stack, Offset block) const;
  // Gives the block back to its heap's owner.
  void give_back(Offset block) const { push(slot(owner(block)).returned, block); }
  // Throws away all messages to a rank that has gone.
  void flush(int index) const;

  // Waits, at most so long, unless `asleep` was made 0 since the caller made it 1.
  static void sleep(Slot& slot, std::int64_t nanoseconds);
  static void wake(Slot& slot);
  void wake_all() const;

  // Ends the messages of all ranks, whose next call fails for `reason`; the first reason counts.
  void stop(const std::string& reason) const;
  bool stopped() const { return header().stopped.load(std::memory_order_relaxed) != 0; }
  std::string reason() const;
  // Forgets it; once all processes that may have seen it are gone.
  void go_on() const;

 private:
  void map();

  int descriptor_;
  std::size_t mapped_ = 0;  // bytes
  std::byte* base_ = nullptr;
  Slot* slots_ = nullptr;
  Offset heaps_ = 0;
};

}  // namespace mars::processes
