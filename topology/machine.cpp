#include "topology/machine.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <hwloc.h>

namespace mars::topology {
namespace {

using Bitmap = std::unique_ptr<hwloc_bitmap_s, decltype(&hwloc_bitmap_free)>;

Bitmap make_bitmap() { return {hwloc_bitmap_alloc(), &hwloc_bitmap_free}; }

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

hwloc_topology_t start_topology() {
  hwloc_topology_t topology = nullptr;
  if (hwloc_topology_init(&topology) != 0) fail("hwloc cannot start to look at this machine");
  return topology;
}

// Cores, or processors where the machine shows none (some virtual machines).
hwloc_obj_type_t unit(hwloc_topology_t topology) {
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

}  // namespace

void Machine::Unload::operator()(hwloc_topology* topology) const { hwloc_topology_destroy(topology); }

Machine::Machine(hwloc_topology* topology) : topology_(topology) {}
Machine::Machine(Machine&&) noexcept = default;
Machine& Machine::operator=(Machine&&) noexcept = default;
Machine::~Machine() = default;

Machine Machine::load_here() {
  Machine machine(start_topology());
  if (hwloc_topology_load(machine.topology_.get()) != 0) fail("hwloc cannot read this machine");
  return machine;
}

Machine Machine::here() {
  Machine machine = load_here();
  restrict_to_affinity(machine.topology_.get());
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

int Machine::cores() const { return count(topology_.get(), unit(topology_.get())); }
int Machine::processors() const { return count(topology_.get(), HWLOC_OBJ_PU); }
int Machine::numa_domains() const { return std::max(1, count(topology_.get(), HWLOC_OBJ_NUMANODE)); }
std::uint64_t Machine::memory() const { return hwloc_get_root_obj(topology_.get())->total_memory; }

std::optional<Place> Machine::place(int k, int n, int reserved) const {
  const int all = cores();
  if (k < 0 || k >= n || n > all) return std::nullopt;
  const long usable = all - std::min(reserved, all - n);
  const int first = static_cast<int>(k * usable / n);
  const int end = static_cast<int>((k + 1) * usable / n);
  return Place{first, end - first};
}

void Machine::bind(const Place& place, int flags) const {
  const Bitmap processors = make_bitmap();
  const Bitmap numbers = make_bitmap();
  hwloc_bitmap_set_range(numbers.get(), place.first, place.first + place.count - 1);
  if (place.first < 0 || place.count < 1 || place.first + place.count > cores()) {
    throw std::runtime_error("cannot bind to " + list(numbers.get()) + ": this process may use only " +
                             std::to_string(cores()) + " of the machine's cores");
  }
  for (int core = place.first; core < place.first + place.count; ++core) {
    const hwloc_obj_t object = hwloc_get_obj_by_type(topology_.get(), unit(topology_.get()), core);
    hwloc_bitmap_or(processors.get(), processors.get(), object->cpuset);
  }
  if (hwloc_set_cpubind(topology_.get(), processors.get(), flags) != 0) {
    fail("cannot bind to " + list(numbers.get()));
  }
}

void Machine::bind_thread(const Place& place) const { bind(place, HWLOC_CPUBIND_THREAD); }
void Machine::bind_process(const Place& place) const { bind(place, HWLOC_CPUBIND_PROCESS); }

std::string Machine::binding() {
  const Machine whole = load_here();
  const hwloc_topology_t topology = whole.topology_.get();
  const Bitmap mine = make_bitmap();
  if (hwloc_get_cpubind(topology, mine.get(), HWLOC_CPUBIND_THREAD) != 0) return "";
  if (hwloc_bitmap_isincluded(hwloc_topology_get_topology_cpuset(topology), mine.get())) return "";
  const Bitmap cores = make_bitmap();
  for (int core = 0; core < whole.cores(); ++core) {
    const hwloc_obj_t object = hwloc_get_obj_by_type(topology, unit(topology), core);
    if (hwloc_bitmap_intersects(object->cpuset, mine.get())) hwloc_bitmap_set(cores.get(), core);
  }
  return list(cores.get());
}

}  // namespace mars::topology
