// A node that falls, in several ways and at several moments, while all others need it: whatever the backend, all must
// end soon.
#pragma once

#include <string>
#include <vector>

namespace mars::faults {

struct Fault {
  std::string way;     // throws, exits, crashes, killed
  std::string moment;  // start, waiting, collective, handler, sending, end
};

inline const std::vector<std::string> kWays = {"throws", "exits", "crashes", "killed"};
inline const std::vector<std::string> kMoments = {"start", "waiting", "collective", "handler", "sending", "end"};

// The body of every rank, of which node 1 falls. What it throws is "a fault on purpose".
void run_rank(const Fault& fault);

}  // namespace mars::faults
