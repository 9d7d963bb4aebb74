#include "topology/memory_limit.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <string>

#include "topology/control_groups.h"

namespace mars::topology {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLeastShare = std::uint64_t{1} << 20;  // with less the node itself reports what it lacks
constexpr std::uint64_t kUnknownMemory = std::uint64_t{1} << 30;
constexpr std::uint64_t kNoLimit = std::uint64_t{1} << 62;  // version 1 writes "none" as a number near 2^63

std::uint64_t lesser(std::uint64_t a, std::uint64_t b) { return a == 0 || (b != 0 && b < a) ? b : a; }

// 0 where there is no file or no number in it ("max").
std::uint64_t read_limit(const fs::path& file) {
  std::uint64_t bytes = 0;
  if (!(std::ifstream(file) >> bytes) || bytes >= kNoLimit) return 0;
  return bytes;
}

// Version 2 and version 1 name the file differently.
std::uint64_t group_limit(const fs::path& root) {
  std::uint64_t least = 0;
  for (const fs::path& group : control_groups("memory", root))
    least = lesser(least, lesser(read_limit(group / "memory.max"), read_limit(group / "memory.limit_in_bytes")));
  return least;
}

}  // namespace

// The first and the sixth number of statm, in pages.
ProcessMemory process_memory(const fs::path& root) {
  std::uint64_t addresses = 0, resident, shared, text, libraries, data = 0;
  std::ifstream(root / "proc/self/statm") >> addresses >> resident >> shared >> text >> libraries >> data;
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return {addresses * page, data * page};
}

std::uint64_t MemoryLimit::least() const { return lesser(together, lesser(each.addresses, each.data)); }

MemoryLimit memory_limit(const fs::path& root) { return {group_limit(root), process_limit(), process_memory(root)}; }

std::uint64_t usable_memory() {
  const std::uint64_t bytes = std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE));
  const std::uint64_t limit = memory_limit().least();
  return limit == 0 ? bytes : std::min(bytes, limit);
}

std::string gigabytes(std::uint64_t bytes) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.1f GB", static_cast<double>(bytes) / 1e9);
  return text.data();
}

std::uint64_t memory_share(std::uint64_t machine_bytes, const MemoryLimit& limit, int processes, int threads) {
  const std::uint64_t known = machine_bytes != 0 ? machine_bytes : kUnknownMemory;
  std::uint64_t share = std::min(kMostShare, lesser(known, limit.together) / static_cast<std::uint64_t>(processes) / 2);
  const auto limit_to = [&](std::uint64_t most, std::uint64_t used, int parts) {
    if (most == 0) return;
    const std::uint64_t left = most - std::min(most, used);
    share = std::min(share, std::max(kLeastShare, left / static_cast<std::uint64_t>(parts)));
  };
  // A process sees the memory of all nodes here, and shares none that takes more than half of its addresses. A thread's
  // memory beside its frame has its addresses from the start, but becomes data only later.
  limit_to(limit.each.addresses, limit.used.addresses, processes == 1 ? 2 : 4 * processes);
  limit_to(limit.each.data, limit.used.data, 4 * threads);
  return share;
}

}  // namespace mars::topology
