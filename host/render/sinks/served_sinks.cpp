#include "host/render/sinks/served_sinks.h"

#include <algorithm>

#include "hal/nx/nx_messages.h"

namespace mars::sinks {

void ServedSinks::submit(compositor::Frame* frame) {
  const images::FileWork before = sink().made();
  sink().take(*frame);
  const double now = dclock();
  const Times times = serve_(sink().made() - before);
  making_ += times.making;
  storing_.add(times.made, times.there);
  served_.push_back({frame, {frame->number, 0, now, now, times.there}});
}

images::FileWork ServedSinks::made() const {
  images::FileWork made = SinkPool::made();
  made.making_seconds = making_;
  made.storing_seconds = storing_.seconds();
  return made;
}

std::vector<SinkPool::Taken> ServedSinks::taken() {
  std::vector<Taken> all;
  const double now = dclock();
  const auto ended =
      std::stable_partition(served_.begin(), served_.end(), [&](const Served& s) { return s.taken.ended > now; });
  for (auto served = ended; served != served_.end(); ++served) {
    all.push_back(served->taken);
    give_back(served->frame);
  }
  served_.erase(ended, served_.end());
  std::ranges::sort(all, {}, &Taken::ended);
  return all;
}

// Farm asks for what was taken afterwards.
void ServedSinks::finish() {
  const auto under_way = [&] {
    return std::ranges::any_of(served_, [now = dclock()](const Served& s) { return s.taken.ended > now; });
  };
  while (under_way()) flick();
}

}  // namespace mars::sinks
