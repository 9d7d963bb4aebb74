#include "node/raster/czb.h"

#include "hal/collectives/group.h"
#include "hal/nx/nx_messages.h"

namespace mars::raster {

Czb::Czb(std::span<const std::int32_t> machines, int groups, std::int32_t width, std::int32_t height)
    : width_(static_cast<std::size_t>(width)) {
  const auto nodes = static_cast<int>(machines.size()), self = static_cast<int>(mynode());
  const auto machine = [&](int node) { return machines[static_cast<std::size_t>(node)]; };
  std::size_t shared = 0;           // by groups with several nodes here
  std::optional<std::size_t> mine;  // the caller's group's number among them
  for (int number = 0; number < groups; ++number) {
    const collectives::Group group = collectives::group_of(nodes, groups, number);
    int here = 0;
    for (int node = group.first; node < group.first + group.count; ++node) {
      int head = group.first;
      while (machine(head) != machine(node)) ++head;
      heads_.push_back(head);
      here += machine(node) == machine(self);
    }
    if (here < 2) continue;
    if (group.first <= self && self < group.first + group.count) mine = shared;
    ++shared;
  }
  const std::size_t samples = width_ * static_cast<std::size_t>(height);
  if (shared > 0) shared_.emplace(shared * samples * sizeof(float));
  if (!mine) own_ = messages::PrivateMemory(samples * sizeof(float));
  const std::span<std::byte> block = mine ? shared_->bytes().subspan(*mine * samples * sizeof(float)) : own_.bytes();
  depth_ = reinterpret_cast<float*>(block.data());
}

std::span<float> Czb::lines(const geometry::LineRange& lines) {
  return {depth_ + lines.first * width_, lines.count() * width_};
}

}  // namespace mars::raster
