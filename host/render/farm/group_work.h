// What one group of nodes was given, and the frames that come of it. A group's tasks are composed one after another, so
// it needs one saved background at most.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "hal/collectives/group.h"
#include "host/render/compositor/compositor.h"
#include "host/render/farm/assembly.h"

namespace mars::farm {

class GroupWork {
 public:
  // For pictures that go to `sinks`.
  GroupWork(const collectives::Group& group, std::int32_t contributors, const sinks::SinkPool::Shape& sinks);

  const collectives::Group& group() const { return group_; }
  std::int32_t contributors() const { return contributors_; }  // to keyframes
  // Tasks given and not done.
  std::size_t tasks() const { return tasks_.size(); }
  // `background`: the pixel where nothing is drawn. `now`: in seconds since the first task was given to any group.
  void give(const Task& task, std::uint64_t background, double now);

  // As Assembly's.
  std::optional<std::uint32_t> drawn_by(std::int32_t node) const;

  // Whether it is a strip that is still to come.
  bool wants(const wire::Strip& strip) const;
  void receive(StripMessage strip);

  // As Assembly's, for the first task that is not done.
  bool prepare(sinks::SinkPool& sinks);
  struct Composed {
    Assembly::Pasted pasted;
    std::uint32_t interval;
    double given;  // when its task was
    compositor::PastedCounts counts;
  };
  std::optional<Composed> compose(sinks::SinkPool& sinks, StripStore& store);

 private:
  struct Given {
    Assembly assembly;
    std::uint64_t background;
    double given;
  };

  void begin_interval() { compositor_.begin_interval(tasks_.front().background); }

  collectives::Group group_;
  std::int32_t contributors_;
  compositor::Compositor compositor_;  // the first task's
  std::deque<Given> tasks_;
};

}  // namespace mars::farm
