#include "topology/machine.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <new>
#include <stdexcept>
#include <utility>

#include <hwloc.h>

#include "topology/processor_limit.h"

namespace mars::topology {
namespace {

constexpr std::size_t kBytesToLoad = std::size_t{16} << 20;  // a machine of 256 processors takes some 2 MiB

using Bitmap = std::unique_ptr<hwloc_bitmap_s, decltype(&hwloc_bitmap_free)>;

Bitmap make_bitmap() { return {hwloc_bitmap_alloc(), &hwloc_bitmap_free}; }

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what + ": " + std::strerror(errno)); }

hwloc_topology_t start_topology() {
  hwloc_topology_t topology = nullptr;
  if (hwloc_topology_init(&topology) != 0) fail("hwloc cannot start to look at this machine");
  return topology;
}

// Cores, or processors where the machine shows none (some virtual machines).
hwloc_obj_type_t core_type(hwloc_topology_t topology) {
  return hwloc_get_nbobjs_by_type(topology, HWLOC_OBJ_CORE) > 0 ? HWLOC_OBJ_CORE : HWLOC_OBJ_PU;
}

int count(hwloc_topology_t topology, hwloc_obj_type_t type) {
  const int objects = hwloc_get_nbobjs_by_type(topology, type);
  return objects > 0 ? objects : 0;
}

// A process that may run on a part of the machine sees only that part.
void restrict_to_affinity(hwloc_topology_t topology) {
  const Bitmap mine = make_bitmap();
  if (hwloc_get_cpubind(topology, mine.get(), HWLOC_CPUBIND_THREAD) != 0) return;
  if (hwloc_bitmap_iszero(mine.get())) return;
  if (hwloc_topology_restrict(topology, mine.get(), 0) != 0)
    fail("hwloc cannot restrict the machine to this process's processors");
}

std::string list(hwloc_const_bitmap_t cores) {
  char text[256] = "";
  hwloc_bitmap_list_snprintf(text, sizeof text, cores);
  return (hwloc_bitmap_weight(cores) == 1 ? "core " : "cores ") + std::string(text);
}

// That the calling thread may use; all of them where the system does not say.
Bitmap bound_processors(hwloc_topology_t topology) {
  Bitmap mine = make_bitmap();
  if (hwloc_get_cpubind(topology, mine.get(), HWLOC_CPUBIND_THREAD) != 0)
    hwloc_bitmap_copy(mine.get(), hwloc_topology_get_topology_cpuset(topology));
  return mine;
}

Bitmap processors_of(hwloc_topology_t topology, const Place& place) {
  Bitmap processors = make_bitmap();
  for (int core = place.first; core < place.first + place.count; ++core)
    hwloc_bitmap_or(processors.get(), processors.get(),
                    hwloc_get_obj_by_type(topology, core_type(topology), core)->cpuset);
  return processors;
}

// The numbers of the cores that have one of `processors`.
Bitmap cores_of(hwloc_topology_t topology, hwloc_const_bitmap_t processors) {
  Bitmap cores = make_bitmap();
  for (int core = 0; core < count(topology, core_type(topology)); ++core)
    if (hwloc_bitmap_intersects(hwloc_get_obj_by_type(topology, core_type(topology), core)->cpuset, processors))
      hwloc_bitmap_set(cores.get(), core);
  return cores;
}

// The number of the part of one kind that holds all `processors`; -1: none does.
int holder(hwloc_topology_t topology, hwloc_obj_type_t type, hwloc_const_bitmap_t processors) {
  for (hwloc_obj_t part = nullptr; (part = hwloc_get_next_obj_by_type(topology, type, part)) != nullptr;)
    if (hwloc_bitmap_isincluded(processors, part->cpuset)) return static_cast<int>(part->logical_index);
  return -1;
}

Seat seat_of(hwloc_topology_t topology, hwloc_const_bitmap_t processors) {
  constexpr std::array<hwloc_obj_type_t, kParts> types{HWLOC_OBJ_CORE, HWLOC_OBJ_L2CACHE, HWLOC_OBJ_L3CACHE,
                                                       HWLOC_OBJ_NUMANODE, HWLOC_OBJ_PACKAGE};
  Seat seat;
  std::transform(types.begin(), types.end(), seat.begin(),
                 [&](hwloc_obj_type_t type) { return holder(topology, type, processors); });
  return seat;
}

// The number in (first, end) that most zero bits end: below and from it on, ids differ in the highest bit.
int highest_boundary(int first, int end) {
  int boundary = end - 1;
  while ((boundary & (boundary - 1)) > first) boundary &= boundary - 1;
  return boundary;
}

}  // namespace

