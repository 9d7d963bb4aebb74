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
  // For pictures that go to `sinks`.
  GroupWork(const collectives::Group& group, std::int32_t contributors, const sinks::SinkPool::Shape& sinks);

  const collectives::Group& group() const { return group_; }
  std::int32_t contributors() const { return contributors_; }  // to keyframes
  // Whether its nodes write the frames' files; at first they send strips.
  bool writes() const { return writes_; }
  void let_nodes_write() { writes_ = true; }
  // Tasks given and not done.
  std::size_t tasks() const { return tasks_.size(); }
  // Once all of the task before is given. `background`: the pixel where nothing is drawn. `now`: in seconds since the
  // first task was given to any group. The task, which outlives it, has portions to be given then.
  void give(const Task& task, std::uint64_t background, double now);

  // The frame that the node draws: the one that it said last it had begun, -1 for none, if that is still to come; else
  // the first of its frames that are.
  std::optional<std::uint32_t> drawn_by(std::int32_t node, std::int32_t begun) const;

  // Of the task that was given last.

  // Whether portions of it are left.
  bool is_open() const { return open_ != nullptr; }
  const Task& open_task() const { return *open_; }
  // How its nodes are getting on; `rates` are of all nodes.
  std::vector<Standing> standings(const NodeRates& rates) const;
  // The next `most` inbetweens, or as many as are left, are its nodes' from now on.
  Portion give_portion(const std::vector<Standing>& standings, std::size_t most);

  // Whether it is a strip that is still to come.
  bool wants(const wire::Strip& strip) const;
  void receive(StripMessage strip);

  // As Assembly's, where nodes write files.
  struct Composed {
    Assembly::Pasted pasted;
    std::uint32_t interval;
    double given;  // when its task was
    compositor::PastedCounts counts;
  };
  bool awaits_file(std::uint32_t frame) const;
  std::optional<Composed> note_drawn(const wire::Strip& strip);
  std::optional<Composed> note_written(std::uint32_t frame);

  // As Assembly's, for the first task that is not done.
  bool prepare(sinks::SinkPool& sinks);
  std::optional<Composed> compose(sinks::SinkPool& sinks, StripStore& store, const PasteListener& listener = {});

 private:
  struct Given {
    Assembly assembly;
    std::uint64_t background;
    double given;
  };

  template <typename Is, typename Note>
  std::optional<Composed> note(Is is_of, Note note);
  void begin_interval() { compositor_.begin_interval(tasks_.front().background); }

  collectives::Group group_;
  std::int32_t contributors_;
  bool writes_ = false;
  compositor::Compositor compositor_;  // the first task's
  std::deque<Given> tasks_;
  const Task* open_ = nullptr;      // the last of them, while portions are left
  std::size_t next_inbetween_ = 0;  // of it
};

}  // namespace mars::farm
