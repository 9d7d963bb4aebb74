// What one group of nodes was given, and the frames that come of it. A group's tasks are composed one after another, so
// it needs one saved background at most.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "hal/collectives/group.h"
#include "host/render/compositor/compositor.h"
#include "host/render/farm/assembly.h"
#include "host/render/farm/node_rates.h"
#include "host/render/farm/shares.h"

namespace mars::farm {

class GroupWork {
 public:
  // For pictures that go to `sinks`. What its nodes are to draw goes into `assignments`, which outlives it.
  GroupWork(const collectives::Group& group, const Division& division, const sinks::SinkPool::Shape& sinks,
            Assignments& assignments);

  const collectives::Group& group() const { return group_; }
  const Division& division() const { return division_; }
  // The group's teams, in order.
  std::int32_t team_count() const { return wire::team_count(group_, division_.teams); }
  collectives::Group team(std::int32_t number) const { return wire::team_of(group_, division_.teams, number); }
  // Whether its nodes write the frames' files; at first they send strips.
  bool writes() const { return writes_; }
  void let_nodes_write() { writes_ = true; }
  // Tasks given and not done.
  std::size_t tasks() const { return tasks_.size(); }
  // Once all of the task before is given. `background`: the pixel where nothing is drawn. `now`: in seconds since the
  // first task was given to any group. The task, which outlives it, has portions to be given then.
  void give(const Task& task, std::uint64_t background, double now);

  // Of the task that was given last.

  // Whether portions of it are left.
  bool is_open() const { return open_ != nullptr; }
  const Task& open_task() const { return *open_; }
  // How its teams are getting on, each as its slowest node; `rates` are of all nodes.
  std::vector<Standing> standings(const NodeRates& rates) const;
  // The next `most` inbetweens, or as many as are left, are its teams' from now on.
  Portion give_portion(const std::vector<Standing>& standings, std::size_t most);

  // A strip of what its node was given.
  void receive(StripMessage strip);

  // As Assembly's, where nodes write files.
  struct Composed {
    Assembly::Pasted pasted;
    std::uint32_t interval;
    double given;  // when its task was
    compositor::PastedCounts counts;
  };
  bool awaits_file(std::uint32_t frame) const;
  std::optional<Composed> note_drawn(std::uint32_t frame) { return note(frame, &Assembly::note_drawn); }
  std::optional<Composed> note_written(std::uint32_t frame) { return note(frame, &Assembly::note_written); }

  // As Assembly's, for the first task that is not done.
  bool prepare(sinks::SinkPool& sinks);
  std::optional<Composed> compose(sinks::SinkPool& sinks, StripStore& store, const PasteListener& listener = {});

 private:
  struct Given {
    Assembly assembly;
    std::uint64_t background;
    double given;
  };

  using Note = std::optional<Assembly::Pasted> (Assembly::*)(std::uint32_t frame);

  std::deque<Given>::iterator task_of(std::uint32_t frame);
  std::optional<Composed> note(std::uint32_t frame, Note note);
  void begin_interval() { compositor_.begin_interval(tasks_.front().background); }

  collectives::Group group_;
  Division division_;
  Assignments* assignments_;
  bool writes_ = false;
  compositor::Compositor compositor_;  // the first task's
  std::deque<Given> tasks_;
  const Task* open_ = nullptr;      // the last of them, while portions are left
  std::size_t next_inbetween_ = 0;  // of it
};

}  // namespace mars::farm