void Machine::Unload::operator()(hwloc_topology* topology) const { hwloc_topology_destroy(topology); }

Machine::Machine(hwloc_topology* topology) : topology_(topology) {}
Machine::Machine(Machine&&) noexcept = default;
Machine& Machine::operator=(Machine&&) noexcept = default;
Machine::~Machine() = default;

// hwloc does not survive an allocation that fails.
Machine Machine::load_here() {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  ::operator delete(::operator new(kBytesToLoad));
  Machine machine(start_topology());
  if (hwloc_topology_load(machine.topology_.get()) != 0) fail("hwloc cannot read this machine");
  return machine;
}

Machine Machine::here() {
  Machine machine = load_here();
  restrict_to_affinity(machine.topology_.get());
  machine.limit_ = processor_limit();
  return machine;
}

Machine Machine::synthetic(const std::string& description) {
  Machine machine(start_topology());
  if (hwloc_topology_set_synthetic(machine.topology_.get(), description.c_str()) != 0 ||
      hwloc_topology_load(machine.topology_.get()) != 0) {
    fail("hwloc does not understand the machine \"" + description + "\"");
  }
  return machine;
}

int Machine::limited(int count) const { return limit_ == 0 ? count : std::min(count, limit_); }
int Machine::all_cores() const { return count(topology_.get(), core_type(topology_.get())); }
int Machine::cores() const { return limited(all_cores()); }
int Machine::processors() const { return limited(count(topology_.get(), HWLOC_OBJ_PU)); }
std::uint64_t Machine::memory() const { return hwloc_get_root_obj(topology_.get())->total_memory; }

// How much lies between a core and the one before: less the more they share.
int Machine::gap(int core) const {
  const auto object = [&](int number) {
    return hwloc_get_obj_by_type(topology_.get(), core_type(topology_.get()), number);
  };
  return -hwloc_get_common_ancestor_obj(topology_.get(), object(core - 1), object(core))->depth;
}

// Where to cut `cores` for `left` processes before and `right` behind: at the widest gap that leaves each a
// core, and of equal ones where both sides have most alike.
int Machine::cut(const Place& cores, int left, int right) const {
  const int even = cores.first + cores.count * left / (left + right);
  int best = 0;
  for (int core = cores.first + left; core <= cores.first + cores.count - right; ++core) {
    const auto worth = [&](int at) { return std::pair(gap(at), -std::abs(at - even)); };
    if (best == 0 || worth(core) > worth(best)) best = core;
  }
  return best;
}

std::optional<Place> Machine::place(int k, int n, int reserved, int first_id) const {
  const int all = all_cores();
  if (k < 0 || k >= n || n > cores()) return std::nullopt;
  Place cores{0, all - std::min(reserved, all - n)};
  int first = first_id;
  int end = first_id + n;
  while (end - first > 1) {
    const int middle = highest_boundary(first, end);
    const int core = cut(cores, middle - first, end - middle);
    if (first_id + k < middle) {
      end = middle;
      cores.count = core - cores.first;
    } else {
      first = middle;
      cores = {core, cores.first + cores.count - core};
    }
  }
  return cores;
}

Seat Machine::seat(const Place& place) const {
  const Bitmap processors = processors_of(topology_.get(), place);
  return seat_of(topology_.get(), processors.get());
}

void Machine::bind_thread(const Place& place) const {
  const Bitmap numbers = make_bitmap();
  hwloc_bitmap_set_range(numbers.get(), place.first, place.first + place.count - 1);
  if (place.first < 0 || place.count < 1 || place.first + place.count > all_cores()) {
    throw std::runtime_error("cannot bind to " + list(numbers.get()) + ": this process may use only " +
                             std::to_string(all_cores()) + " of the machine's cores");
  }
  const Bitmap processors = processors_of(topology_.get(), place);
  if (hwloc_set_cpubind(topology_.get(), processors.get(), HWLOC_CPUBIND_THREAD) != 0) {
    fail("cannot bind to " + list(numbers.get()));
  }
}

Binding Machine::binding() {
  const Machine whole = load_here();
  const hwloc_topology_t topology = whole.topology_.get();
  const Bitmap mine = bound_processors(topology);
  const Bitmap cores = cores_of(topology, mine.get());
  const bool free = hwloc_bitmap_isincluded(hwloc_topology_get_topology_cpuset(topology), mine.get());
  return {free ? "" : list(cores.get()), std::max(0, hwloc_bitmap_first(cores.get())), seat_of(topology, mine.get())};
}

}  // namespace mars::topology
