#include "node/group/still_exchange.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "hal/nx/nx_messages.h"
#include "node/group/collectors.h"
#include "node/wire/commands.h"
#include "node/wire/protocol.h"

namespace mars::group {

// The lines that each node sends, and their receivers.
class StillExchange::Plan : public Collectors {
 public:
  Plan(const StillNeeds& needs, const geometry::LineRange& lines, const raster::Neighbours& neighbours,
       std::span<std::uint8_t> collectors)
      : Collectors(needs.group, needs.contributes, neighbours, collectors), homes_(needs.homes), lines_(lines) {}

  // Needed lines that `node` is home of.
  geometry::LineRange lines_of(int node) const { return geometry::overlap(homes_[index(node)], lines_); }

 private:
  const std::span<const geometry::LineRange> homes_;
  const geometry::LineRange lines_;  // that inbetweens may touch
};

StillExchange::StillExchange(const raster::Neighbours& neighbours, bool one_each, std::size_t height)
    : neighbours_(neighbours),
      one_each_(one_each),
      pending_(height),
      collectors_(static_cast<std::size_t>(neighbours.group().count)) {}

void StillExchange::complete(const StillNeeds& needs, raster::StillLines& still) {
  const Plan plan(needs, still.lines(), neighbours_, collectors_);
  const int self = plan.self();
  send_home_lines(plan, still);
  if (plan.collects(self)) {
    collect_lines(plan, still);
    notify_contributors(plan);
  } else if (plan.contributes(self)) {
    crecv(wire::kStillLines, nullptr, 0);
  }
  pending_.wait();
}

void StillExchange::send_home_lines(const Plan& plan, raster::StillLines& still) {
  const int self = plan.self();
  const geometry::LineRange lines = plan.lines_of(self);
  if (lines.count() == 0) return;
  bool is_packed = false;
  for (int to = plan.first(); to < plan.last(); ++to) {
    if (to == self || !plan.collects(to)) continue;
    if (plan.share_a_machine(self, to)) {
      pending_.add(isend(wire::kStillLines, nullptr, 0, to, 0));
      continue;
    }
    if (!std::exchange(is_packed, true)) pack(lines, still);
    send_lines(lines, to, still);
  }
}

// The same for all receivers.
void StillExchange::pack(const geometry::LineRange& lines, const raster::StillLines& still) {
  std::size_t bytes = one_each_ ? 0 : still.depth_bytes(lines);
  if (one_each_)
    for (std::uint32_t line = lines.first; line < lines.last; ++line) bytes += still.packed_bytes(line);
  if (packed_.size() < bytes) packed_.resize(bytes);
  if (!one_each_) return still.pack_depths(lines, packed_.data());
  std::byte* to = packed_.data();
  for (std::uint32_t line = lines.first; line < lines.last; ++line) {
    if (still.keeps(line)) still.pack(line, to);
    to += still.packed_bytes(line);
  }
}

void StillExchange::send_lines(const geometry::LineRange& lines, int to, const raster::StillLines& still) {
  const std::byte* next = packed_.data();
  const auto send = [&](std::size_t bytes) {
    pending_.add(isend(wire::kStillLines, next, static_cast<long>(bytes), to, 0));
    next += bytes;
  };
  if (!one_each_) return send(still.depth_bytes(lines));
  for (std::uint32_t line = lines.first; line < lines.last; ++line) send(still.packed_bytes(line));
}

void StillExchange::collect_lines(const Plan& plan, raster::StillLines& still) {
  const int self = plan.self();
  if (one_each_) line_.reserve(still.most_packed());
  std::size_t left = 0;
  for (int from = plan.first(); from < plan.last(); ++from) {
    const geometry::LineRange lines = plan.lines_of(from);
    if (from == self || lines.count() == 0) continue;
    left += plan.share_a_machine(from, self) ? 1 : messages_of(lines);
  }
  for (; left > 0; --left) receive_message(plan, still);
}

void StillExchange::receive_message(const Plan& plan, raster::StillLines& still) {
  cprobe(wire::kStillLines);
  const auto bytes = static_cast<std::size_t>(infocount());
  const int from = static_cast<int>(infonode());
  constexpr const char* kWhat = "still lines";
  wire::require_sense(plan.has(from), from, kWhat);
  line_.resize(std::max(line_.size(), bytes));
  crecv(wire::kStillLines, line_.data(), infocount());
  if (plan.share_a_machine(from, plan.self())) return wire::require_sense(bytes == 0, from, kWhat);
  if (!one_each_) {
    wire::require_sense(bytes == still.depth_bytes(plan.lines_of(from)), from, kWhat);
    return still.unpack_depths(plan.lines_of(from), line_.data());
  }
  if (bytes == 0) return;
  const auto line = std::span(std::as_const(line_)).first(bytes);
  wire::require_sense(still.is_packed(line), from, kWhat);
  still.unpack(line);
}

void StillExchange::notify_contributors(const Plan& plan) const {
  plan.for_others_here([](int node) { csend(wire::kStillLines, nullptr, 0, node, 0); });
}

}  // namespace mars::group
