#include "node/group/band_exchange.h"

#include <algorithm>

#include "hal/nx/nx_messages.h"
#include "node/group/collectors.h"
#include "node/wire/commands.h"
#include "node/wire/protocol.h"
#include "node/wire/still_plan.h"

namespace mars::group {

// Who has which bands.
class BandExchange::Plan : public Collectors {
 public:
  Plan(const BandNeeds& needs, const raster::Neighbours& neighbours, std::span<std::uint8_t> collectors,
       std::uint32_t lines_of_band)
      : Collectors(needs.group, needs.contributes, neighbours, collectors),
        homes_(needs.homes),
        lines_of_band_(lines_of_band),
        writer_(needs.writer) {}

  int writer() const { return writer_; }
  const geometry::LineRange& home(int node) const { return homes_[index(node)]; }
  bool draws(int node) const { return home(node).count() > 0; }

  // Whether the node's first lines are of a band that begins in another's home.
  bool has_edge(int node) const { return draws(node) && home(node).first % lines_of_band_ != 0; }
  // Who composes the band with the node's first lines.
  int composer_of_edge(int node) const { return home_of(home(node).first / lines_of_band_ * lines_of_band_); }
  // Whether a band begins there, which the node composes.
  bool composes(int node) const {
    const geometry::LineRange& lines = home(node);
    return draws(node) && (lines.first + lines_of_band_ - 1) / lines_of_band_ * lines_of_band_ < lines.last;
  }

 private:
  int home_of(std::uint32_t line) const {
    const auto found = std::ranges::find_if(homes_, [&](const geometry::LineRange& home) { return home.has(line); });
    return first() + static_cast<int>(found - homes_.begin());
  }

  const std::span<const geometry::LineRange> homes_;
  const std::uint32_t lines_of_band_;
  const int writer_;
};

// What inbetweens need of bands.
class BandExchange::Background : public Relayed {
 public:
  Background(const Plan& plan, wire::FrameWriter& writer) : plan_(plan), writer_(writer) {}

  bool has_part(int node) const override { return plan_.composes(node); }
  bool is_left() const override { return writer_.has_background(); }
  std::size_t fill(std::span<std::byte> piece) override {
    const std::span<const std::byte> bands = writer_.next_background(wire::kRelayPiece);
    std::ranges::copy(bands, piece.begin());
    return bands.size();
  }
  void take(int, std::span<const std::byte> piece) override { writer_.add_background(piece); }

 private:
  const Plan& plan_;
  wire::FrameWriter& writer_;
};

BandExchange::BandExchange(const raster::Neighbours& neighbours, const wire::FrameWriter& writer)
    : neighbours_(neighbours),
      relay_(wire::kBackground, writer.most_band_bytes(), "bands"),
      pending_(static_cast<std::size_t>(neighbours.group().count)),
      collectors_(static_cast<std::size_t>(neighbours.group().count)) {}

void BandExchange::exchange_edges(const BandNeeds& needs, wire::FrameWriter& writer) {
  exchange_edges(Plan(needs, neighbours_, collectors_, writer.lines_of_band()), writer);
}

void BandExchange::complete(const BandNeeds& needs, wire::FrameWriter& writer) {
  const Plan plan(needs, neighbours_, collectors_, writer.lines_of_band());
  Background background(plan, writer);
  relay_.exchange(plan, background);
  send_picture(plan, writer);
  collect_picture(plan, writer);
  pending_.wait();
}

void BandExchange::exchange_edges(const Plan& plan, wire::FrameWriter& writer) {
  const int self = plan.self();
  if (plan.has_edge(self)) send(wire::kEdge, writer.edge(), plan.composer_of_edge(self));
  for (int node = self + 1; node < plan.last(); ++node)
    if (plan.has_edge(node) && plan.composer_of_edge(node) == self) writer.add_edge(receive(wire::kEdge, plan));
}

void BandExchange::send_picture(const Plan& plan, wire::FrameWriter& writer) {
  const int self = plan.self();
  if (plan.composes(self) && plan.writer() != self) send(wire::kPicture, writer.picture(), plan.writer());
}

void BandExchange::collect_picture(const Plan& plan, wire::FrameWriter& writer) {
  const int self = plan.self();
  if (plan.writer() != self) return;
  writer.add_picture(writer.picture());
  for (int from = plan.first(); from < plan.last(); ++from)
    if (from != self && plan.composes(from)) writer.add_picture(receive(wire::kPicture, plan));
}

void BandExchange::send(long type, std::span<const std::byte> message, int to) {
  pending_.add(isend(type, message.data(), static_cast<long>(message.size()), to, 0));
}

std::span<const std::byte> BandExchange::receive(long type, const Plan& plan) {
  cprobe(type);
  wire::require_sense(plan.has(static_cast<int>(infonode())), static_cast<int>(infonode()), "bands");
  message_.resize(static_cast<std::size_t>(infocount()));
  crecv(type, message_.data(), infocount());
  return message_;
}

}  // namespace mars::group
