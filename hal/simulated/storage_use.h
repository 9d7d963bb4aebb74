// Who uses a machine's storage when.
#pragma once

#include <algorithm>

#include "hal/simulated/calendar.h"
#include "hal/simulated/machine.h"

namespace mars::simulated {

class StorageUse {
 public:
  StorageUse(const Storage& storage, const Network& network) : storage_(storage), port_byte_(network.byte) {}

  // When a file is there whose writing begins at `begin`: it is opened, then its bytes come, no faster than through the
  // writer's port. `floor`: as in Calendar.
  double write(double begin, double bytes, double floor) {
    const double opened = opening_.book(begin, storage_.opening, floor) + storage_.opening;
    const double seconds = bytes * storage_.byte;
    const double there = bytes_.book(opened, seconds, floor) + seconds;
    return storage_.byte > 0 ? std::max(there, opened + bytes * port_byte_) : there;
  }

 private:
  const Storage storage_;
  const double port_byte_;
  Calendar opening_, bytes_;
};

}  // namespace mars::simulated
