// The machine this process runs on, as hwloc sees it, restricted to the processors the process was given; or
// a made-up machine from one hwloc string, so that placement is testable anywhere. Cores are numbered 0.. in
// hwloc's logical order, in which close cores (cache, NUMA domain) have close numbers. Failing calls throw
// std::runtime_error with the whole story.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "topology/placement.h"

struct hwloc_topology;

namespace mars::topology {

// Cores [first, first + count) of a machine.
struct Place {
  int first = 0;
  int count = 0;

  bool operator==(const Place&) const = default;
};

// The processors that a thread may run on, in the numbers of the whole machine (lstopo -l shows them).
struct Binding {
  std::string cores;   // "core 3", "cores 0-1,4"; "" if it may run on all
  int first_core = 0;  // the lowest of them
  Seat seat{};
};

class Machine {
 public:
  // This machine: what the cgroup and the affinity of the calling process leave of it. A quota of processors' time
  // lessens the counts, but not the cores to which a thread may be bound.
  static Machine here();
  // A machine as hwloc describes synthetic ones, e.g. "numa:2 l3:1 core:4 pu:2".
  static Machine synthetic(const std::string& description);

  Machine(Machine&&) noexcept;
  Machine& operator=(Machine&&) noexcept;
  ~Machine();

  int cores() const;             // whole cores; processors where the machine shows no cores
  int processors() const;        // hardware threads
  std::uint64_t memory() const;  // bytes, of their NUMA domains; 0: unknown

  // The cores of process `k` of `n` whose node ids begin at `first_id`: runs of neighbouring cores in order
  // of k, cut first where the ids differ in the highest bit and there at the machine's widest gap (package,
  // NUMA domain, cache), so that ids that differ in a low bit are close. Of the cores beyond n, up to
  // `reserved` at the end stay free (for the host's sinks). None where the processes exceed the cores: they
  // are better left to the scheduler.
  std::optional<Place> place(int k, int n, int reserved, int first_id = 0) const;

  // The parts of the machine that a process bound to `place` uses.
  Seat seat(const Place& place) const;

  // Binds the calling thread to a place.
  void bind_thread(const Place& place) const;

  // Of the calling thread.
  static Binding binding();

 private:
  explicit Machine(hwloc_topology* topology);
  static Machine load_here();  // not restricted to the affinity
  int limited(int count) const;
  int all_cores() const;  // that threads may be bound to
  int gap(int core) const;
  int cut(const Place& cores, int left, int right) const;

  struct Unload {
    void operator()(hwloc_topology* topology) const;
  };
  std::unique_ptr<hwloc_topology, Unload> topology_;
  int limit_ = 0;  // processors whose time the control groups leave; 0: all
};

}  // namespace mars::topology
