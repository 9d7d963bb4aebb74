#include "node/group/depth_exchange.h"

#include <cstddef>

#include "hal/failure/failure.h"
#include "hal/nx/nx_messages.h"
#include "node/wire/protocol.h"

namespace mars::group {

// The lines that each node sends, and their receivers.
class DepthExchange::Plan {
 public:
  Plan(const DepthNeeds& needs, const raster::Neighbours& neighbours) : needs_(needs), neighbours_(neighbours) {}

  int self() const { return static_cast<int>(mynode()); }
  int first() const { return needs_.group.first; }
  int last() const { return needs_.group.first + needs_.group.count; }

  bool contributes(int node) const { return needs_.contributes[index(node)] == 1; }
  bool share_a_machine(int a, int b) const { return neighbours_.are(a, b); }
  // Whether it is the head of a machine with contributors.
  bool collects(int node) const {
    if (neighbours_.head_of(node) != node) return false;
    for (int other = first(); other < last(); ++other)
      if (contributes(other) && share_a_machine(node, other)) return true;
    return false;
  }

  // Needed lines that `node` is home of.
  geometry::LineRange lines_of(int node) const { return geometry::overlap(needs_.homes[index(node)], needs_.lines); }
  // Those that a message must carry; none within a machine, where an empty one says that they are written.
  geometry::LineRange travelling(int from, int to) const {
    return share_a_machine(from, to) ? geometry::LineRange{} : lines_of(from);
  }

 private:
  std::size_t index(int node) const { return static_cast<std::size_t>(node - needs_.group.first); }

  const DepthNeeds& needs_;
  const raster::Neighbours& neighbours_;
};

void DepthExchange::complete(const DepthNeeds& needs, raster::Czb& czb) {
  const Plan plan(needs, neighbours_);
  const int self = plan.self();
  send_home_lines(plan, czb);
  if (plan.collects(self)) {
    collect_lines(plan, czb);
    notify_contributors(plan);
  } else if (plan.contributes(self)) {
    crecv(wire::kDepthLines, nullptr, 0);
  }
  pending_.wait();
}

void DepthExchange::send_home_lines(const Plan& plan, raster::Czb& czb) {
  const int self = plan.self();
  if (plan.lines_of(self).count() == 0) return;
  for (int to = plan.first(); to < plan.last(); ++to) {
    if (to == self || !plan.collects(to)) continue;
    const auto depth = czb.lines(plan.travelling(self, to));
    pending_.add(isend(wire::kDepthLines, depth.data(), static_cast<long>(depth.size_bytes()), to, 0));
  }
}

void DepthExchange::collect_lines(const Plan& plan, raster::Czb& czb) {
  const int self = plan.self();
  int left = 0;
  for (int from = plan.first(); from < plan.last(); ++from) left += from != self && plan.lines_of(from).count() > 0;
  for (; left > 0; --left) {
    cprobe(wire::kDepthLines);
    const auto depth = czb.lines(plan.travelling(static_cast<int>(infonode()), self));
    check(static_cast<std::size_t>(infocount()) == depth.size_bytes(), "CZB comes for the lines that are needed");
    crecv(wire::kDepthLines, depth.data(), static_cast<long>(depth.size_bytes()));
  }
}

void DepthExchange::notify_contributors(const Plan& plan) const {
  const int self = plan.self();
  for (int node = plan.first(); node < plan.last(); ++node)
    if (node != self && plan.contributes(node) && plan.share_a_machine(self, node))
      csend(wire::kDepthLines, nullptr, 0, node, 0);
}

}  // namespace mars::group
