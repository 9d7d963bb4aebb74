// What work and messages cost on a platform, as its simulation charges them.
#pragma once

#include <cstddef>
#include <vector>

#include "host/experiments/platform.h"
#include "node/wire/frame_counts.h"
#include "node/wire/protocol.h"

namespace mars::forecast {

class Costs {
 public:
  explicit Costs(const experiments::Platform& platform) : machine_(platform.machine) {}
  explicit Costs(const experiments::Platform&&) = delete;

  // Seconds of so much work.
  double of(wire::Work kind, double units) const { return machine_.work[static_cast<std::size_t>(kind)] * units; }
  double of(const wire::UnitCounts& units) const;

  // Whether messages of the type take time.
  bool takes_time(long type) const { return machine_.network.takes_time(static_cast<int>(type)); }

  // Seconds that a message of `bytes` takes a node's processor, or the host's.
  double to_send(double bytes) const { return end(machine_.network.send, bytes); }
  double to_receive(double bytes) const { return end(machine_.network.receive, bytes); }
  double host_to_send(double bytes) const { return host_end(machine_.network.send, bytes); }
  double host_to_receive(double bytes) const { return host_end(machine_.network.receive, bytes); }
  // And a node's, of a message to the host.
  double to_send_host(double bytes) const { return takes_time(wire::kStrip) ? to_send(bytes) : 0; }

  // Seconds on the way between two nodes, where nothing else is.
  double on_the_way(double bytes, bool same_computer) const;
  // Seconds that messages of `bytes` together, from other computers, take longer if they are announced: their receiver
  // answers them one after another.
  double answers(double messages, double bytes) const;

 private:
  double empty_on_the_way() const;
  double end(const std::vector<simulated::EndCost>& costs, double bytes) const;
  double host_end(const std::vector<simulated::EndCost>& costs, double bytes) const {
    if (!takes_time(wire::kStrip)) return 0;
    return end(machine_.network.host_end.empty() ? costs : machine_.network.host_end, bytes);
  }

  const simulated::Machine& machine_;
};

}  // namespace mars::forecast
