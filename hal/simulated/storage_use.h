// Who uses a machine's storage when.
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "hal/simulated/calendar.h"
#include "hal/simulated/machine.h"

namespace mars::simulated {

class StorageUse {
 public:
  StorageUse(const Storage& storage, const Network& network);

  // When a file is there that `computer` begins to write at `begin`: it is opened, then its bytes come, no faster than
  // through the writer's port. `floor`: as in Calendar.
  double write(int computer, double begin, double bytes, double floor);

 private:
  double to_servers(double opened, double bytes, double floor);
  std::size_t first_server(double opened, double seconds) const;

  const Storage storage_;
  const double port_byte_;
  Calendar opening_;
  std::vector<Calendar> servers_;
  std::unordered_map<int, Calendar> writers_;  // by computer
};

}  // namespace mars::simulated
