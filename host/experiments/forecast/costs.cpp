#include "host/experiments/forecast/costs.h"

namespace mars::forecast {

double Costs::of(const wire::UnitCounts& units) const {
  double seconds = 0;
  for (std::size_t kind = 0; kind < units.units.size(); ++kind) seconds += machine_.work[kind] * units.units[kind];
  return seconds;
}

double Costs::on_the_way(double bytes, bool same_computer) const {
  const simulated::Network& network = machine_.network;
  if (same_computer) return network.local_latency + network.local_byte * bytes;
  return empty_on_the_way() + network.byte * bytes;
}

double Costs::empty_on_the_way() const {
  const simulated::Network& network = machine_.network;
  const double parts = network.topology == simulated::Topology::hypercube ? 1 : 2;
  return network.latency + parts * network.hop;
}

double Costs::answers(double messages, double bytes) const {
  const bool announced = bytes > messages * static_cast<double>(machine_.network.eager);
  return announced ? messages * 2 * empty_on_the_way() : 0;
}

double Costs::end(const std::vector<simulated::EndCost>& costs, double bytes) const {
  double seconds = 0;
  for (const simulated::EndCost& cost : costs)
    if (bytes >= static_cast<double>(cost.from)) seconds = cost.seconds;
  return seconds + machine_.network.copy_byte * bytes;
}

}  // namespace mars::forecast
