#include "node/czb.h"

#include "hal/cube.h"
#include "hal/nx.h"

namespace mars::node {
namespace {

// The machine of each node.
std::vector<std::int32_t> machines() {
  std::vector<std::int32_t> all(static_cast<std::size_t>(numnodes()));
  const std::int32_t mine = hal::neighbourhood().machine;
  long bytes = 0;
  gcol(&mine, sizeof mine, all.data(), static_cast<long>(all.size() * sizeof mine), &bytes);
  return all;
}

}  // namespace

Czb::Czb(int cubes, std::int32_t width, std::int32_t height) : width_(static_cast<std::size_t>(width)) {
  const auto nodes = static_cast<int>(numnodes()), self = static_cast<int>(mynode());
  const std::vector<std::int32_t> machine = machines();
  const auto together = [&](int a, int b) { return machine[static_cast<std::size_t>(a)] == machine[static_cast<std::size_t>(b)]; };
  std::size_t shared = 0;        // by cubes with several nodes here
  std::optional<std::size_t> mine;  // its number among them
  for (int number = 0; number < cubes; ++number) {
    const hal::Cube cube = hal::cube_of(nodes, cubes, number);
    int here = 0;
    for (int node = cube.first; node < cube.first + cube.count; ++node) {
      int head = cube.first;
      while (!together(head, node)) ++head;
      heads_.push_back(head);
      here += together(node, self);
    }
    if (here < 2) continue;
    if (cube.first <= self && self < cube.first + cube.count) mine = shared;
    ++shared;
  }
  const std::size_t samples = width_ * static_cast<std::size_t>(height);
  if (shared > 0) shared_.emplace(shared * samples * sizeof(float));
  if (!mine) own_ = hal::PrivateMemory(samples * sizeof(float));
  const std::span<std::byte> block = mine ? shared_->bytes().subspan(*mine * samples * sizeof(float)) : own_.bytes();
  depth_ = reinterpret_cast<float*>(block.data());
}

std::span<float> Czb::lines(const LineRange& lines) { return {depth_ + lines.first * width_, lines.count() * width_}; }

}  // namespace mars::node
